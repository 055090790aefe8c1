"""The recorded trajectory, along which the vehicle can drive back."""

from collections import deque
from dataclasses import dataclass, field
from math import cos, hypot, sin

from nav.planning.arcs import Pose

SPACING_M = 0.5
_MOST = 400


def _places() -> deque[tuple[float, float]]:
    return deque(maxlen=_MOST)


@dataclass
class Trail:
    """Places of the reference point half a metre apart, the newest last."""

    places: deque[tuple[float, float]] = field(default_factory=_places)

    def record(self, pose: Pose, longest_m: float) -> None:
        """Go on with the trail from where the vehicle is."""
        self.unwind(pose)
        last = self.places[-1] if self.places else None
        if last is None or hypot(pose[0] - last[0], pose[1] - last[1]) >= SPACING_M:
            self.places.append(pose[:2])
        while len(self.places) * SPACING_M > longest_m:
            self.places.popleft()

    def unwind(self, pose: Pose) -> None:
        """Forget what does not lie behind the vehicle any more."""
        while self.places and _ahead(pose, self.places[-1]) > 0.1:
            self.places.pop()

    def behind(self, pose: Pose, way_m: float) -> tuple[float, float] | None:
        """Forward (negative) and left [m] of the place that is `way_m` back, or of the oldest."""
        if not self.places:
            return None
        back = min(max(round(way_m / SPACING_M), 1), len(self.places))
        return _local(pose, self.places[-back])

    @property
    def length_m(self) -> float:
        """How far back it goes."""
        return len(self.places) * SPACING_M


def _ahead(pose: Pose, place: tuple[float, float]) -> float:
    return _local(pose, place)[0]


def _local(pose: Pose, place: tuple[float, float]) -> tuple[float, float]:
    c, s = cos(pose[2]), sin(pose[2])
    dx, dy = place[0] - pose[0], place[1] - pose[1]
    return c * dx + s * dy, c * dy - s * dx
