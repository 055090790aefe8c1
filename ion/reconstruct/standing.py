"""Which cells are things: those that the map still held when it saw them last, and their like.

Cells that a few of many beams met are edges that a beam saw half of, or what the estimate's drift
put beside a wall: things would be thicker with them. On the other hand, such drift has made the map
forget cells in which beams ended in hundreds: the far face of a wall, once it was seen from behind.
"""

import numpy as np
from numpy.typing import NDArray

from ion.reconstruct.tally import Ints, Tally, cell_of

NEAR = 3
"""Cells, along both axes: 0.6 m."""
LEAST_SHARE = 0.03
"""Of the returns of the cell nearby that stands and has most: a cell that stands has so many ..."""
LIKE_SHARE = 0.3
"""... and one that the map has forgotten, so many."""


def standing(tally: Tally, held: Ints) -> Tally:
    """The cells that are things.

    Args:
        tally: all returns of obstacles.
        held: numbers of the cells that the map held at last.
    """
    stands = np.isin(tally.cell, held)
    most = _most_nearby(tally, np.where(stands, tally.returns, 0.0))
    share = np.where(stands, LEAST_SHARE, LIKE_SHARE)
    return tally.where((most > 0.0) & (tally.returns >= share * most))


def _most_nearby(tally: Tally, returns: NDArray[np.float64]) -> NDArray[np.float64]:
    most = returns
    steps = np.arange(-NEAR, NEAR + 1)
    for step in cell_of(steps[:, None], steps).ravel().tolist():
        there = np.searchsorted(tally.cell, tally.cell + step)
        there = np.minimum(there, len(tally.cell) - 1)
        beside = tally.cell[there] == tally.cell + step
        most = np.where(beside, np.maximum(most, returns[there]), most)
    return most
