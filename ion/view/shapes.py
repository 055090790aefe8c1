"""Boxes, cylinders and lines, as the page draws them."""

import numpy as np
from numpy.typing import NDArray

from ion.view.ground import Mesh
from nav.messages import Floats

SIDES = 20


def rgb(color: str) -> tuple[int, int, int]:
    """Of `#rrggbb`."""
    return int(color[1:3], 16), int(color[3:5], 16), int(color[5:7], 16)


def box() -> Mesh:
    """From -1 to 1 along each axis, no corner shared, so that edges are sharp."""
    face = np.array([[1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1]], float)
    turns = [np.roll(face, k, axis=1) for k in range(3)]
    sides = [sign * turn for turn in turns for sign in (1.0, -1.0)]
    forth, back = [[0, 1, 2], [0, 2, 3]], [[0, 2, 1], [0, 3, 2]]
    faces = [np.array(back if k % 2 else forth) + 4 * k for k in range(6)]
    return Mesh(np.concatenate(sides), np.concatenate(faces))


def cylinder() -> Mesh:
    """Of radius 1 about z, from -1 to 1."""
    turn = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    ring = np.stack([np.cos(turn), np.sin(turn), np.ones(SIDES)], axis=1)
    vertices = np.concatenate([ring * [1, 1, -1], ring, [[0, 0, -1], [0, 0, 1]]])
    here = np.arange(SIDES)
    there, top, bottom = (here + 1) % SIDES, 2 * SIDES + 1, 2 * SIDES
    faces = [
        np.stack([here, there, there + SIDES], axis=1),
        np.stack([here, there + SIDES, here + SIDES], axis=1),
        np.stack([there, here, np.full(SIDES, bottom)], axis=1),
        np.stack([here + SIDES, there + SIDES, np.full(SIDES, top)], axis=1),
    ]
    return Mesh(vertices, np.concatenate(faces))


def segments(line_m: Floats) -> Floats:
    """A polyline (n, 3) as segments (n - 1, 2, 3)."""
    return np.stack([line_m[:-1], line_m[1:]], axis=1)


def edges(inside: NDArray[np.bool_], origin_m: Floats, cell_m: float) -> Floats:
    """The border of an area of cells, row north, column east: segments (n, 2, 2)."""
    around = np.pad(inside, 1)
    row, column = np.nonzero(around[1:, 1:-1] != around[:-1, 1:-1])
    flat = np.stack([np.stack([column, row], 1), np.stack([column + 1, row], 1)], axis=1)
    row, column = np.nonzero(around[1:-1, 1:] != around[1:-1, :-1])
    upright = np.stack([np.stack([column, row], 1), np.stack([column, row + 1], 1)], axis=1)
    return origin_m + cell_m * np.concatenate([flat, upright])
