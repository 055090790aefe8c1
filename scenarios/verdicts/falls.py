"""Whether the vehicle still stands on the ground that it came on."""

from collections import deque
from dataclasses import dataclass, field
from math import acos, cos

from twin.truth import Truth

FELL_RAD = 0.785
"""Tilted by more (45 degrees) it does not come back; its manual allows 15 (published)."""
FELL_M = 0.8
"""Lower by more than this within a second it has driven over an edge: courses slope by 0.08, which
is 0.6 m a second at 15 mph."""
WITHIN_NS = 1_000_000_000


def _heights() -> deque[tuple[int, float]]:
    return deque()


@dataclass
class Falls:
    """Greatest tilt, and the word for a vehicle that has fallen."""

    max_tilt_rad: float = 0.0
    """Between the vehicle's z axis and the vertical."""
    fell: bool = False
    _height_m: deque[tuple[int, float]] = field(default_factory=_heights)
    """Times and heights of the last second."""

    def observe(self, truth: Truth) -> None:
        """Take the true state."""
        tilt = acos(min(max(cos(truth.roll_rad) * cos(truth.pitch_rad), -1.0), 1.0))
        self.max_tilt_rad = max(self.max_tilt_rad, tilt)
        last = self._height_m
        last.append((truth.time_ns, float(truth.position_m[2])))
        while truth.time_ns - last[0][0] > WITHIN_NS:
            last.popleft()
        self.fell |= tilt > FELL_RAD or last[0][1] - last[-1][1] > FELL_M
