"""Ultrasonic rangers: the nearest echo within a cone."""

import numpy as np
from numpy.typing import NDArray

from nav.messages import SonarScan
from twin.raycast import GROUND, cast_hits
from twin.sensors.parameters import MountingParameters, SonarParameters
from twin.sensors.sensor import Floats, Ints, View, draw_mounting, generator, schedule
from twin.sensors.sight import ByKind, Rays, Sight

SMOOTH = frozenset({"car", "tunnel", "gate_flank"})
"""Kinds of thing with smooth faces."""
_RIM = 6
"""Rays on the rim of the cone, besides the one along its axis."""


class Sonar:
    """All sonars of the vehicle, heard together in one round.

    Whatever stands on the ground throws an echo, but for smooth faces that are met at a flat angle:
    they mirror the sound away, edges and all that is rough do not. So does the ground. Now and then
    a unit hears another's pulse: too near.
    """

    name = "sonar"

    def __init__(
        self, sight: Sight, seed: int, p: SonarParameters, mounting: MountingParameters
    ) -> None:
        self.schedule = schedule(p)
        self._p, self._sight = p, sight
        self._scene = sight.solid
        self._rng = generator(seed, self.name)
        self._cross = generator(seed, f"{self.name} cross-talk")
        self._smooth = ByKind(sight, dict.fromkeys(SMOOTH, True), False, False, False)
        self._mountings = {unit: draw_mounting(self._rng, mounting) for unit in p.units}
        self._cone = _cone(p.half_cone_rad)

    def measure(self, view: View, time_ns: int) -> SonarScan:
        """The round of this instant."""
        p = self._p
        true_m = self._crossed(self._nearest(view))
        noise_m = p.noise_sd_m * self._rng.standard_normal(len(true_m))
        heard_m = np.clip(true_m + noise_m, p.min_range_m, p.max_range_m)
        return SonarScan(time_ns, np.where(true_m < p.max_range_m, heard_m, p.max_range_m))

    def _crossed(self, true_m: Floats) -> Floats:
        """Distances (n,) [m], some of them cut short by the pulse of another unit."""
        p, drawn = self._p, self._cross.random((2, len(true_m)))
        heard_m = p.min_range_m + drawn[1] * (true_m - p.min_range_m)
        return np.where(drawn[0] < p.cross_talk, np.minimum(heard_m, true_m), true_m)

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
        self._mirror(range_m, what)
        if veil := self._sight.veil:
            rays = Rays(origins, self._cone, rotations)
            veil.hide(range_m, rays, limit, self.name, np.zeros(range_m.shape))
        return range_m.min(axis=1)

    def _mirror(self, range_m: Floats, what: Ints) -> None:
        """Take away what smooth faces mirror: where a whole cone, ranges (n, 7), meets one thing,
        the ranges across it say at which angle."""
        one = self._smooth.of(what).all(axis=1) & (what == what[:, :1]).all(axis=1)
        for unit in np.flatnonzero(one):
            axis_m, rim_m = range_m[unit, 0], range_m[unit, 1:]
            across = (rim_m[:3] - rim_m[3:]) / (2.0 * axis_m * np.sin(self._p.half_cone_rad))
            tangent = np.sqrt(2.0 / 3.0 * across @ across)
            if tangent > np.tan(self._p.mirror_rad):
                range_m[unit] = self._p.max_range_m

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
