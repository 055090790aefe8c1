"""What stood along the way: the returns that the navigator took for obstacles, in the cells that
its map still held when it saw them last.

The map is the judge of what is there: grazed ground and what else was there for a moment, it has
dropped by then. Returns tell where in a cell a thing is, and how high.
"""

import numpy as np

from ion.reconstruct.tally import Ints, Tally, cell_of, counted, merged, row_column
from nav.fusion.obstacle_map import ObstacleMap
from nav.messages import Floats

EVERY = 10
"""Decisions between two looks at the map: 1 s. It moves on by some metres meanwhile, and is 64 m
wide."""


class Seen:
    """Looks on while the navigator goes over a tape again."""

    def __init__(self, cell_m: float) -> None:
        self._cell_m = cell_m
        self._parts = [counted(np.zeros((3, 0)), cell_m)]
        self._new: list[Floats] = []
        self._held: Ints = np.zeros(0, np.int64)

    def look(self, obstacles: ObstacleMap) -> None:
        """Take what the map made of the scans of one decision."""
        self._new.append(obstacles.returns_m)
        if len(self._new) == EVERY:
            self._settle(obstacles)

    def all(self, obstacles: ObstacleMap) -> tuple[Tally, Ints]:
        """All returns, and the numbers of the cells that the map held at last."""
        self._settle(obstacles)
        return merged(self._parts), self._held

    def _settle(self, obstacles: ObstacleMap) -> None:
        if self._new:
            self._parts.append(counted(np.concatenate(self._new, axis=1), self._cell_m))
            self._new = []
        self._held = held(self._held, obstacles)


def held(before: Ints, obstacles: ObstacleMap) -> Ints:
    """The cells that the map held when it saw them last: of where it is, those it holds now."""
    lattice = obstacles.lattice
    row, column = row_column(before)
    south, west = row - lattice.south, column - lattice.west
    inside = (np.minimum(south, west) >= 0) & (np.maximum(south, west) < lattice.count)
    row, column = np.divmod(obstacles.occupied_index(), lattice.count)
    now = cell_of(row + lattice.south, column + lattice.west)
    return np.union1d(before[~inside], now)
