"""A square lattice of cells along the axes of N that follows the vehicle in whole cells."""

from dataclasses import dataclass
from math import floor
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from nav.messages import Floats

Ints = NDArray[np.int64]
Kind = TypeVar("Kind", bound=np.generic)


@dataclass(frozen=True)
class Lattice:
    """Where the cells of a layer lie. Layers are arrays (count, count): row north, column east.

    Cell (row, column) covers [(west + column), (west + column + 1)) * cell_m eastwards and the
    same with `south` northwards, so that a place keeps its cell whichever way the lattice moves.
    """

    cell_m: float
    count: int
    west: int = 0
    south: int = 0

    @property
    def origin_m(self) -> tuple[float, float]:
        """South-west corner of cell (0, 0), route frame N, [m]."""
        return self.west * self.cell_m, self.south * self.cell_m

    def centred(self, x_m: float, y_m: float) -> "Lattice":
        """The same cells with (x_m, y_m) in the middle."""
        west, south = (round(v / self.cell_m) - self.count // 2 for v in (x_m, y_m))
        return Lattice(self.cell_m, self.count, west, south)

    def offset_m(self, x_m: float, y_m: float) -> float:
        """How far (x_m, y_m) is from the middle, along the worse axis, [m]."""
        half = self.count / 2
        return max(
            abs(x_m - (self.west + half) * self.cell_m),
            abs(y_m - (self.south + half) * self.cell_m),
        )

    def cell(self, x_m: float, y_m: float) -> tuple[int, int]:
        """Row and column of one place: `index` without arrays."""
        scale = 1 / self.cell_m
        return floor(y_m * scale) - self.south, floor(x_m * scale) - self.west

    def middle_m(self, cell: tuple[int, int]) -> tuple[float, float]:
        """Centre x, y of a cell (row, column), route frame N, [m]."""
        row, column = cell
        return (column + (self.west + 0.5)) * self.cell_m, (row + (self.south + 0.5)) * self.cell_m

    def index(self, x_m: Floats, y_m: Floats) -> tuple[Ints, NDArray[np.bool_]]:
        """Flat cell indices of places, shape (n,); -1 and False for what lies outside."""
        column = np.floor(x_m * (1 / self.cell_m)).astype(np.int64) - self.west
        row = np.floor(y_m * (1 / self.cell_m)).astype(np.int64) - self.south
        # as unsigned numbers, what is negative is large: one comparison for both ends
        inside = np.maximum(column.view(np.uint64), row.view(np.uint64)) < np.uint64(self.count)
        return np.where(inside, row * self.count + column, -1), inside

    def centre_m(self, index: Ints) -> tuple[Floats, Floats]:
        """Centres x, y of flat cell indices, route frame N, [m]."""
        row, column = np.divmod(index, self.count)
        return (column + (self.west + 0.5)) * self.cell_m, (row + (self.south + 0.5)) * self.cell_m

    def moved(self, layer: NDArray[Kind], to: "Lattice", fill: float) -> NDArray[Kind]:
        """`layer` as it lies on the lattice `to`; new cells hold `fill`."""
        result = np.full_like(layer, fill)
        rows = _overlap(to.south - self.south, self.count)
        columns = _overlap(to.west - self.west, self.count)
        result[rows[1], columns[1]] = layer[rows[0], columns[0]]
        return result


def _overlap(shift: int, count: int) -> tuple[slice, slice]:
    """Source and destination along one axis for a lattice that moves by `shift` cells."""
    kept = max(count - abs(shift), 0)
    first, second = (count - kept, 0) if shift > 0 else (0, count - kept)
    return slice(first, first + kept), slice(second, second + kept)
