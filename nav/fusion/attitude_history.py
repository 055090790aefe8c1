"""The attitude at a moment that has just passed: a scan is heard some 30 ms after it was taken, and
on bumps the vehicle pitches by a degree in that time."""

from collections import deque
from dataclasses import dataclass, field

from nav.fusion.ego_kinematics import Attitude

KEPT = 32
"""Samples: a third of a second of the IMU."""
SILENT_S = 0.5
"""Nothing is extrapolated farther than this."""


def _samples() -> deque[tuple[int, Attitude]]:
    return deque(maxlen=KEPT)


@dataclass
class AttitudeHistory:
    """The last attitudes with their times."""

    samples: deque[tuple[int, Attitude]] = field(default_factory=_samples)

    def add(self, time_ns: int, attitude: Attitude) -> None:
        """Take the newest one."""
        self.samples.append((time_ns, attitude))

    def at(self, time_ns: int) -> Attitude:
        """Interpolated between samples, extrapolated a little beyond the newest."""
        if not self.samples:
            return Attitude()
        later_ns, later = self.samples[-1]
        if time_ns >= later_ns:
            return later.at(min((time_ns - later_ns) * 1e-9, SILENT_S))
        for earlier_ns, earlier in reversed(self.samples):
            if earlier_ns <= time_ns:
                return _between(earlier, later, (time_ns - earlier_ns) / (later_ns - earlier_ns))
            later_ns, later = earlier_ns, earlier
        return later


def _between(a: Attitude, b: Attitude, share: float) -> Attitude:
    return Attitude(
        a.roll_rad + share * (b.roll_rad - a.roll_rad),
        a.pitch_rad + share * (b.pitch_rad - a.pitch_rad),
        a.rate_radps,
    )
