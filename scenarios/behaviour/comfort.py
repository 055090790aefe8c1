"""Comfort: how hard the vehicle is pushed sideways, braked and jerked."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import sqrt
from typing import Any

from nav.angles import wrapped
from scenarios.behaviour.motion import MOVES_MPS, Rate
from scenarios.episode import Episode
from tape.record import Record
from twin.truth import Truth


@dataclass
class Comfort:
    """Watches a run. All from the true speed and heading, as means over half a second."""

    lateral_mps2: float = 0.0
    """Greatest of either side: speed times yaw rate ..."""
    braking_mps2: float = 0.0
    """... greatest loss of speed, in either direction of travel ..."""
    accelerating_mps2: float = 0.0
    """... greatest gain ..."""
    jerk_mps3: float = 0.0
    """... and greatest change of the acceleration along the vehicle's x axis."""
    _sum2: float = 0.0
    _count: int = 0
    """Of the lateral accelerations while it moved."""
    _heading_rad: float | None = None
    _pushed_mps: float = 0.0
    """Speed times what the heading has turned, added up."""
    _full: bool = False
    """Whether the first half second is over ..."""
    _jerked: bool = False
    """... and the second, which the jerk needs."""
    _sideways: Rate = field(default_factory=Rate)
    _faster: Rate = field(default_factory=Rate)
    _ahead: Rate = field(default_factory=Rate)
    _jerk: Rate = field(default_factory=Rate)

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the truth of this tick."""
        del records  # Unused.
        truth = episode.truth
        self._turn(truth)
        self._hasten(truth)
        self._jolt(truth)

    def _turn(self, truth: Truth) -> None:
        speed, heading = truth.speed_mps, truth.heading_rad
        if self._heading_rad is not None:
            self._pushed_mps += speed * wrapped(heading - self._heading_rad)
        self._heading_rad = heading
        lateral = self._sideways.of(truth.time_ns, self._pushed_mps)
        if lateral is None:
            return
        self.lateral_mps2 = max(self.lateral_mps2, abs(lateral))
        if abs(speed) > MOVES_MPS:
            self._sum2 += lateral * lateral
            self._count += 1

    def _hasten(self, truth: Truth) -> None:
        gain = self._faster.of(truth.time_ns, abs(truth.speed_mps))
        if gain is not None:
            self._full = True
            self.accelerating_mps2 = max(self.accelerating_mps2, gain)
            self.braking_mps2 = max(self.braking_mps2, -gain)

    def _jolt(self, truth: Truth) -> None:
        # Of the signed speed: who brakes and drives back at once is pushed one way all the time.
        acceleration = self._ahead.of(truth.time_ns, truth.speed_mps)
        if acceleration is None:
            return
        jerk = self._jerk.of(truth.time_ns, acceleration)
        if jerk is not None:
            self._jerked = True
            self.jerk_mps3 = max(self.jerk_mps3, abs(jerk))

    def figures(self) -> dict[str, Any]:
        """What was measured; None before the vehicle was seen for half a second, or moved."""
        return {
            "max_lateral_mps2": self.lateral_mps2 if self._full else None,
            "rms_lateral_mps2": sqrt(self._sum2 / self._count) if self._count else None,
            "max_braking_mps2": self.braking_mps2 if self._full else None,
            "max_accelerating_mps2": self.accelerating_mps2 if self._full else None,
            "max_jerk_mps3": self.jerk_mps3 if self._jerked else None,
        }
