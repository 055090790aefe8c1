"""What a device is held against: the estimate, and what other devices said last."""

from dataclasses import dataclass
from typing import Protocol

from nav.messages import GpsFix, GpsQuality, VehicleState

FRESH_NS = 200_000_000
"""Older words are no witness."""


class Ego(Protocol):
    """What is asked of the ego state."""

    @property
    def ready(self) -> bool:
        """Whether it knows anything."""
        ...

    @property
    def speed_mps(self) -> float:
        """Signed."""
        ...

    @property
    def rocking_radps(self) -> float:
        """How fast the vehicle rolls and pitches."""
        ...

    def antenna_gap_m(self, fix: GpsFix) -> tuple[float, float]:
        """How far a fix is from where the antenna is believed to be, and the standard deviation of
        that belief, [m]."""
        ...

    def compass_gap_rad(self, heading_rad: float) -> float:
        """How far a compass is from what is expected of it, [rad]."""
        ...

    def yaw_rate_of(self, steering_rad: float) -> float:
        """The yaw rate that a steering angle gives at the present speed, [rad/s]."""
        ...


@dataclass
class Witnesses:
    """The last words of devices that are believed themselves."""

    fix: GpsFix | None = None
    state: VehicleState | None = None

    def fix_at(self, time_ns: int) -> GpsFix | None:
        """The last fix, if it is fresh and one at all."""
        fix = self.fix
        if fix is None or fix.quality is GpsQuality.NONE or time_ns - fix.time_ns >= FRESH_NS:
            return None
        return fix

    def state_at(self, time_ns: int) -> VehicleState | None:
        """The last word of the drive-by-wire unit, if it is fresh."""
        return self.state if self.state and time_ns - self.state.time_ns < FRESH_NS else None
