"""A way around what the steering controller cannot leave: traps, and forks with a dead end.

The paper says of its own failures that "the obstacle avoidance algorithm is not sufficient in
finding a path through a very complicated environment". Beyond the paper, a vehicle that was stopped
asks the map: A* (Hart, Nilsson and Raphael 1968) over its cells, unknown ground taken for free,
gives a nearer goal point to steer for, and the steering controller remains as it is.
"""

from collections.abc import Sequence
from heapq import heappop, heappush
from itertools import pairwise
from math import dist, hypot

import numpy as np
from numpy.typing import NDArray

from nav.planning.boundaries import REAL
from nav.planning.scanning import Boundaries

_DIAGONAL = 2.0**0.5

Point = tuple[float, float]


def way_around(wide: Boundaries, start_m: Point, goal_m: Point) -> list[Point]:
    """Points, in frame N, of a shortest way from start to goal outside the real boundary.

    Empty where there is none. The start may lie inside a boundary.
    """
    free = wide.level < REAL
    start, goal = _cell(wide, start_m), _cell(wide, goal_m)
    if start is None or goal is None or not free[goal]:
        return []
    return [_place(wide, cell) for cell in _shortest(free, start, goal)]


def target(way: Sequence[Point], start_m: Point, reach_m: float) -> Point:
    """The point of a way that is `reach_m` of it farther along than the one nearest to a place."""
    nearest = min(range(len(way)), key=lambda k: dist(way[k], start_m))
    left_m = reach_m
    for point, after in pairwise(way[nearest:]):
        if left_m <= 0.0:
            return point
        left_m -= dist(point, after)
    return way[-1]


def ahead(way: list[Point], boundaries: Boundaries, start_m: Point, reach_m: float) -> Point | None:
    """The farthest point of the way within reach that is in plain view; None without a way."""
    if not way:
        return None
    seen = way[min(1, len(way) - 1)]
    for point in way[1:]:
        if dist(point, start_m) > reach_m:
            break
        if _in_view(boundaries, start_m, point):
            seen = point
    return seen


def _in_view(boundaries: Boundaries, a: Point, b: Point) -> bool:
    """Whether the straight line is outside the real boundary, once it has left it."""
    t = np.linspace(0.0, 1.0, 2 + int(hypot(b[0] - a[0], b[1] - a[1]) / boundaries.cell_m))
    level = boundaries.at(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) >= REAL
    return not bool(level[int(np.argmin(level)) :].any())


def _cell(wide: Boundaries, at_m: Point) -> tuple[int, int] | None:
    row = int((at_m[1] - wide.origin_m[1]) // wide.cell_m)
    column = int((at_m[0] - wide.origin_m[0]) // wide.cell_m)
    inside = 0 <= row < len(wide.level) and 0 <= column < len(wide.level)
    return (row, column) if inside else None


def _place(wide: Boundaries, cell: tuple[int, int]) -> Point:
    (x, y), size = wide.origin_m, wide.cell_m
    return x + (cell[1] + 0.5) * size, y + (cell[0] + 0.5) * size


def _shortest(
    free: NDArray[np.bool_], start: tuple[int, int], goal: tuple[int, int]
) -> list[tuple[int, int]]:
    """A* on the eight neighbours, in flat indices of a grid with a closed rim."""
    wide = free.shape[1] + 2
    padded = np.zeros((free.shape[0] + 2, wide), bool)
    padded[1:-1, 1:-1] = free
    is_free = padded.ravel().tolist()
    here, there = ((row + 1) * wide + column + 1 for row, column in (start, goal))
    steps = [(1, 1.0), (-1, 1.0), (wide, 1.0), (-wide, 1.0)]
    steps += [(a + b, _DIAGONAL) for a in (1, -1) for b in (wide, -wide)]
    cost, before, queue = {here: 0.0}, {here: here}, [(0.0, here)]
    done: set[int] = set()
    while queue:
        cell = heappop(queue)[1]
        if cell == there:
            return _back(before, there, wide)
        if cell in done:
            continue
        done.add(cell)
        for step, length in steps:
            beside, way = cell + step, cost[cell] + length
            if is_free[beside] and way < cost.get(beside, np.inf):
                cost[beside], before[beside] = way, cell
                heappush(queue, (way + _octile(beside, there, wide), beside))
    return []


def _octile(a: int, b: int, wide: int) -> float:
    """Shortest way on eight neighbours if all were free."""
    rows, columns = abs(a // wide - b // wide), abs(a % wide - b % wide)
    return max(rows, columns) + (_DIAGONAL - 1.0) * min(rows, columns)


def _back(before: dict[int, int], cell: int, wide: int) -> list[tuple[int, int]]:
    way = [cell]
    while before[cell] != cell:
        cell = before[cell]
        way.append(cell)
    return [(k // wide - 1, k % wide - 1) for k in reversed(way)]
