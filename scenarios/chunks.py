"""What stands along a route, drawn chunk by chunk as the vehicle comes near."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from scenarios.course import Floats
from twin.world import SIGHT_M, Obstacle

Things = tuple[Obstacle, ...]
KEPT = 64
"""Chunks that are remembered: more than are ever in sight."""


@dataclass(eq=False)
class Chunks:
    """A `twin.world.Scenery`: the same things wherever one comes from, and however often."""

    middle_m: Floats
    """Shape (n, 2), world frame: of the circle that holds all that chunk k draws ..."""
    radius_m: Floats
    """... and its radius, shape (n,)."""
    draw: Callable[[int], Things]
    """What stands in chunk k: a pure function. Can be pickled."""
    first: int = 0
    """Number of the chunk whose circle comes first."""
    _drawn: dict[int, Things] = field(default_factory=dict[int, Things])
    _near: tuple[int, ...] = ()
    _around: Things = ()

    def around(self, x_m: float, y_m: float) -> Things:
        """See `Scenery`."""
        gap = np.hypot(*(self.middle_m - (x_m, y_m)).T) - self.radius_m
        near = tuple(np.flatnonzero(gap < SIGHT_M).tolist())
        if near != self._near:
            self._near = near
            self._around = tuple(thing for k in near for thing in self._chunk(k))
        return self._around

    def everything(self) -> Things:
        """See `Scenery`."""
        return tuple(t for k in range(len(self.radius_m)) for t in self.draw(self.first + k))

    def _chunk(self, k: int) -> Things:
        if k not in self._drawn:
            while len(self._drawn) >= KEPT:
                del self._drawn[next(iter(self._drawn))]
            self._drawn[k] = self.draw(self.first + k)
        return self._drawn[k]
