"""Sensing: whether the vehicle could have stopped within what it knew to be free, and drove blind.

The free distance is the navigator's own, along its plan. Where nothing has been seen it takes the
way for free, up to 30 m: that it drives blind is the other figure.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from nav.messages import Decision, LidarScan
from nav.parameters import ION
from nav.states import road_following, tunnel_mode
from nav.states.watchdog import MAIN_STATES
from scenarios.behaviour.motion import newest
from scenarios.episode import Episode
from scenarios.vehicles import DUBINS
from scenarios.verdicts.judge import TICK_S
from tape.record import Record
from twin.drive_by_wire import BRAKE
from twin.skid_steer import SkidSteerParameters

MOVING_STATES = (*MAIN_STATES, tunnel_mode.NAME, road_following.NAME)
"""Their decisions tell the free distance along a plan ahead; those of the others tell what is left
of a manoeuvre."""
DECISION_S = 0.1
"""What comes in sight waits for the next decision (published: 10 Hz)."""
BLIND_NS = 500_000_000
"""Without a scan for this long it is blind: what is older is of no use to the navigator either."""


@dataclass(frozen=True)
class Stopping:
    """How a vehicle stops."""

    answer_s: float
    """From the targets to the brakes ..."""
    braking_mps2: float
    """... and then this."""

    def way_m(self, speed_mps: float) -> float:
        """Way to a stand, [m], with the wait for a decision."""
        speed = max(speed_mps, 0.0)
        return speed * (DECISION_S + self.answer_s + 0.5 * speed / self.braking_mps2)


_ROBOT = SkidSteerParameters()
STOPPING = {
    ION: Stopping(BRAKE.delay_s + 0.5 / BRAKE.rate_per_s, 3.0),
    DUBINS: Stopping(0.0, 3.5),
    "pioneer": Stopping(_ROBOT.delay_s, _ROBOT.acceleration_mps2 + _ROBOT.braking_mps2),
}
"""ION: 0.10 s of delay and half of the 0.25 s that the brake takes (estimated, models/README.md);
the 3 m/s^2 with which its navigator reckons (estimated, nav/parameters/speed.toml), where the twin
has 5.1 (measured). The point: an ideal drive, and its navigator's 3.5 m/s^2 (estimated,
nav/parameters/dubins.toml). The small robot: delay and full brake of its unit (estimated); its
navigator's file names none."""


@dataclass
class Sensing:
    """Watches a run. From the true speed, the decisions and the scans."""

    overdrives_s: float = 0.0
    worst_m: float | None = None
    """By how much the way to a stand exceeded the free distance at worst, 0 if it never did."""
    blind_m: float = 0.0
    _over_m: float = 0.0
    """At the last decision."""
    _scanned_ns: int | None = None

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the truth, and what was heard and decided in this tick."""
        truth = episode.truth
        decision, stopping = newest(records, Decision), STOPPING.get(episode.course.vehicle)
        if decision and stopping:
            self._decide(decision, stopping.way_m(truth.speed_mps))
        self.overdrives_s += TICK_S if self._over_m > 0.0 else 0.0
        if self._scanned_ns is None or newest(records, LidarScan):
            self._scanned_ns = truth.time_ns
        if truth.time_ns - self._scanned_ns > BLIND_NS:
            self.blind_m += abs(truth.speed_mps) * TICK_S

    def _decide(self, decision: Decision, way_m: float) -> None:
        self._over_m = 0.0
        if decision.state in MOVING_STATES:
            self._over_m = way_m - decision.D_m
            self.worst_m = max(self.worst_m or 0.0, self._over_m)

    def figures(self) -> dict[str, Any]:
        """What was measured; None without a decision in a moving state."""
        return {
            "overdrives_sensing_s": None if self.worst_m is None else self.overdrives_s,
            "worst_overdrive_m": self.worst_m,
            "blind_m": self.blind_m,
        }
