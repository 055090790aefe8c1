"""What stands on a course: bales, tires, cars, traps, strips, rocks, as boxes and cylinders.

Sizes are estimated. Every part goes into the ground far enough to leave no gap on a slope.
"""

from math import asin, atan2, cos, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from scenarios.geometry import Pose
from twin.world import Obstacle, Terrain

Quat = tuple[float, float, float, float]

SUNK_M = 0.4
CAR_HALF_M = (2.3, 0.9)
"""Half length and half width of a parked car."""
BALE_HALF_M = (0.5, 0.23)
"""A small rectangular bale, lying; 0.42 m high: below the level LIDAR."""
BALE_HEIGHT_M = 0.42
TIRE_RADIUS_M = 0.34
BEAM_HALF_M = (0.75, 0.07, 0.07)
"""One of the three beams of a tank trap."""
ROOF_M, ROOF_THICKNESS_M = 3.0, 0.3
WALL_THICKNESS_M = 0.15
STRIP_HALF_M = (0.06, 2.2, 0.02)


def generator(seed: int, name: str) -> np.random.Generator:
    """The generator of one consumer: another consumer changes none of its numbers."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=tuple(name.encode())))


def ground_m(terrain: Terrain, x: float, y: float) -> float:
    """Height of the ground at one place, [m]."""
    return float(terrain.height(np.array(x), np.array(y)))


def extent_m(half: tuple[float, float], yaw_rad: float) -> float:
    """How far a rectangle turned by `yaw_rad` reaches to each side of its middle, [m]."""
    return half[0] * abs(sin(yaw_rad)) + half[1] * abs(cos(yaw_rad))


class Site(NamedTuple):
    """Where one thing is put together, and what it is."""

    name: str
    kind: str
    terrain: Terrain
    pose: Pose

    def box(
        self, part: str, pose: Pose, half_m: tuple[float, float], top_m: float,
        bottom_m: float = -SUNK_M,
    ) -> Obstacle:  # fmt: skip
        """An upright box from `bottom_m` to `top_m` above the ground at its middle."""
        half = (*half_m, (top_m - bottom_m) / 2.0)
        z = ground_m(self.terrain, pose.x, pose.y) + (top_m + bottom_m) / 2.0
        return self._part(part, "box", (pose.x, pose.y, z), half, yaw(pose.heading))

    def cylinder(self, part: str, pose: Pose, radius_m: float, top_m: float) -> Obstacle:
        """An upright cylinder that ends `top_m` above the ground at its middle."""
        half = (radius_m, radius_m, (top_m + SUNK_M) / 2.0)
        z = ground_m(self.terrain, pose.x, pose.y) + (top_m - SUNK_M) / 2.0
        return self._part(part, "cylinder", (pose.x, pose.y, z), half, yaw(0.0))

    def _part(
        self, part: str, shape: str, center: tuple[float, float, float],
        half: tuple[float, float, float], quat: Quat,
    ) -> Obstacle:  # fmt: skip
        name = f"{self.name}_{part}" if part else self.name
        return Obstacle(name, self.kind, shape, center, half, quat, owner=self.name)

    def car(self) -> list[Obstacle]:
        """Body and cabin, 4.6 x 1.8 x 1.45 m, with 0.18 m of clearance."""
        body = self.box("body", self.pose, CAR_HALF_M, 0.85, 0.18)
        return [body, self.box("cabin", self.pose.moved(-0.25, 0.0), (1.2, 0.8), 1.45, 0.80)]

    def bales(self, layers: int) -> list[Obstacle]:
        """Two bales end to end, across the heading, in layers."""
        top = layers * BALE_HEIGHT_M
        ends = (("left", BALE_HALF_M[0]), ("right", -BALE_HALF_M[0]))
        across = pi / 2.0
        return [
            self.box(part, self.pose.moved(0.0, left, across), BALE_HALF_M, top)
            for part, left in ends
        ]

    def tires(self) -> list[Obstacle]:
        """Three stacks of four tires, side by side across the heading."""
        row = (("left", 0.7), ("middle", 0.0), ("right", -0.7))
        return [self.cylinder(part, self.pose.moved(0.0, left), TIRE_RADIUS_M, 0.85)
                for part, left in row]  # fmt: skip

    def tank_trap(self) -> list[Obstacle]:
        """Three beams at right angles to each other, standing on three of their ends."""
        x, y, heading = self.pose
        rise = 1.0 / sqrt(3.0)
        z = ground_m(self.terrain, x, y) + BEAM_HALF_M[0] * rise
        return [
            self._part(f"beam_{k}", "box", (x, y, z), BEAM_HALF_M,
                       times(yaw(heading + 2.0 * pi * k / 3.0), _pitch(-asin(rise))))
            for k in range(3)
        ]  # fmt: skip

    def passage(self, middle: Pose, half_length_m: float, width_m: float) -> list[Obstacle]:
        """Two walls and a roof along a heading; the width is free between the walls."""
        wall = half_length_m, WALL_THICKNESS_M / 2.0
        left = width_m / 2.0 + wall[1]
        top = ROOF_M + ROOF_THICKNESS_M
        roof = half_length_m, width_m / 2.0 + WALL_THICKNESS_M
        return [
            self.box("wall_left", middle.moved(0.0, left), wall, top),
            self.box("wall_right", middle.moved(0.0, -left), wall, top),
            self.box("roof", middle, roof, top, ROOF_M),
        ]

    def rumble_strips(self, count: int = 5, spacing_m: float = 0.6) -> list[Obstacle]:
        """Bars across the track, 2 cm high, that lie on the ground."""
        return [
            self._strip(f"{k}", self.pose.moved((k - (count - 1) / 2.0) * spacing_m, 0.0))
            for k in range(count)
        ]

    def _strip(self, part: str, pose: Pose) -> Obstacle:
        reach = STRIP_HALF_M[1]
        left, right = (ground_m(self.terrain, *pose.at(0.0, side)) for side in (reach, -reach))
        quat = times(yaw(pose.heading), _roll(atan2(left - right, 2.0 * reach)))
        return self._part(part, "box", (pose.x, pose.y, (left + right) / 2.0), STRIP_HALF_M, quat)


def yaw(angle: float) -> Quat:
    """Turn about the upward axis."""
    return cos(angle / 2.0), 0.0, 0.0, sin(angle / 2.0)


def _pitch(angle: float) -> Quat:
    return cos(angle / 2.0), 0.0, sin(angle / 2.0), 0.0


def _roll(angle: float) -> Quat:
    return cos(angle / 2.0), sin(angle / 2.0), 0.0, 0.0


def times(a: Quat, b: Quat) -> Quat:
    """The rotation b followed by a (Hamilton's product)."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )
