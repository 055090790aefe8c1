"""Which cells are things: those that the map still held when it saw them last, and their like.

Before a face, as seen from the way, cells that a few of many beams met are what the estimate's
drift put there: things would be thicker with them. Behind it they are its top, where few beams end.
And such drift has made the map forget cells in which beams ended in hundreds: a face, once the
other side was seen.
"""

import numpy as np
from numpy.typing import NDArray

from ion.reconstruct.tally import Ints, Tally, cell_of
from nav.messages import Floats

NEAR = 3
"""Cells, along both axes: 0.6 m."""
BESIDE_M = 0.1
"""What is farther from the way by more than this is behind."""
BEFORE_SHARE, BEHIND_SHARE = 0.03, 0.003
"""Of the returns of the cell nearby that stands and has most: a cell that stands before or beside
it has so many, or so many behind it ..."""
LIKE_SHARE = 0.3
"""... and one that the map has forgotten, so many."""


def standing(tally: Tally, held: Ints, away_m: Floats) -> Tally:
    """The cells that are things.

    Args:
        tally: all returns of obstacles.
        held: numbers of the cells that the map held at last.
        away_m: how far each cell of the tally is from the way, shape (n,).
    """
    stands = np.isin(tally.cell, held)
    most, most_behind = _most_nearby(tally, stands, away_m)
    least = np.maximum(BEFORE_SHARE * most_behind, BEHIND_SHARE * most)
    least = np.where(stands, least, LIKE_SHARE * most)
    return tally.where((most > 0.0) & (tally.returns >= least))


def _most_nearby(tally: Tally, stands: NDArray[np.bool_], away_m: Floats) -> tuple[Floats, Floats]:
    """Most returns of a standing cell near each cell, and of one that is not before it."""
    returns = np.where(stands, tally.returns, 0.0)
    most, most_behind = returns, returns
    steps = np.arange(-NEAR, NEAR + 1)
    for step in cell_of(steps[:, None], steps).ravel().tolist():
        there = np.searchsorted(tally.cell, tally.cell + step)
        there = np.minimum(there, len(tally.cell) - 1)
        beside = np.where(tally.cell[there] == tally.cell + step, returns[there], 0.0)
        most = np.maximum(most, beside)
        behind = away_m[there] > away_m - BESIDE_M
        most_behind = np.maximum(most_behind, np.where(behind, beside, 0.0))
    return most, most_behind
