"""The same scene for Embree: everything as triangles."""

from collections.abc import Iterator
from functools import lru_cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twin.raycast.geometry import BOX, Floats, Geometry, Ground

Singles = NDArray[np.float32]
Triangles = NDArray[np.int32]
Mesh = tuple[Floats, Triangles]
"""Vertices (n, 3) [m] and the triangles (m, 3) between them."""

MISSING = (
    "embree_over_ours is null: embreex is not installed;"
    " expected the extra: pip install 'ion-twin[bench]'"
)
SIDES = 32
"""Of a cylinder: a prism, within half a percent of its radius."""


def is_installed() -> bool:
    """Whether there is an Embree to compare with."""
    return find_spec("embreex") is not None


class Embree:
    """A scene as Embree has it, its search tree already built."""

    def __init__(self, geometry: Geometry) -> None:
        from embreex.mesh_construction import TriangleMesh  # pyright: ignore[reportMissingImports]
        from embreex.rtcore_scene import EmbreeScene  # pyright: ignore[reportMissingImports]

        vertices, triangles = mesh(geometry)
        self._scene: Any = EmbreeScene()
        TriangleMesh(self._scene, vertices.astype(np.float32), triangles)
        ray = np.zeros((1, 3), np.float32)
        self._scene.run(ray, ray + 1.0)  # builds the tree

    def cast(self, origins: Singles, directions: Singles, max_range_m: float) -> Singles:
        """Ranges (n,) [m] from origins (n, 3) along unit directions (n, 3); max_range_m: none."""
        return self._scene.run(origins, directions, dists=max_range_m, query="DISTANCE")


def mesh(geometry: Geometry) -> Mesh:
    """The ground, and all solids that our own rays find on it."""
    meshes = [_ground(geometry.ground), *_solids(geometry)]
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in meshes)])
    vertices = np.concatenate([vertices for vertices, _ in meshes])
    parts = [part + start for (_, part), start in zip(meshes, starts, strict=False)]
    return vertices, np.concatenate(parts).astype(np.int32)


def _ground(ground: Ground) -> Mesh:
    n = len(ground.z)
    along = ground.spacing * np.arange(n)
    x, y = np.meshgrid(ground.x0 + along, ground.y0 + along)
    vertices = np.stack([x, y, ground.z], axis=-1, dtype=np.float64)
    return vertices.reshape(-1, 3), _lattice(n)


@lru_cache(maxsize=1)
def _lattice(n: int) -> Triangles:
    """The triangles of n x n points, along the diagonal (i, j) to (i + 1, j + 1)."""
    point = np.arange(n * n).reshape(n, n)
    a, b, c, d = point[:-1, :-1], point[:-1, 1:], point[1:, 1:], point[1:, :-1]
    halves = [np.stack(half, axis=-1).reshape(-1, 3) for half in ((a, b, c), (a, c, d))]
    return np.concatenate(halves).astype(np.int32)


def _solids(geometry: Geometry) -> Iterator[Mesh]:
    for i in np.unique(geometry.members):
        solid = geometry.solids[i]
        vertices, triangles = _prism(4 if solid["shape"] == BOX else SIDES)
        yield solid["center"] + (vertices * solid["half"]) @ solid["axes"], triangles


@lru_cache(maxsize=2)
def _prism(sides: int) -> Mesh:
    """Upright, half sizes 1: that of four sides is a cube, all others have a circle around them."""
    angle = 2.0 * np.pi * (np.arange(sides) + 0.5) / sides
    reach = np.sqrt(2.0) if sides == 4 else 1.0
    x, y, one = reach * np.cos(angle), reach * np.sin(angle), np.ones(sides)
    vertices = np.concatenate([np.stack([x, y, -one], axis=1), np.stack([x, y, one], axis=1)])
    a = np.arange(sides)
    b = (a + 1) % sides
    fan = np.stack([np.zeros(sides - 2, int), a[1:-1], b[1:-1]], axis=1)
    walls = [np.stack([a, b, b + sides], axis=1), np.stack([a, b + sides, a + sides], axis=1)]
    return vertices, np.concatenate([*walls, fan, fan + sides]).astype(np.int32)
