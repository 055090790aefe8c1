"""The two-step expansion of obstacles (section 6.4.2.1): real and safe boundaries.

The real boundary is an obstacle expanded by half the vehicle, so that the vehicle becomes a point;
the safe boundary is enlarged further and envelops it.

A cell is inside a boundary when the nearest obstacle is near enough. The square of that distance
is found along columns first and then along rows, for all boundaries at once, and only where
obstacles reach.
"""

from collections.abc import Sequence
from math import isqrt

import numpy as np
from numpy.typing import NDArray

from nav.errors import NavError

FREE, SAFE, REAL, TOUCH = 0, 1, 2, 3
"""Outside all boundaries, inside the safe one, inside the real one, and where the outline itself
would touch: beyond the paper, so that a vehicle that strays into the real boundary may leave it."""

Cells = NDArray[np.uint8]
Squares = NDArray[np.unsignedinteger]
MOST_CELLS = 63
"""A boundary farther from its obstacle than this is a mistake."""


def boundaries(
    occupied: NDArray[np.int64], count: int, cell_m: float, radius_m: Sequence[float]
) -> Cells:
    """Expand obstacles.

    Args:
        occupied: flat indices of occupied cells, shape (n,), as from `ObstacleMap`.
        count: cells a side.
        cell_m: edge of a cell, [m].
        radius_m: how far obstacles are expanded, from the outermost boundary, SAFE, inwards, [m].

    Raises:
        NavError: a radius that is negative or larger than 63 cells.

    Returns:
        Shape (count, count): how many boundaries a cell is inside of. It is inside one when its
        centre is not farther than the radius from the centre of an occupied cell.
    """
    limits = [_squared(radius / cell_m) for radius in radius_m]
    level = np.zeros((count, count), np.uint8)
    if not len(occupied):
        return level
    reach = isqrt(max(limits))
    row, column = np.divmod(occupied, count)
    rows, columns = _reached(row, reach, count), _reached(column, reach, count)
    shape = (rows.stop - rows.start, columns.stop - columns.start)
    squared = _squared_distance(row - rows.start, column - columns.start, shape, reach)
    window = level[rows, columns]
    for limit in limits:
        window += squared <= limit
    return level


def _squared(radius: float) -> int:
    """The largest square of a distance within a radius, in cells; the rim itself is inside."""
    if not 0 <= radius <= MOST_CELLS:
        raise NavError(
            f"a boundary's radius is {radius:.1f} cells; must be within 0 and {MOST_CELLS}"
        )
    return int(radius * radius + 1e-9)  # whatever rounding says of a centre exactly on the rim


def _reached(places: NDArray[np.int64], reach: int, count: int) -> slice:
    """What lies within reach of places along one axis."""
    return slice(max(int(places.min()) - reach, 0), min(int(places.max()) + reach + 1, count))


def _squared_distance(
    row: NDArray[np.int64], column: NDArray[np.int64], shape: tuple[int, int], reach: int
) -> Squares:
    """To the nearest of places (n,), (n,), in cells; right up to `reach`, beyond it just larger."""
    far = (reach + 1) ** 2
    squared = np.full(shape, far, np.min_scalar_type(2 * far))
    squared[row, column] = 0
    return _spread(_spread(squared, reach), reach)


def _spread(squared: Squares, reach: int) -> Squares:
    """Squared distances to the nearest, given those within each row: the other axis added; (m, n)
    of (n, m), because whole rows are compared at a time: ten times as quick as columns."""
    nearest = squared.copy()
    for way in range(1, reach + 1):
        farther = squared + way * way
        np.minimum(nearest[way:], farther[:-way], out=nearest[way:])
        np.minimum(nearest[:-way], farther[way:], out=nearest[:-way])
    return np.ascontiguousarray(nearest.T)
