"""Ultrasonic rangers: the nearest echo within a cone."""

import numpy as np
from numpy.typing import NDArray

from nav.messages import SonarScan
from twin.raycast import GROUND, cast_hits
from twin.sensors.parameters import MountingParameters, SonarParameters
from twin.sensors.sensor import Floats, View, draw_mounting, generator, schedule
from twin.sensors.sight import Rays, Sight

_RIM = 6
"""Rays on the rim of the cone, besides the one along its axis."""


class Sonar:
    """All sonars of the vehicle, heard together in one round.

    Whatever stands on the ground throws an echo. The ground does so only where a ray meets it
    steeply: flat sound is mirrored away.
    """

    name = "sonar"

    def __init__(
        self, sight: Sight, seed: int, p: SonarParameters, mounting: MountingParameters
    ) -> None:
        self.schedule = schedule(p)
        self._p, self._sight = p, sight
        self._scene = sight.solid
        self._rng = generator(seed, self.name)
        self._mountings = {unit: draw_mounting(self._rng, mounting) for unit in p.units}
        self._cone = _cone(p.half_cone_rad)

    def measure(self, view: View, time_ns: int) -> SonarScan:
        """The round of this instant."""
        p = self._p
        true_m = self._nearest(view)
        noise_m = p.noise_sd_m * self._rng.standard_normal(len(true_m))
        heard_m = np.clip(true_m + noise_m, p.min_range_m, p.max_range_m)
        return SonarScan(time_ns, np.where(true_m < p.max_range_m, heard_m, p.max_range_m))

    def _nearest(self, view: View) -> Floats:
        """Distance (n,) [m] of what throws each unit's first echo."""
        poses = [m.pose(view, f"sonar_{unit}") for unit, m in self._mountings.items()]
        origins, rotations = (np.array(part) for part in zip(*poses, strict=True))
        limit = self._p.max_range_m
        range_m, what = cast_hits(self._scene, origins, self._cone, limit, rotations)
        unit, ray = np.nonzero(what == GROUND)
        if len(unit):
            directions = np.einsum("kij,kj->ki", rotations[unit], self._cone[ray])
            points = origins[unit] + range_m[unit, ray, None] * directions
            mirrored = ~self._ground_echoes(points, directions)
            range_m[unit[mirrored], ray[mirrored]] = limit
        if veil := self._sight.veil:
            rays = Rays(origins, self._cone, rotations)
            range_m = veil.hide(range_m, rays, limit, self.name, 0.0)
        return range_m.min(axis=1)

    def _ground_echoes(self, points: Floats, directions: Floats) -> NDArray[np.bool_]:
        """Whether the ground throws an echo (n,), where rays meet it at points (n, 3)."""
        normals = self._scene.ground_normals(points[:, 0], points[:, 1])
        steepness = -np.sum(directions * normals, axis=1)
        return steepness >= np.sin(self._p.ground_echo_rad)


def _cone(half_angle_rad: float) -> Floats:
    """Unit directions (1 + _RIM, 3) about x: its axis and its rim."""
    around = np.arange(_RIM) * (2.0 * np.pi / _RIM)
    c, s = np.cos(half_angle_rad), np.sin(half_angle_rad)
    rim = np.stack([np.full(_RIM, c), s * np.cos(around), s * np.sin(around)], axis=1)
    return np.concatenate([[[1.0, 0.0, 0.0]], rim])
