"""Whether a field can be crossed at all: a search over the plant's own motions.

Best first, on arcs of the smallest radius and straights, forwards and backwards, in exact poses; of
all poses in a cell of (x, y, heading) only the first goes on. What it finds can be driven. Where a
coarse search finds nothing, a fine one has the last word. It knows nothing of the navigator.
"""

from heapq import heappop, heappush
from math import ceil, cos, floor, hypot, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

BEYOND_M = 20.0
"""The vehicle may leave the field this far: room to turn on the widest circle."""
SAMPLE_M = 0.5
"""Poses along a motion that are held against the circles ..."""
SLACK_M = 0.03
"""... which between them come nearer by less than this: 0.25^2 / (2 * 1.45)."""
BUCKET_M = 8.0
COST_SHARE = 0.2
"""Of the way so far, added to the distance left: a little breadth in a best-first search."""


class Grid(NamedTuple):
    """How finely the search looks."""

    cell_m: float
    headings: int
    motion_m: float


COARSE, FINE = Grid(1.0, 24, 2.0), Grid(0.5, 48, 1.0)
"""A motion leaves its cell: it is longer than the cell's diagonal."""


class Task(NamedTuple):
    """From where to where."""

    start: tuple[float, float, float]
    """x, y [m], heading [rad]."""
    goal_m: tuple[float, float]
    near_m: float
    """Reached this near to the goal."""
    half_side_m: float
    """Of the square about the origin that may be used."""


def feasible(circles: Floats, task: Task, disc_m: float, radius_m: float) -> bool:
    """Whether a disc that turns on `radius_m` can drive from the start to the goal.

    Args:
        circles: shape (n, 3): x, y, radius, [m].
        task: from where to where.
        disc_m: radius of the vehicle.
        radius_m: its smallest turning radius.
    """
    grown = circles + np.array([0.0, 0.0, disc_m + SLACK_M])
    buckets = _buckets(grown, task.half_side_m, BUCKET_M)
    return any(_search(grown, *buckets, task, grid, radius_m) for grid in (COARSE, FINE))


@njit(cache=True)
def _buckets(circles: Floats, half_side_m: float, size_m: float) -> tuple[Ints, Ints]:
    """Which circles reach into each square bucket: `member[first[b] : first[b + 1]]`."""
    count = ceil(2.0 * half_side_m / size_m)
    first = np.zeros(count * count + 1, np.int64)
    member = np.zeros(0, np.int64)
    for fill in (False, True):
        if fill:
            first[1:] = np.cumsum(first[1:])
            member = np.zeros(first[-1], np.int64)
        used = np.zeros(count * count, np.int64)
        for i in range(len(circles)):
            x, y, radius = circles[i]
            for row in range(*_span(y, radius, half_side_m, size_m, count)):
                for column in range(*_span(x, radius, half_side_m, size_m, count)):
                    bucket = row * count + column
                    if fill:
                        member[first[bucket] + used[bucket]] = i
                        used[bucket] += 1
                    else:
                        first[bucket + 1] += 1
    return first, member


@njit(cache=True)
def _span(
    middle: float, radius: float, half_side_m: float, size_m: float, count: int
) -> tuple[int, int]:
    low = floor((middle - radius + half_side_m) / size_m)
    high = floor((middle + radius + half_side_m) / size_m)
    return max(low, 0), min(high + 1, count)


@njit(cache=True)
def _free(
    circles: Floats, first: Ints, member: Ints, half_side_m: float, x: float, y: float
) -> bool:
    """Whether a place is in the square and in no circle."""
    if abs(x) >= half_side_m or abs(y) >= half_side_m:
        return False
    count = ceil(2.0 * half_side_m / BUCKET_M)
    row, column = int((y + half_side_m) / BUCKET_M), int((x + half_side_m) / BUCKET_M)
    bucket = row * count + column
    for k in range(first[bucket], first[bucket + 1]):
        cx, cy, radius = circles[member[k]]
        if (cx - x) ** 2 + (cy - y) ** 2 <= radius * radius:
            return False
    return True


@njit(cache=True)
def _moved(
    pose: tuple[float, float, float], way_m: float, curvature_per_m: float
) -> tuple[float, float, float]:
    """(6.9) along an arc or a straight."""
    half = 0.5 * way_m * curvature_per_m
    chord = way_m if curvature_per_m == 0.0 else 2.0 * sin(half) / curvature_per_m
    x, y, heading = pose
    return (
        x + chord * cos(heading + half), y + chord * sin(heading + half), heading + 2.0 * half
    )  # fmt: skip


@njit(cache=True)
def _cell(pose: tuple[float, float, float], half_side_m: float, grid: Grid) -> int:
    """The flat index of a pose's cell of (x, y, heading)."""
    x, y, heading = pose
    count = ceil(2.0 * half_side_m / grid.cell_m)
    column, row = int((x + half_side_m) / grid.cell_m), int((y + half_side_m) / grid.cell_m)
    turn = floor(heading / (2.0 * pi) * grid.headings + 0.5) % grid.headings
    return (row * count + column) * grid.headings + turn


@njit(cache=True)
def _search(
    circles: Floats, first: Ints, member: Ints, task: Task, grid: Grid, radius_m: float
) -> bool:
    """Best first; True when the goal is near, False when nothing is left to try."""
    side = task.half_side_m
    count = ceil(2.0 * side / grid.cell_m)
    seen = np.zeros(count * count * grid.headings, np.bool_)
    queue = [(0.0, 0.0, task.start)]
    seen[_cell(task.start, side, grid)] = True
    steps = round(grid.motion_m / SAMPLE_M)
    while len(queue) > 0:
        _, cost, pose = heappop(queue)
        for turn in (0.0, 1.0, -1.0):
            for way in (SAMPLE_M, -SAMPLE_M):
                end, free = pose, True
                for _ in range(steps):
                    end = _moved(end, way, turn / radius_m)
                    if not _free(circles, first, member, side, end[0], end[1]):
                        free = False
                        break
                    left = hypot(end[0] - task.goal_m[0], end[1] - task.goal_m[1])
                    if left < task.near_m:
                        return True
                if not free or seen[_cell(end, side, grid)]:
                    continue
                seen[_cell(end, side, grid)] = True
                so_far = cost + grid.motion_m
                left = hypot(end[0] - task.goal_m[0], end[1] - task.goal_m[1])
                heappush(queue, (left + COST_SHARE * so_far, so_far, end))
    return False
