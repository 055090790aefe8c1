"""SICK LMS 221: ranges of 361 beams in one plane, in counts of a centimetre."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from nav.messages import LIDAR_COUNT_M, LIDAR_NO_RETURN_COUNT, LidarScan, lidar_range_m
from twin.raycast import cast
from twin.sensors.parameters import LidarParameters, MountingParameters
from twin.sensors.sensor import Floats, View, draw_mounting, generator, schedule
from twin.sensors.sight import Rays, Sight


class Lidar:
    """One scanner. A scan is taken at one instant; the mirror's turn within it is left out."""

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
        self._rng = generator(seed, unit)
        self._mounting = draw_mounting(self._rng, mounting)
        self._bias_m = p.bias_sd_m * self._rng.standard_normal()
        self._fan = _fan(p)

    def measure(self, view: View, time_ns: int) -> LidarScan:
        """The scan of this instant."""
        position, rotation = self._mounting.pose(view, self.name)
        limit = self._p.max_range_m
        true_m = cast(self._sight.solid, position, self._fan, limit, rotation)
        if self._sight.veil:
            rays = Rays(position[None], self._fan, rotation[None])
            drawn = self._rng.random((1, self._p.beams))
            true_m = self._sight.veil.hide(true_m[None], rays, limit, self.name, drawn)[0]
        noise = self._rng.standard_normal(self._p.beams)
        counts = _counts(true_m, noise, self._bias_m, self._p.noise_sd_m, limit)
        return LidarScan(time_ns, self.name, lidar_range_m(counts))


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


def _fan(p: LidarParameters) -> Floats:
    """Unit directions (beams, 3) in the scanner's frame, x forward, first beam to the right."""
    angle = np.linspace(-p.half_fan_rad, p.half_fan_rad, p.beams)
    return np.stack([np.cos(angle), np.sin(angle), np.zeros(p.beams)], axis=1)
