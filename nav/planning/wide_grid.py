"""A wide, coarse grid for the time of trouble: what was seen in a dead end is not forgotten.

The map ends 32 m away and forgets what it leaves behind; a vehicle that backs out of a dead end
would be sent into it again.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from nav.fusion.lattice import Lattice
from nav.planning.boundaries import Cells
from nav.planning.scanning import Boundaries

CELLS, STRIDE = 160, 4
"""A side of the grid; its cells are every fourth one of the map, 0.8 m: less than what any obstacle
is expanded by."""


@dataclass
class WideGrid:
    """How many boundaries of obstacles each cell is inside of, as it was seen last."""

    cell_m: float
    """Of the map."""
    lattice: Lattice = field(init=False)
    level: Cells = field(init=False)

    def __post_init__(self) -> None:
        self.lattice = Lattice(self.cell_m * STRIDE, CELLS)
        self.level = np.zeros((CELLS, CELLS), np.uint8)

    def update(self, near: Boundaries, x_m: float, y_m: float) -> None:
        """Follow the vehicle, and take over what the map around it says."""
        to = self.lattice.centred(x_m, y_m)
        self.level = self.lattice.moved(self.level, to, 0)
        self.lattice = to
        x, y = (c.reshape(CELLS, CELLS) for c in to.centre_m(np.arange(CELLS * CELLS)))
        on_map = _on_map(near, x, y)
        self.level = np.where(on_map, near.at(x, y), self.level)

    def with_edges(self, edges: Cells) -> Boundaries:
        """Together with the corridor's edges on the same lattice."""
        level = np.maximum(self.level, edges)
        return Boundaries(level, self.lattice.origin_m, self.lattice.cell_m)


def _on_map(near: Boundaries, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.bool_]:
    west, south = near.origin_m
    size = len(near.level) * near.cell_m
    return (x > west) & (x < west + size) & (y > south) & (y < south + size)
