"""Returns counted by the cell in which they ended: what is left of a scan once it has been used.

Cells have numbers that hold for the whole route, wherever the navigator's map is at the time.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.messages import Floats

Ints = NDArray[np.int64]
SPAN = 2**24
"""Cells from west to east: at 0.2 m, more than any route is wide."""


class Tally(NamedTuple):
    """Of n cells, ascending by number."""

    cell: Ints
    """Shape (n,)."""
    returns: Floats
    """Shape (n,): how many ended there ..."""
    total_m: Floats
    """... and the sum of their places, shape (n, 2), route frame N."""
    top_m: Floats
    """Shape (n,): the highest of them, above the reference point."""

    @property
    def place_m(self) -> Floats:
        """Where the returns of each cell ended on average, shape (n, 2)."""
        return self.total_m / self.returns[:, None]

    def where(self, kept: NDArray[np.bool_] | Ints) -> "Tally":
        """Those for which it is so, or those of some places in the tally."""
        return Tally(self.cell[kept], self.returns[kept], self.total_m[kept], self.top_m[kept])


def cell_of(row: Ints, column: Ints) -> Ints:
    """Numbers of cells that are so many cells north and east of the route's first waypoint."""
    return row * SPAN + column


def row_column(cell: Ints) -> tuple[Ints, Ints]:
    """The reverse of `cell_of`."""
    row = (cell + SPAN // 2) // SPAN
    return row, cell - row * SPAN


def counted(place_m: Floats, cell_m: float) -> Tally:
    """Returns by cell.

    Args:
        place_m: where they ended, shape (3, n).
        cell_m: edge of a cell.
    """
    column, row = np.floor(place_m[:2] / cell_m).astype(np.int64)
    one = np.ones(place_m.shape[1])
    return merged([Tally(cell_of(row, column), one, place_m[:2].T, place_m[2])])


def merged(parts: Sequence[Tally]) -> Tally:
    """Many tallies as one; at least one."""
    both = _beside(parts)
    order = np.argsort(both.cell, kind="stable")
    cell, first = np.unique(both.cell[order], return_index=True)
    if not cell.size:
        return both
    return Tally(
        cell,
        np.add.reduceat(both.returns[order], first),
        np.add.reduceat(both.total_m[order], first, axis=0),
        np.maximum.reduceat(both.top_m[order], first),
    )


def _beside(parts: Sequence[Tally]) -> Tally:
    return Tally(
        np.concatenate([part.cell for part in parts]),
        np.concatenate([part.returns for part in parts]),
        np.concatenate([part.total_m for part in parts]),
        np.concatenate([part.top_m for part in parts]),
    )
