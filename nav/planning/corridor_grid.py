"""The corridor's edges on the map's lattice, as boundaries: real and safe."""

from collections.abc import Sequence
from math import hypot

import numpy as np
from numpy.typing import NDArray

from nav.fusion.lattice import Lattice
from nav.messages import Floats


def corridor_distance(
    lattice: Lattice, position_m: Floats, half_width_m: Floats, first: int, last: int
) -> NDArray[np.float32]:
    """How far inside the corridor every cell's centre lies, negative outside, [m].

    The corridor is the union of the segments' rectangles and the discs at their waypoints: of
    all points closer to a segment than its half-width.

    Args:
        position_m: waypoints, shape (n, 2).
        half_width_m: shape (n,), of the segment that starts at the waypoint.
        first, last: segments first..last-1 are drawn.
    """
    inside = np.full((lattice.count, lattice.count), -1e3, dtype=np.float32)
    for i in range(first, last):
        _draw(inside, lattice, position_m[i], position_m[i + 1], float(half_width_m[i]))
    return inside


def edge_levels(inside_m: NDArray[np.float32], margin_m: Sequence[float]) -> NDArray[np.uint8]:
    """How many boundaries of the corridor's edge a cell is inside of, from how far it lies inside.

    Args:
        inside_m: from `corridor_distance`.
        margin_m: the boundaries begin this far inside the edge, from the outermost, SAFE, inwards.
    """
    level = np.zeros(inside_m.shape, np.uint8)
    for margin in margin_m:
        level += inside_m < margin
    return level


def _draw(
    inside: NDArray[np.float32], lattice: Lattice, a: Floats, b: Floats, half_width_m: float
) -> None:
    rows, y = _span(lattice, 1, min(a[1], b[1]) - half_width_m, max(a[1], b[1]) + half_width_m)
    columns, x = _span(lattice, 0, min(a[0], b[0]) - half_width_m, max(a[0], b[0]) + half_width_m)
    if not len(x) or not len(y):
        return
    along_x, along_y = (b - a).tolist()
    length = hypot(along_x, along_y)
    c, s = along_x / length, along_y / length
    dx, dy = (x - a[0]).astype(np.float32)[None, :], (y - a[1]).astype(np.float32)[:, None]
    forward, left = c * dx + s * dy, c * dy - s * dx
    beyond = np.maximum(np.maximum(-forward, forward - length), 0.0)
    window = inside[rows, columns]
    np.maximum(window, half_width_m - np.sqrt(beyond * beyond + left * left), out=window)


def _span(lattice: Lattice, axis: int, low_m: float, high_m: float) -> tuple[slice, Floats]:
    origin, count = lattice.origin_m[axis], lattice.count
    low = max(0, int(np.floor((low_m - origin) / lattice.cell_m)))
    high = min(count, int(np.ceil((high_m - origin) / lattice.cell_m)))
    cell = np.arange(low, high, dtype=np.float64)
    return slice(low, max(low, high)), origin + (cell + 0.5) * lattice.cell_m
