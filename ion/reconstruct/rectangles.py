"""Points in the plane as few rectangles: the smallest one around them, cut until they fill it."""

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ion.reconstruct.tally import Ints
from nav.messages import Floats

LEAST_M = 0.2
"""No side is taken for less: a wall that one beam in ten meets has no thickness of its own."""
SOLID_M = (5.0, 2.5)
"""A thing that is no longer and no wider, as a car, is solid: nobody sees its inside."""
FULL = 0.5
"""Share of any other rectangle that its points must cover ..."""
WALL_M, PAYS = 0.8, 0.7
"""... but for what is no wider than this, and would not be smaller by more than so much in two: a
wall, of which both faces are seen, or one."""
EDGE_M = 0.1
"""So near to an edge is on it."""
STRAY = 0.02
"""Share of the points that may lie outside of each long side."""
TURNS = np.radians(np.arange(0.0, 90.0, 1.0))


class Rectangle(NamedTuple):
    """In the plane, [m] and [rad]."""

    x: float
    y: float
    half_length: float
    half_width: float
    heading: float
    """Of its longer side."""

    @property
    def area_m2(self) -> float:
        """With no side below `LEAST_M`."""
        return max(2.0 * self.half_length, LEAST_M) * max(2.0 * self.half_width, LEAST_M)

    def inside(self, point_m: Floats) -> Floats:
        """Points (n, 2) as seen from its middle, along its sides, shape (n, 2)."""
        return turned(point_m - (self.x, self.y), self.heading)

    def corners_m(self) -> Floats:
        """Shape (4, 2), around it."""
        signs = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)], dtype=float)
        half = signs * (self.half_length, self.half_width)
        return turned(half, -self.heading) + np.array((self.x, self.y))

    def distance_m(self, point_m: Floats) -> Floats:
        """From its edge to points (n, 2), shape (n,); 0 inside."""
        out = np.abs(self.inside(point_m)) - (self.half_length, self.half_width)
        return np.hypot(*np.maximum(out, 0.0).T)


def pieces(point_m: Floats, cell_m: float) -> list[Ints]:
    """Which of the points make up each of few rectangles that they fill.

    Args:
        point_m: shape (n, 2), n at least 1.
        cell_m: of the square that each point stands for.
    """
    found: list[Ints] = []
    due = [np.arange(len(point_m))]
    if _is_small(smallest(point_m)):
        return due
    while due:
        piece = due.pop()
        first = _parted(point_m[piece], cell_m)
        if first is None:
            found.append(piece)
        else:
            due += [piece[~first], piece[first]]
    return found


def _parted(point_m: Floats, cell_m: float) -> NDArray[np.bool_] | None:
    """Which of the points make up the first of two pieces; None where one rectangle will do."""
    whole = smallest(point_m)
    if len(point_m) == 1 or len(point_m) * cell_m * cell_m >= FULL * whole.area_m2:
        return None
    area, first = _cut(point_m)
    straight = 2.0 * whole.half_width <= WALL_M and area > PAYS * whole.area_m2
    return None if straight else first


def smallest(point_m: Floats) -> Rectangle:
    """The smallest rectangle around points (n, 2), but for a few on its long sides: those of a
    drifting estimate would turn it, and widen it.

    Of two sides of a box, the rectangle along their ends is no larger than that along the sides; so
    it counts as well how near the points are to its edges (Zhang et al. 2017, L-shape fitting).
    """
    along = np.stack([turned(point_m, angle) for angle in TURNS.tolist()], axis=-1)
    low, high = _most(along)
    sides, gap = high - low + LEAST_M, np.minimum(np.abs(along - low), np.abs(high - along))
    best = int(np.argmin(sides[0] * sides[1] * (gap.min(axis=1).mean(axis=0) + EDGE_M)))
    heading = float(TURNS[best])
    if sides[1, best] > sides[0, best]:
        heading += pi / 2.0
    return _around(point_m, heading)


def turned(point_m: Floats, angle_rad: float) -> Floats:
    """Points (n, 2) in axes that are turned to the left."""
    c, s = cos(angle_rad), sin(angle_rad)
    return point_m @ np.array([[c, -s], [s, c]])


def _most(place_m: Floats) -> tuple[Floats, Floats]:
    """From where to where places lie, along the first axis, but for the strays."""
    low = np.quantile(place_m, STRAY, axis=0, method="lower")
    return low, np.quantile(place_m, 1.0 - STRAY, axis=0, method="higher")


def _around(point_m: Floats, heading: float) -> Rectangle:
    """The rectangle that lies so."""
    along, across = turned(point_m, heading).T
    low, high = (float(v) for v in _most(across))
    first, last = float(along.min()), float(along.max())
    x, y = turned(np.array([[first + last, low + high]]) / 2.0, -heading)[0].tolist()
    return Rectangle(x, y, (last - first) / 2.0, (high - low) / 2.0, heading)


def _is_small(whole: Rectangle) -> bool:
    return 2.0 * whole.half_length <= SOLID_M[0] and 2.0 * whole.half_width <= SOLID_M[1]


def _cut(point_m: Floats) -> tuple[float, NDArray[np.bool_]]:
    """The straight cut that leaves the least area in two rectangles along it.

    Args:
        point_m: shape (n, 2), n at least 2.

    Returns:
        The area [m^2], and which of the points lie before the cut.
    """
    best, before = np.inf, np.zeros(len(point_m), bool)
    for angle in (*TURNS[::3], *(TURNS[::3] + pi / 2.0)):
        along, across = turned(point_m, float(angle)).T
        area, at_m = _least_area(along, across)
        if area < best:
            best, before = area, along < at_m
    return best, before


def _least_area(along_m: Floats, across_m: Floats) -> tuple[float, float]:
    """Of all cuts across one side: the area that is left [m^2], and where it is cut [m]."""
    order = np.argsort(along_m, kind="stable")
    along, across = along_m[order], across_m[order]
    low, high = np.minimum.accumulate(across), np.maximum.accumulate(across)
    low_after = np.minimum.accumulate(across[::-1])[::-1]
    high_after = np.maximum.accumulate(across[::-1])[::-1]
    before = (along[:-1] - along[0] + LEAST_M) * (high - low + LEAST_M)[:-1]
    after = (along[-1] - along[1:] + LEAST_M) * (high_after - low_after + LEAST_M)[1:]
    area = np.where(along[:-1] < along[1:], before + after, np.inf)
    k = int(np.argmin(area))
    return float(area[k]), float(along[k + 1])
