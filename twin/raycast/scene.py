"""What rays can meet: a triangulated height grid, and boxes and cylinders."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from twin.raycast.blocks import put_lids, sort_into_blocks
from twin.raycast.geometry import BLOCK, BOX, CYLINDER, SOLID, Floats, Geometry, Ground, Records
from twin.raycast.rays import cast_all, hide_all
from twin.world import Obstacle

BLOCK_CELLS = 20
"""Cells a side of one block, the step through empty air: 8 to 12 m was fastest (measured)."""

_SHAPES = {"box": BOX, "cylinder": CYLINDER}
_AS_GIVEN = np.eye(3)


class Scene:
    """Ground and solids; picklable. The ground is replaced as the vehicle moves."""

    def __init__(self, obstacles: Sequence[Obstacle]) -> None:
        """Take the solids; `set_ground` must follow before the first ray."""
        self.set_solids(obstacles)

    def set_solids(self, obstacles: Sequence[Obstacle]) -> None:
        """Replace the solids; `set_ground` must follow before the next ray.

        Raises:
            ValueError: a shape that is neither box nor cylinder.
        """
        self._solids = _solids(obstacles)

    def set_ground(self, z: Floats, x0: float, y0: float, spacing: float) -> None:
        """Replace the height grid: z (n, n) [m], rows along y, z[0, 0] at x0, y0; spacing [m].

        `z` is kept, not copied: call again after writing into it. Rays end at the grid's edge:
        solids beyond it are not seen either.
        """
        z = np.ascontiguousarray(z, dtype=np.float64)
        if z.ndim != 2 or z.shape[0] != z.shape[1] or z.shape[0] < 2:
            raise ValueError(f"set_ground: z has shape {z.shape}, expected (n, n) with n >= 2")
        count = -(-(z.shape[0] - 1) // BLOCK_CELLS)
        blocks = np.zeros((count, count), BLOCK)
        ground = Ground(z, float(x0), float(y0), float(spacing), BLOCK_CELLS, blocks)
        put_lids(ground)
        self.geometry = Geometry(ground, self._solids, sort_into_blocks(ground, self._solids))

    def ground_normals(self, x: Floats, y: Floats) -> Floats:
        """Unit normals (n, 3), upwards, of the ground's triangles at x, y (n,) [m] in the grid."""
        ground, z = self.geometry.ground, self.geometry.ground.z
        u, v = (x - ground.x0) / ground.spacing, (y - ground.y0) / ground.spacing
        j, i = (np.clip(np.floor(w).astype(np.int64), 0, len(z) - 2) for w in (u, v))
        corner, right, up, across = z[i, j], z[i, j + 1], z[i + 1, j], z[i + 1, j + 1]
        lower_right = u - j >= v - i
        fall_x = np.where(lower_right, corner - right, up - across)
        fall_y = np.where(lower_right, right - across, corner - up)
        normal = np.stack([fall_x, fall_y, np.full(len(x), ground.spacing)], axis=1)
        return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def cast(
    scene: Scene,
    origin: Floats,
    directions: Floats,
    max_range: float,
    rotation: Floats = _AS_GIVEN,
) -> Floats:
    """Ranges (n,) [m] from origin (3,) along unit directions (n, 3); max_range: nothing was hit.

    `rotation` (3, 3) turns the directions into the world frame. A ray that starts inside a solid
    meets its wall from inside; one that starts below the ground has range 0.
    """
    return cast_hits(scene, origin[None], directions, max_range, rotation[None])[0][0]


def cast_hits(
    scene: Scene,
    origins: Floats,
    directions: Floats,
    max_range: float,
    rotations: Floats,
) -> tuple[Floats, NDArray[np.int32]]:
    """As `cast`, from many origins (m, 3), each with its rotation (m, 3, 3): ranges (m, n), and
    what was hit (m, n): index of the obstacle, GROUND or NO_HIT."""
    shape = len(origins), len(directions)
    range_m, what = np.empty(shape), np.empty(shape, np.int32)
    rays = _plain(origins), _plain(rotations), _plain(directions)
    cast_all(scene.geometry, *rays, float(max_range), range_m, what)
    return range_m, what


def hide(
    scene: Scene,
    origins: Floats,
    directions: Floats,
    max_range: float,
    rotations: Floats,
    opacity: Floats,
    drawn: Floats,
    range_m: Floats,
) -> None:
    """Shorten ranges (m, n) [m] of the rays of `cast_hits` that the solids of a scene hold back:
    where `drawn` (m, n) is less than the solid's `opacity`, one of (solids,)."""
    rays = _plain(origins), _plain(rotations), _plain(directions)
    hide_all(scene.geometry, *rays, float(max_range), opacity, drawn, range_m)


def _plain(array: Floats) -> Floats:
    """In the one layout that the rays are compiled for."""
    return np.ascontiguousarray(array, np.float64)


def _solids(obstacles: Sequence[Obstacle]) -> Records:
    """Obstacles as an array (n,) of SOLID.

    Raises:
        ValueError: a shape that is neither box nor cylinder.
    """
    solids = np.zeros(len(obstacles), SOLID)
    for solid, obstacle in zip(solids, obstacles, strict=True):
        if obstacle.shape not in _SHAPES:
            raise ValueError(
                f"obstacle {obstacle.name}: shape {obstacle.shape!r}, expected box or cylinder"
            )
        solid["shape"] = _SHAPES[obstacle.shape]
        solid["center"] = obstacle.center_m
        solid["axes"] = _axes(obstacle.quat)
        solid["half"] = obstacle.half_size_m
        if obstacle.shape == "cylinder":
            solid["half"][1] = obstacle.half_size_m[0]
        solid["reach"] = np.abs(solid["axes"].T) @ solid["half"]
        solid["radius2"] = np.square(solid["half"]).sum() + 1e-9  # above rounding
    return solids


def _axes(quat: tuple[float, float, float, float]) -> Floats:
    """Shape (3, 3): the own axes, one a row, of a body turned by the quaternion w x y z."""
    w, x, y, z = np.array(quat) / np.linalg.norm(quat)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
            [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
