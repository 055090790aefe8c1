"""Prepares the blocks of the ground: a lid over each one, and the solids that stand in it.

Compiled code calls none outside its own file: numba's cache notices changes only there.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from twin.raycast.geometry import Floats, Ground, Records


@njit(cache=True)
def put_lids(ground: Ground) -> None:
    """Lay a plane over the ground of each block."""
    z, size, spacing, blocks = ground.z, ground.block_cells, ground.spacing, ground.blocks
    cells = z.shape[0] - 1
    for row in range(blocks.shape[0]):
        for column in range(blocks.shape[1]):
            i, j = row * size, column * size
            part = z[i : min(i + size, cells) + 1, j : min(j + size, cells) + 1]
            lid, slope_x, slope_y = _lid(part)
            blocks[row, column].lid = lid
            blocks[row, column].slope_x = slope_x / spacing
            blocks[row, column].slope_y = slope_y / spacing


@njit(cache=True)
def _lid(part: Floats) -> tuple[float, float, float]:
    """Corner height and slopes a cell of a plane with the corners' mean slopes above all points."""
    rows, columns = part.shape[0] - 1, part.shape[1] - 1
    low_left, low_right, high_left, high_right = part[0, 0], part[0, -1], part[-1, 0], part[-1, -1]
    slope_x = 0.5 * (low_right + high_right - low_left - high_left) / columns
    slope_y = 0.5 * (high_left + high_right - low_left - low_right) / rows
    top = -1e30
    for i in range(rows + 1):
        for j in range(columns + 1):
            top = max(top, part[i, j] - slope_x * j - slope_y * i)
    return top + 1e-9, slope_x, slope_y  # above rounding


@njit(cache=True)
def sort_into_blocks(ground: Ground, solids: Records) -> NDArray[np.int32]:
    """Fill the blocks' `top`, `first` and `last`; returns the members that these point into."""
    blocks, owners = [0][1:], [0][1:]
    for record in ground.blocks.ravel():
        record.top = -1e30
    for i in range(solids.size):
        for block in _blocks_of(ground, solids[i]):
            blocks.append(block)
            owners.append(i)
            top = solids[i].center[2] + solids[i].reach[2]
            record = ground.blocks.ravel()[block]
            record.last += 1
            record.top = max(record.top, top)
    first = 0
    for record in ground.blocks.ravel():
        record.first, record.last, first = first, first, first + record.last
    members = np.empty(len(owners), np.int32)
    for block, owner in zip(blocks, owners):  # noqa: B905 (numba has no strict)
        record = ground.blocks.ravel()[block]
        members[record.last] = owner
        record.last += 1
    return members


@njit(cache=True)
def _blocks_of(ground: Ground, solid: Any) -> list[int]:
    """Flat indices of the blocks in which a solid stands."""
    side, count = ground.block_cells * ground.spacing, ground.blocks.shape[0]
    x, y = solid.center[0] - ground.x0, solid.center[1] - ground.y0
    left, right = _span(x, solid.reach[0], side, count)
    low, high = _span(y, solid.reach[1], side, count)
    return [
        row * count + column
        for row in range(low, high)
        for column in range(left, right)
        if _reaches(solid, x - (column + 0.5) * side, y - (row + 0.5) * side, 0.5 * side)
    ]


@njit(cache=True)
def _span(middle: float, reach: float, side: float, count: int) -> tuple[int, int]:
    """First block and the one after the last along one axis."""
    first, last = np.floor((middle - reach) / side), np.floor((middle + reach) / side)
    return max(int(first), 0), min(int(last), count - 1) + 1


@njit(cache=True)
def _reaches(solid: Any, dx: float, dy: float, half: float) -> bool:
    """Whether a solid at dx, dy from the middle of a square with this half side reaches into it.

    Separating axes of the square and the solid's shadow, which is the sum of three segments; the
    square's own axes were tested by `_span`.
    """
    for a in range(3):
        nx, ny = -solid.axes[a, 1], solid.axes[a, 0]
        reach = half * (abs(nx) + abs(ny)) + 1e-9
        for b in range(3):
            reach += abs(nx * solid.axes[b, 0] + ny * solid.axes[b, 1]) * solid.half[b]
        if abs(nx * dx + ny * dy) > reach:
            return False
    return True
