"""Commands: whether actuators can do what they are asked for, in time, and how busy they are."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Any

from nav.messages import ActuatorTargets
from scenarios.behaviour.motion import MOVES_MPS, newest
from scenarios.episode import Episode
from scenarios.parameter_files import parameters_of
from tape.record import Record

LATE_NS = 100_000_000
"""Targets older than this are late: five ticks."""
ROLLS_MPS = 0.3
"""Faster than this the linkage leaves no position (estimated, models/README.md)."""
REVERSAL_RADPS = 0.05
"""Slower changes of the steering are no reversals: a sixth of what ION's steering can do, and one
milliradian from tick to tick."""


@dataclass
class Commands:
    """Watches a run. All from the targets that left the navigator, and the true speed."""

    infeasible: int = 0
    late: int = 0
    """Ticks without targets, or with old ones."""
    reversals: int = 0
    _last: ActuatorTargets | None = None
    _steered: tuple[float, float] | None = None
    """Time [s] and angle [rad] of the last tick, if the vehicle moved and this is a number."""
    _time_s: float = 0.0
    _sum2: float = 0.0
    """Of the rates, a second."""
    _turned: float = 0.0
    """The last rate that was no trifle, [rad/s]."""

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the targets of this tick."""
        now_ns, targets = episode.truth.time_ns, newest(records, ActuatorTargets)
        self.late += targets is None or now_ns - targets.time_ns > LATE_NS
        if targets is None:
            return
        self.infeasible += not (_possible(episode, targets) and self._can_shift(episode, targets))
        self._last = targets
        # At a stand the wheels are turned as far as need be, or where they happen to be.
        if isfinite(targets.steering_rad) and abs(episode.truth.speed_mps) > MOVES_MPS:
            self._steer(now_ns * 1e-9, targets.steering_rad)
        else:
            self._steered = None

    def _can_shift(self, episode: Episode, targets: ActuatorTargets) -> bool:
        """A new gear may be asked for at a stand only."""
        new = self._last is not None and targets.gear != self._last.gear
        return not new or abs(episode.truth.speed_mps) <= ROLLS_MPS

    def _steer(self, now_s: float, steering_rad: float) -> None:
        then, self._steered = self._steered, (now_s, steering_rad)
        if then is None:
            return
        gone_s = now_s - then[0]
        rate = (steering_rad - then[1]) / gone_s
        self._time_s += gone_s
        self._sum2 += rate * rate * gone_s
        if abs(rate) > REVERSAL_RADPS:
            self.reversals += rate * self._turned < 0.0
            self._turned = rate

    def figures(self) -> dict[str, Any]:
        """What was counted; None where it did not move."""
        time_s = self._time_s
        return {
            "commands_infeasible": self.infeasible,
            "commands_late": self.late,
            "steering_rate_rms_radps": sqrt(self._sum2 / time_s) if time_s else None,
            "steering_reversals_per_min": 60.0 * self.reversals / time_s if time_s else None,
        }


def _possible(episode: Episode, targets: ActuatorTargets) -> bool:
    """Whether the pedals and the steering can do it; what is no number fails all comparisons."""
    limit = parameters_of(episode.course.vehicle).vehicle.steering.limit_rad
    pedals = 0.0 <= targets.throttle <= 1.0 and 0.0 <= targets.brake <= 1.0
    both = targets.throttle > 0.0 and targets.brake > 0.0
    return abs(targets.steering_rad) <= limit and pedals and not both
