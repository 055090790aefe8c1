"""The corridor's edges on a lattice, as boundaries: real and safe.

The corridor is the union of the segments' rectangles and the discs at their waypoints: all places
nearer to a segment than its half-width. It is laid together from short pieces, each drawn once, so
that a map that moves on by some metres costs next to nothing. A cell's level depends on its place
only, not on when or in which window it was drawn.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import ceil, floor, hypot
from typing import NamedTuple

import numpy as np

from nav.fusion.lattice import Lattice
from nav.messages import Floats
from nav.planning.boundaries import FREE, Cells

PIECE_M = 16.0
"""The longest piece of a segment: a long diagonal one would fill too large a window ..."""
BEYOND_M = 16.0
"""... and so would a wide one: no window reaches farther than this beyond the lattice."""
SHORTEST_M = 1e-9
"""Of a piece between two waypoints at one place."""

Point = tuple[float, float]


class Piece(NamedTuple):
    """A piece of a segment, [m]."""

    start_m: Point
    end_m: Point
    half_width_m: float


class Window(NamedTuple):
    """Rows [south, north) and columns [west, east) of the plane's cells."""

    south: int
    north: int
    west: int
    east: int

    def within(self, other: "Window") -> "Window":
        """What both have in common; empty where `north` or `east` is the smaller."""
        return Window(
            max(self.south, other.south), min(self.north, other.north),
            max(self.west, other.west), min(self.east, other.east),
        )  # fmt: skip

    def lies_in(self, other: "Window") -> bool:
        """Whether the other has all of its cells."""
        return self == self.within(other)


class Drawing(NamedTuple):
    """How many boundaries of one piece's edge each cell of a window is inside of."""

    window: Window
    level: Cells
    whole: bool
    """Whether the window holds all that the piece reaches."""


class CorridorGrid:
    """The corridor on lattices whose cells are of one size.

    Args:
        position_m: waypoints, shape (n, 2).
        half_width_m: shape (n - 1,) or more, of the segment that starts at the waypoint.
        margin_m: the boundaries begin this far inside the edge, from the outermost, SAFE, inwards.
    """

    def __init__(self, position_m: Floats, half_width_m: Floats, margin_m: Sequence[float]) -> None:
        self._position_m, self._half_width_m = position_m, half_width_m
        self._margin_m = tuple(margin_m)
        self._drawn: dict[Piece, Drawing] = {}
        """All of the last call."""

    def levels(self, lattice: Lattice, first: int, last: int) -> Cells:
        """How many boundaries of the corridor's edge each cell of a lattice is inside of.

        Segments first..last-1 count.
        """
        pieces = [piece for i in range(first, last) for piece in self._pieces(i)]
        if any(_holds(piece, lattice, self._margin_m[0]) for piece in pieces):
            return np.full((lattice.count, lattice.count), FREE, np.uint8)
        self._drawn = {piece: self._drawing(piece, lattice) for piece in pieces}
        level = np.full((lattice.count, lattice.count), len(self._margin_m), np.uint8)
        seen = _seen(lattice)
        for drawing in self._drawn.values():
            _lay(drawing, level, seen)
        return level

    def _pieces(self, segment: int) -> list[Piece]:
        a, b = self._position_m[segment : segment + 2].tolist()
        half_width = float(self._half_width_m[segment])
        count = max(ceil(hypot(b[0] - a[0], b[1] - a[1]) / PIECE_M), 1)
        ends = [
            (a[0] + k / count * (b[0] - a[0]), a[1] + k / count * (b[1] - a[1]))
            for k in range(count + 1)
        ]
        return [Piece(*two, half_width) for two in pairwise(ends)]

    def _drawing(self, piece: Piece, lattice: Lattice) -> Drawing:
        """As it was drawn, where that reaches far enough."""
        old = self._drawn.get(piece)
        if old is not None and old.whole:
            return old
        all_of_it = _window(piece, lattice.cell_m)
        if old is not None and all_of_it.within(_seen(lattice)).lies_in(old.window):
            return old
        window = all_of_it.within(_seen(lattice, ceil(BEYOND_M / lattice.cell_m)))
        level = _draw(piece, window, lattice.cell_m, self._margin_m)
        return Drawing(window, level, window == all_of_it)


def _window(piece: Piece, cell_m: float) -> Window:
    """The cells that a piece may reach."""
    (ax, ay), (bx, by), r = piece
    return Window(
        floor((min(ay, by) - r) / cell_m), ceil((max(ay, by) + r) / cell_m),
        floor((min(ax, bx) - r) / cell_m), ceil((max(ax, bx) + r) / cell_m),
    )  # fmt: skip


def _seen(lattice: Lattice, beyond: int = 0) -> Window:
    """The cells of a lattice, and some beyond."""
    south, west = lattice.south - beyond, lattice.west - beyond
    size = lattice.count + 2 * beyond
    return Window(south, south + size, west, west + size)


def _holds(piece: Piece, lattice: Lattice, margin_m: float) -> bool:
    """Whether a whole lattice lies inside a piece, and off its edge: as its corners do."""
    reach_m, size_m = piece.half_width_m - margin_m, lattice.count * lattice.cell_m
    if reach_m < 0.5 * size_m:
        return False
    west, south = lattice.origin_m
    corners = [(west + i * size_m, south + j * size_m) for i in (0, 1) for j in (0, 1)]
    return all(_distance_m(piece, *corner) < reach_m for corner in corners)


def _distance_m(piece: Piece, x: float, y: float) -> float:
    (ax, ay), (bx, by), _ = piece
    along_x, along_y = bx - ax, by - ay
    squared = max(along_x * along_x + along_y * along_y, SHORTEST_M**2)
    t = min(max(((x - ax) * along_x + (y - ay) * along_y) / squared, 0.0), 1.0)
    return hypot(x - ax - t * along_x, y - ay - t * along_y)


def _draw(piece: Piece, window: Window, cell_m: float, margin_m: Sequence[float]) -> Cells:
    """The levels of a window's cells, by how far inside the piece's edge their centres lie."""
    (ax, ay), (bx, by), half_width = piece
    length = max(hypot(bx - ax, by - ay), SHORTEST_M)
    c, s = (bx - ax) / length, (by - ay) / length
    x = ((np.arange(window.west, window.east) + 0.5) * cell_m - ax).astype(np.float32)[None, :]
    y = ((np.arange(window.south, window.north) + 0.5) * cell_m - ay).astype(np.float32)[:, None]
    forward, left = c * x + s * y, c * y - s * x
    beyond = np.maximum(np.maximum(-forward, forward - length), 0.0)
    inside = half_width - np.sqrt(beyond * beyond + left * left)
    level = np.zeros(inside.shape, np.uint8)
    for margin in margin_m:
        level += inside < margin
    return level


def _lay(drawing: Drawing, level: Cells, seen: Window) -> None:
    """Where a piece frees cells of the lattice that is seen, they are free."""
    common = drawing.window.within(seen)
    if common.south < common.north and common.west < common.east:
        part = level[_slices(common, seen)]
        np.minimum(part, drawing.level[_slices(common, drawing.window)], out=part)


def _slices(window: Window, of: Window) -> tuple[slice, slice]:
    rows = slice(window.south - of.south, window.north - of.south)
    return rows, slice(window.west - of.west, window.east - of.west)
