"""Watchdog: how long the vehicle really stood, and whether the watchdog (section 6.3) did its work.

Only time counts that the watchdog counts: not in Alarm, not before the first decision, and not
while the gear is shifted unless `counts_shift_time` says so.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot
from typing import Any

from nav.messages import Decision
from nav.parameters.states import WatchdogParameters
from nav.states.watchdog import PATIENT_STATES
from scenarios.behaviour.motion import newest
from scenarios.episode import Episode
from scenarios.parameter_files import parameters_of
from scenarios.verdicts.judge import TICK_S
from tape.record import Record
from twin.truth import Applied, Truth

SAID = "watchdog: "
"""How each reason of the watchdog begins ..."""
BITES = ("no change of position", "outside the two main states")
"""... and what it says when it bites, not when it lets go (nav/states/watchdog.py)."""


@dataclass
class Standing:
    """Watches a run. From the true position, and the reasons of the decisions."""

    bites: int = 0
    longest_s: float = 0.0
    """In one place, whatever the watchdog does."""
    latency_s: float = 0.0
    """In one place until the watchdog bit, the vehicle moved, or the drive was over."""
    _place: tuple[float, float] | None = None
    _still_s: float = 0.0
    _unbitten_s: float = 0.0
    _state: str = ""
    _reason: str = ""

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the truth, and the decision of this tick, if there is one."""
        dog = parameters_of(episode.course.vehicle).states.watchdog
        decision = newest(records, Decision)
        if decision:
            self._hear(decision)
        self._move(episode.truth, dog.still_m)
        if self._state and self._state not in PATIENT_STATES and _counts(episode, dog):
            self._wait()

    def _hear(self, decision: Decision) -> None:
        if decision.reason != self._reason and bit(decision.reason):
            self.bites += 1
            self._unbitten_s = 0.0
        self._state, self._reason = decision.state, decision.reason

    def _move(self, truth: Truth, still_m: float) -> None:
        x, y, _ = truth.position_m.tolist()
        if self._place is None or hypot(x - self._place[0], y - self._place[1]) >= still_m:
            self._place, self._still_s, self._unbitten_s = (x, y), 0.0, 0.0

    def _wait(self) -> None:
        self._still_s += TICK_S
        self._unbitten_s += TICK_S
        self.longest_s = max(self.longest_s, self._still_s)
        self.latency_s = max(self.latency_s, self._unbitten_s)

    def figures(self) -> dict[str, Any]:
        """What was counted; None before the first decision."""
        return {
            "watchdog_bites": self.bites,
            "watchdog_latency_s": self.latency_s if self._state else None,
            "longest_still_s": self.longest_s if self._state else None,
        }


def bit(reason: str) -> bool:
    """Whether a decision's reason says that the watchdog has bitten."""
    return reason.startswith(SAID) and any(words in reason for words in BITES)


def _counts(episode: Episode, dog: WatchdogParameters) -> bool:
    """Whether its timers run: from the true linkage, since odometry may be wrong about it."""
    drive = getattr(episode.simulator, "plant", None) or getattr(episode.simulator, "drive", None)
    applied: Applied | None = getattr(drive, "applied", None)
    return dog.counts_shift_time or applied is None or not applied.shifting
