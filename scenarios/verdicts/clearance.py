"""Clearance: the plan-view distance from the outline to obstacles, at 50 Hz."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from scenarios.verdicts.shapes import (
    Footprints,
    Outline,
    Pose,
    bottom_m,
    distances_m,
    footprints,
)
from twin.world import SOFT, Obstacle, Terrain, World

FAMILIES = {"gate_post": "gate", "gate_flank": "gate", "tunnel": "tunnel"}
"""Kinds that are counted apart; all others are plain obstacles."""
NEAR_M = 45.0
"""Obstacles whose centre is farther than this when the list is made may be left out: within a
second the vehicle moves 15 m at most, and nobody asks for distances above 15 m."""
REFRESH_NS = 1_000_000_000
HEIGHT_M = 1.98
"""Of the vehicle, 78 in (published): what hangs higher is no obstacle in plan view."""


@dataclass
class Clearance:
    """The least distance to each family of obstacles, and the distance to the nearest now."""

    world: World
    outline: Outline
    least_m: dict[str, float] = field(default_factory=dict)
    """By family: `gate`, `tunnel`, `other`."""
    least_at: dict[str, Pose] = field(default_factory=dict)
    """Where that was."""
    now_m: float = math.inf
    """To the nearest obstacle of any family; right up to 15 m, beyond only a lower bound."""
    _refreshed_ns: int = -REFRESH_NS

    def __post_init__(self) -> None:
        self._around: Sequence[Obstacle] | None = None
        self._look_around((0.0, 0.0, 0.0))
        self._near, self._names = self._select(np.zeros(len(self._family), dtype=bool))

    def _look_around(self, pose: Pose) -> None:
        around = self.world.around(*pose[:2])
        if around is self._around:
            return
        self._around, obstacles = around, in_the_way(around, self.world.terrain)
        self._all = footprints(obstacles)
        self._center = self._all.corner_m.mean(axis=1)
        self._reach = _reach_m(self._all, self._center)
        self._family = [FAMILIES.get(o.kind, "other") for o in obstacles]

    def observe(self, time_ns: int, pose: Pose) -> None:
        """Take the pose of the reference point."""
        if time_ns - self._refreshed_ns >= REFRESH_NS:
            self._look_around(pose)
            gap = np.hypot(*(self._center - pose[:2]).T) - self._reach
            self._near, self._names = self._select(gap < NEAR_M)
            self._refreshed_ns = time_ns
        distances = distances_m(self.outline, pose, self._near).tolist()
        self.now_m = min(distances, default=math.inf)
        for family, distance in zip(self._names, distances, strict=True):
            if distance < self.least_m.get(family, math.inf):
                self.least_m[family], self.least_at[family] = distance, pose

    def _select(self, mask: NDArray[np.bool_]) -> tuple[Footprints, list[str]]:
        names = [self._family[k] for k in np.flatnonzero(mask)]
        return Footprints(self._all.corner_m[mask], self._all.radius_m[mask]), names


def _reach_m(shapes: Footprints, center: NDArray[np.float64]) -> NDArray[np.float64]:
    """Radius of the disc around each centre that holds the shape, shape (n,)."""
    offset = shapes.corner_m - center[:, None]
    return np.hypot(offset[..., 0], offset[..., 1]).max(axis=1, initial=0.0) + shapes.radius_m


def in_the_way(obstacles: Sequence[Obstacle], terrain: Terrain) -> list[Obstacle]:
    """What counts in plan view: neither soft, nor a roof high enough to drive under."""
    hard = [obstacle for obstacle in obstacles if obstacle.kind not in SOFT]
    place = np.array([obstacle.center_m for obstacle in hard]).reshape(-1, 3)
    ground = terrain.height(place[:, 0], place[:, 1]).tolist()
    return [o for o, z in zip(hard, ground, strict=True) if bottom_m(o) < z + HEIGHT_M]
