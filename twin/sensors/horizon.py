"""The skyline of the ground, coarse, beyond what the ray caster knows."""

import numpy as np

from twin.sensors.sensor import Bools, Floats
from twin.world import Terrain

AZIMUTHS, RINGS = 24, 6
MOVED_M = 25.0
"""Hills far away look the same from a little farther on."""


class Horizon:
    """How high the ground stands against the sky, by azimuth."""

    def __init__(self, terrain: Terrain, from_m: float, to_m: float) -> None:
        """Look at rings of ground from `from_m` to `to_m` away; none where they are the same."""
        self._terrain = terrain
        azimuth = np.arange(AZIMUTHS) * (2.0 * np.pi / AZIMUTHS)
        self._ring_m = np.geomspace(from_m, to_m, RINGS)[:, None] if to_m > from_m else None
        self._east, self._north = np.cos(azimuth), np.sin(azimuth)
        self._azimuth = np.append(azimuth, 2.0 * np.pi)
        self._at_m = np.full(2, np.inf)
        self._elevation = np.full(AZIMUTHS + 1, -np.pi)

    def hides(self, position: Floats, satellites: Floats) -> Bools:
        """Whether the ground hides each satellite, given its azimuth and elevation (n, 2) [rad]."""
        if self._ring_m is not None and not np.hypot(*(position[:2] - self._at_m)) < MOVED_M:
            self._at_m = position[:2].copy()
            self._look(position)
        azimuth = satellites[:, 0] % (2.0 * np.pi)
        return satellites[:, 1] < np.interp(azimuth, self._azimuth, self._elevation)

    def _look(self, position: Floats) -> None:
        x, y, z = position.tolist()
        ring_m = self._ring_m
        assert ring_m is not None
        height = self._terrain.height(x + ring_m * self._east, y + ring_m * self._north)
        elevation = np.arctan2(height - z, ring_m).max(axis=0)
        self._elevation = np.append(elevation, elevation[0])
