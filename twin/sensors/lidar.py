"""SICK LMS 221: ranges of 361 beams in one plane, in counts of a centimetre.

The mirror turns twice for a scan: whole degrees first, then the halves in between. The message
bears the time of the last beam; the vehicle has moved since the first.
"""

from math import sqrt

import numpy as np
from numba import njit
from numpy.typing import NDArray

from nav.messages import LIDAR_COUNT_M, LIDAR_NO_RETURN_COUNT, LidarScan, lidar_range_m
from twin.raycast import cast_hits
from twin.sensors.parameters import LidarParameters, MountingParameters
from twin.sensors.sensor import Floats, Ints, View, draw_mounting, generator, schedule
from twin.sensors.sight import ByKind, Rays, Sight

_ALONG_X = np.array([[1.0, 0.0, 0.0]])
"""Each beam has a frame of its own and looks along its x axis."""


class Lidar:
    """One scanner."""

    def __init__(
        self,
        unit: str,
        sight: Sight,
        seed: int,
        p: LidarParameters,
        mounting: MountingParameters,
    ) -> None:
        self.name = unit
        self.schedule = schedule(p, p.stagger_steps * p.units.index(unit))
        self._p, self._sight = p, sight
        self._rng, self._edges = generator(seed, unit), generator(seed, f"{unit} edges")
        self._mounting = draw_mounting(self._rng, mounting)
        self._bias_m = p.bias_sd_m * self._rng.standard_normal()
        self._fan, self._age_s, self._width = _fan(p), _age_s(p), p.beam_rad / _step_rad(p)
        self._reach_m = _reach_m(p, sight)

    def measure(self, view: View, time_ns: int) -> LidarScan:
        """The scan whose last beam is of this instant."""
        p, rays = self._p, self.rays(view)
        true_m, what = cast_hits(self._sight.solid, *rays[:2], p.max_range_m, rays.rotations)
        _dim(true_m[:, 0], what[:, 0], self._reach_m.values_by_number(), p.max_range_m)
        edge = self._edges.random(p.beams)
        seen_m = _mixed(true_m[:, 0], edge, self._width, p.edge_m, p.pulse_m, p.share)
        if self._sight.veil:  # what leaves hold back is told of whole beams, however wide
            drawn = self._rng.random((p.beams, 1))
            self._sight.veil.hide(seen_m[:, None], rays, p.max_range_m, self.name, drawn)
        noise = self._rng.standard_normal(p.beams)
        counts = _counts(seen_m, noise, self._bias_m, p.noise_sd_m, p.max_range_m)
        return LidarScan(time_ns, self.name, lidar_range_m(counts))

    @property
    def max_range_m(self) -> float:
        """Farther away nothing is seen, [m]."""
        return self._p.max_range_m

    def rays(self, view: View) -> Rays:
        """From where and whereto each beam looked, at its own time."""
        velocity, turn = view.site_velocity(self.name)
        position, rotation = self._mounting.pose(view, self.name)
        looks = self._fan.dot(rotation.T)
        origins, frames = _swept(looks, self._age_s, position, velocity, turn)
        return Rays(origins, _ALONG_X, frames)


@njit(cache=True)
def _swept(
    looks: Floats, age_s: Floats, position: Floats, velocity: Floats, turn: Floats
) -> tuple[Floats, Floats]:
    """Origins (n, 3) and frames (n, 3, 3) of beams that were measured `age_s` (n,) ago.

    The device moves steadily: world velocity (3,) [m/s] and turn (3,) [rad/s]. By now it would
    look along `looks` (n, 3). Of a frame only the first column is filled: where the beam looked.
    """
    origins, frames = np.empty((age_s.size, 3)), np.zeros((age_s.size, 3, 3))
    for i in range(age_s.size):
        x, y, z = looks[i, 0], looks[i, 1], looks[i, 2]
        past = -age_s[i]  # a turn of some hundredths, so the first order will do
        a, b, c = past * turn[0], past * turn[1], past * turn[2]
        dx, dy, dz = x + b * z - c * y, y + c * x - a * z, z + a * y - b * x
        scale = 1.0 / np.sqrt(dx * dx + dy * dy + dz * dz)
        frames[i, 0, 0], frames[i, 1, 0], frames[i, 2, 0] = scale * dx, scale * dy, scale * dz
        for j in range(3):  # by elements: whole rows would be allocated
            origins[i, j] = position[j] - age_s[i] * velocity[j]
    return origins, frames


