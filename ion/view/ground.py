"""The ground as meshes: fine along the route, coarse around it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ion.view.places import Floats, Places

Bools = NDArray[np.bool_]

BESIDE_M = 16.0
"""Beyond the corridor's edge the ground is fine this far."""
AROUND_M = 150.0
"""The coarse ground goes this far beyond the route."""
FINE, COARSE = 20_000, 4_000
"""Most cells of either."""
BELOW_M = 0.5
"""The coarse ground lies deeper, so that it never shows through the fine one."""


class Mesh(NamedTuple):
    """Triangles."""

    vertex_m: Floats
    """Shape (v, 3)."""
    face: NDArray[np.int64]
    """Shape (f, 3), counter-clockwise from above."""


class Grid(NamedTuple):
    """Square cells along the axes of the world."""

    origin_m: Floats
    """Shape (2,), south-west corner."""
    cell_m: float
    shape: tuple[int, int]
    """Rows north, columns east."""


def fine(places: Places, line_m: Floats, half_width_m: Floats) -> tuple[Mesh, Mesh]:
    """The ground inside the corridor, and that beside it.

    Args:
        places: of the course.
        line_m: waypoints, shape (n, 2), world frame.
        half_width_m: of the corridor from each to the next, shape (n,).
    """
    length_m = float(np.hypot(*np.diff(line_m, axis=0).T).sum())
    area = max(length_m, 1.0) * 2.0 * (BESIDE_M + float(half_width_m.mean()))
    cell_m = max(0.75, float(np.sqrt(area / FINE)))
    grid = _grid(line_m, BESIDE_M + float(half_width_m.max()), cell_m)
    inside = near(grid, line_m, half_width_m)
    beside = near(grid, line_m, half_width_m + BESIDE_M)
    return _mesh(places, grid, inside), _mesh(places, grid, beside & ~inside)


def coarse(places: Places, line_m: Floats) -> Mesh:
    """All around."""
    area = np.prod(np.ptp(line_m, axis=0) + 2.0 * AROUND_M)
    grid = _grid(line_m, AROUND_M, max(6.0, float(np.sqrt(area / COARSE))))
    mesh = _mesh(places, grid, np.ones(grid.shape, bool))
    return mesh._replace(vertex_m=mesh.vertex_m - [0.0, 0.0, BELOW_M])


def near(grid: Grid, line_m: Floats, radius_m: Floats) -> Bools:
    """Which cells have their centre within `radius_m` (n,) of the segments of a line (n, 2)."""
    found = np.zeros(grid.shape, bool)
    for start, end, radius in zip(line_m[:-1], line_m[1:], radius_m, strict=False):
        rows, columns = (_span(grid, axis, start, end, radius) for axis in (1, 0))
        x = grid.origin_m[0] + (np.arange(columns.start, columns.stop) + 0.5) * grid.cell_m
        y = grid.origin_m[1] + (np.arange(rows.start, rows.stop) + 0.5) * grid.cell_m
        found[rows, columns] |= _within(x[None, :], y[:, None], start, end, radius)
    return found


def _within(x: Floats, y: Floats, start: Floats, end: Floats, radius: float) -> Bools:
    (east, north), dx, dy = end - start, x - start[0], y - start[1]
    length2 = max(east * east + north * north, 1e-9)
    along = np.clip((dx * east + dy * north) / length2, 0.0, 1.0)
    return (dx - along * east) ** 2 + (dy - along * north) ** 2 <= radius * radius


def _span(grid: Grid, axis: int, start: Floats, end: Floats, radius: float) -> slice:
    low, high = sorted((start[axis], end[axis]))
    cells = (np.array([low - radius, high + radius]) - grid.origin_m[axis]) / grid.cell_m
    most = grid.shape[1 - axis]
    return slice(max(int(cells[0]), 0), min(int(cells[1]) + 1, most))


def _grid(line_m: Floats, margin_m: float, cell_m: float) -> Grid:
    low, high = line_m.min(axis=0) - margin_m, line_m.max(axis=0) + margin_m
    columns, rows = np.ceil((high - low) / cell_m).astype(int).tolist()
    return Grid(low, cell_m, (rows, columns))


def _mesh(places: Places, grid: Grid, cells: Bools) -> Mesh:
    """Two triangles a cell; only the corners that are used."""
    row, column = np.nonzero(cells)
    width = grid.shape[1] + 1
    corner = row * width + column
    faces = np.concatenate([
        np.stack([corner, corner + 1, corner + width + 1], axis=1),
        np.stack([corner, corner + width + 1, corner + width], axis=1),
    ])  # fmt: skip
    used, face = np.unique(faces, return_inverse=True)
    y, x = np.divmod(used, width)
    corner_m = grid.origin_m + grid.cell_m * np.stack([x, y], axis=1)
    return Mesh(places.on_ground(corner_m), face.reshape(-1, 3))
