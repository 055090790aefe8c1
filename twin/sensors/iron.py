"""Steel beside the track: it bends the Earth's field, and with it what a compass calls north."""

from collections.abc import Sequence
from math import atan2

import numpy as np

from twin.sensors.parameters import CompassParameters
from twin.sensors.sensor import Floats, Ints
from twin.world import METAL, Obstacle


class Iron:
    """All things of steel, each disturbing the field as a ball would that it magnetises.

    Outside a ball of radius a, induced by the horizontal field B towards the north, the disturbance
    at r from its middle is (a / r)^3 (3 (B . r) r - B), with the unit vector r (a dipole's field).
    The ball is put where the thing is nearest.
    """

    def __init__(self, obstacles: Sequence[Obstacle], p: CompassParameters) -> None:
        self.things = obstacles
        steel = [o for o in obstacles if o.kind in METAL]
        self._p = p
        self._middle = np.array([o.center_m for o in steel]).reshape(-1, 3)
        self._half = np.array([o.half_size_m for o in steel]).reshape(-1, 3)
        self._yaw = np.array([_yaw(o.quat) for o in steel])
        self._radius_m = p.metal_share * np.cbrt(8.0 * self._half.prod(axis=1))

    def turn_rad(self, position: Floats) -> float:
        """By how much north is turned at a place (3,), counter-clockwise, [rad]."""
        near = np.abs(self._middle - position)[:, :2].max(axis=1, initial=0.0)
        reach = self._half.max(axis=1, initial=0.0) + self._p.metal_range_m
        index = np.flatnonzero(near < reach)
        if not len(index):
            return 0.0
        east, north = self._disturbance(index, position)
        return atan2(-east, 1.0 + north)

    def _disturbance(self, index: Ints, position: Floats) -> tuple[float, float]:
        """Of the horizontal field, as shares of it, east and north."""
        c, s = np.cos(self._yaw[index]), np.sin(self._yaw[index])
        away, half = position - self._middle[index], self._half[index]
        x, y = c * away[:, 0] + s * away[:, 1], c * away[:, 1] - s * away[:, 0]
        local = np.stack([x, y, away[:, 2]], axis=1)
        gap = local - np.clip(local, -half, half)
        radius = self._radius_m[index]
        distance = np.linalg.norm(gap, axis=1) + radius
        near = distance < self._p.metal_range_m
        unit = gap / np.maximum(np.linalg.norm(gap, axis=1), 1e-6)[:, None]
        east, north = c * unit[:, 0] - s * unit[:, 1], s * unit[:, 0] + c * unit[:, 1]
        strength = near * (radius / distance) ** 3
        x, y = (strength * 3.0 * north * east).sum(), (strength * (3.0 * north * north - 1.0)).sum()
        share = min(1.0, self._p.metal_limit / max(float(np.hypot(x, y)), 1e-9))
        return float(share * x), float(share * y)


def _yaw(quat: tuple[float, float, float, float]) -> float:
    w, x, y, z = quat
    return atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