@njit(cache=True)
def _dim(true_m: Floats, what: Ints, reach_m: Floats, max_range_m: float) -> None:
    """Let nothing be seen, of ranges (n,), that is beyond the reach of what each beam met."""
    for i in range(true_m.size):
        if true_m[i] > reach_m[what[i]]:
            true_m[i] = max_range_m


@njit(cache=True)
def _mixed(
    true_m: Floats, edge: Floats, width: float, edge_m: float, pulse_m: float, share: float
) -> Floats:
    """Ranges (n,) of beams that are wider than their spacing.

    Between two beams whose ranges differ by more than `edge_m` lies an edge, at a share `edge`
    (n,) of the way. A beam of `width` spacings reaches across it. What lies within `pulse_m` of
    each other melts into one echo, in between (a mixed pixel); of what lies farther apart the
    nearer is heard, once it fills `share` of the beam.
    """
    seen_m = true_m.copy()
    for i in range(true_m.size - 1):
        near, far = (i, i + 1) if true_m[i] < true_m[i + 1] else (i + 1, i)
        gap = true_m[far] - true_m[near]
        if gap > edge_m:
            on_near = 0.5 - edge[i] / width  # of the farther beam, its middle at the edge: a half
            on_far = 0.5 - (1.0 - edge[i]) / width
            if gap > pulse_m:
                if on_near > share:
                    seen_m[far] = min(seen_m[far], true_m[near])
            else:
                seen_m[far] -= max(on_near, 0.0) * gap
                seen_m[near] += max(on_far, 0.0) * gap
    return seen_m


@njit(cache=True)
def _counts(
    true_m: Floats, noise: Floats, bias_m: float, sd_m: float, max_range_m: float
) -> NDArray[np.uint16]:
    """What the scanner says of ranges (n,); compiled, since numpy's eight passes cost more."""
    counts = np.empty(true_m.size, np.uint16)
    for i in range(true_m.size):
        count = np.rint((true_m[i] + bias_m + sd_m * noise[i]) / LIDAR_COUNT_M)
        counts[i] = min(max(count, 0), LIDAR_NO_RETURN_COUNT - 1)
        if true_m[i] >= max_range_m:
            counts[i] = LIDAR_NO_RETURN_COUNT
    return counts


def _step_rad(p: LidarParameters) -> float:
    return 2.0 * p.half_fan_rad / (p.beams - 1)


def _fan(p: LidarParameters) -> Floats:
    """Unit directions (beams, 3) in the scanner's frame, x forward, first beam to the right."""
    angle = np.linspace(-p.half_fan_rad, p.half_fan_rad, p.beams)
    return np.stack([np.cos(angle), np.sin(angle), np.zeros(p.beams)], axis=1)


def _age_s(p: LidarParameters) -> Floats:
    """How long before the last beam each was measured, shape (beams,)."""
    beam = np.arange(p.beams)
    mirror_rad = beam * _step_rad(p) + np.where(beam % 2, 2.0 * np.pi, 0.0)
    return (mirror_rad.max() - mirror_rad) / (2.0 * np.pi) * p.turn_s


def _reach_m(p: LidarParameters, sight: Sight) -> ByKind:
    """Up to where each thing is seen.

    An echo weakens with the square of the distance, and as the thing reflects less.
    """
    reach = {kind: p.tenth_range_m * sqrt(r / 0.1) for kind, r in p.reflectivity.items()}
    return ByKind(sight, reach, reach["other"], reach["ground"], p.tenth_range_m * sqrt(10.0))
