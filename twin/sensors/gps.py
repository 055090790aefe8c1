"""GPS receiver: as good as the sky that is open above it, and slow to converge again."""

from math import exp, hypot, sqrt

import numpy as np

from nav.messages import GpsFix, GpsQuality
from twin.earth import to_geodetic
from twin.raycast import Scene, cast
from twin.sensors.horizon import Horizon
from twin.sensors.parameters import GpsParameters, MountingParameters
from twin.sensors.sensor import Floats, View, draw_mounting, generator, schedule
from twin.world import World


class Gps:
    """A differential receiver that has converged before the episode begins.

    Satellites are hidden by what stands around, and by the ground as far as the horizon. Position
    error: a Gauss-Markov bias and white noise, both as many times larger as the dilution of
    precision is than under an open sky; and after each loss of the sky an offset that decays
    slowly. While it sees too few satellites it repeats its last solution.
    """

    name = "gps"

    def __init__(
        self, world: World, scene: Scene, seed: int, p: GpsParameters, mounting: MountingParameters
    ) -> None:
        self.schedule = schedule(p)
        self._p, self._scene, self._anchor = p, scene, world.anchor
        self._rng = generator(seed, self.name)
        self._mounting = draw_mounting(self._rng, mounting)
        self._satellite = world.satellites
        self._to_satellite = _directions(world.satellites)
        self._horizon = Horizon(world.terrain, p.sky_range_m, p.horizon_m)
        self._open = hdop(self._to_satellite)
        self._dilution = 1.0
        self._spread = np.array([1.0, 1.0, p.vertical_factor])
        self._bias_m = p.bias_sd_m * self._rng.standard_normal(3)
        self._belief = exp(p.sd_scale_sd * self._rng.standard_normal())
        self._outage_m, self._outage_sd_m = np.zeros(3), 0.0
        self._wait_s = 0.0
        self._fixes = 0
        self._satellites, self._sky = 0, False
        self._last = (0.0, 0.0, 0.0, 0.0, np.zeros(3))

    def measure(self, view: View, time_ns: int) -> GpsFix:
        """The solution of this instant, of the antenna's position."""
        position, _ = self._mounting.pose(view, self.name)
        if self._fixes % self._p.sky_interval == 0:
            self._look_up(position)
        self._fixes += 1
        self._age()
        noise = self._rng.standard_normal(7)
        locked = self._lock()
        if locked:
            velocity = view.site_velocity(self.name)[0] + self._p.velocity_sd_mps * noise[3:6]
            sd_m = self._sd_m() * (1.0 + 0.1 * self._p.sd_scale_sd * float(noise[6]))
            self._last = (*self._solve(position, noise[:3]), sd_m, velocity)
        return GpsFix(time_ns, self._quality(locked), self._satellites, *self._last)

    def _look_up(self, position: Floats) -> None:
        """Count the satellites that nothing hides; is their geometry good enough?"""
        limit = self._p.sky_range_m
        free = cast(self._scene, position, self._to_satellite, limit) >= limit
        seen = self._to_satellite[free & ~self._horizon.hides(position, self._satellite)]
        self._satellites = len(seen)
        if len(seen) == len(self._satellite):
            self._sky, self._dilution = len(seen) >= self._p.min_satellites, 1.0
            return
        now = hdop(seen) if len(seen) >= self._p.min_satellites else np.inf
        self._sky = now <= self._p.max_hdop
        if self._sky:
            self._dilution = now / self._open

    def _age(self) -> None:
        """Let the bias wander and the offset of the last outage fade."""
        p, interval_s = self._p, 1.0 / self._p.rate_hz
        keep = exp(-interval_s / p.bias_time_s)
        fresh = p.bias_sd_m * sqrt(1.0 - keep * keep)
        self._bias_m = keep * self._bias_m + fresh * self._rng.standard_normal(3)
        fade = exp(-interval_s / p.outage_time_s)
        self._outage_m, self._outage_sd_m = fade * self._outage_m, fade * self._outage_sd_m

    def _lock(self) -> bool:
        """Whether there is a solution; while there is no sky, draw how long it will take."""
        if not self._sky:
            self._wait_s = self._rng.uniform(*self._p.reacquire_s)
            return False
        if self._wait_s > 0.0:
            self._wait_s -= 1.0 / self._p.rate_hz
            if self._wait_s <= 0.0:
                self._outage_m = self._p.outage_sd_m * self._rng.standard_normal(3)
                self._outage_sd_m = self._p.outage_sd_m
        return self._wait_s <= 0.0

    def _solve(self, position: Floats, noise: Floats) -> tuple[float, float, float]:
        usual = self._bias_m + self._p.noise_sd_m * noise
        error = self._dilution * usual + self._outage_m
        east, north, up = position + self._spread * error
        latitude, longitude = to_geodetic(self._anchor, east, north)
        return float(latitude), float(longitude), float(up)

    def _sd_m(self) -> float:
        usual = self._dilution * hypot(self._p.bias_sd_m, self._p.noise_sd_m)
        return self._belief * hypot(usual, self._outage_sd_m)

    def _quality(self, locked: bool) -> GpsQuality:
        if not locked:
            return GpsQuality.NONE
        converged = self._outage_sd_m < self._p.converged_sd_m
        return GpsQuality.CONVERGED if converged else GpsQuality.DIFFERENTIAL


def hdop(directions: Floats) -> float:
    """Horizontal dilution of precision of satellites in unit directions (n, 3), east north up."""
    geometry = np.column_stack([directions, np.ones(len(directions))])
    normal = geometry.T @ geometry
    if np.linalg.cond(normal) > 1e9:
        return np.inf
    cofactor = np.linalg.inv(normal)
    return float(np.sqrt(cofactor[0, 0] + cofactor[1, 1]))


def _directions(satellites: Floats) -> Floats:
    """Unit vectors (n, 3) from azimuth, counter-clockwise from east, and elevation (n, 2) [rad]."""
    azimuth, elevation = satellites[:, 0], satellites[:, 1]
    level = np.cos(elevation)
    return np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=1)
