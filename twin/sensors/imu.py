"""Vertical gyro: angular rates, specific force, and roll and pitch against a slow vertical."""

from math import atan2, hypot

import numpy as np

from nav.messages import ImuSample
from twin.sensors.parameters import ImuParameters
from twin.sensors.sensor import Floats, View, generator, schedule

Tilt = tuple[float, float]
"""Roll and pitch, [rad]."""


class Imu:
    """Rates and accelerations with noise, a scale, and a bias that walks.

    The vertical is erected slowly towards the apparent one, which accelerations tilt: this is the
    dynamic error of roll and pitch, de/dt = (apparent - true - e) / erection time.
    """

    name = "imu"

    def __init__(self, seed: int, p: ImuParameters) -> None:
        self.schedule = schedule(p)
        self._p = p
        self._rng = generator(seed, self.name)
        sd = np.repeat([p.gyro_bias_sd_radps, p.accelerometer_bias_sd_mps2], 3)
        walk = np.repeat([p.gyro_walk_radps, p.accelerometer_walk_mps2], 3)
        self._walk = walk / np.sqrt(p.rate_hz)
        scale_sd = np.repeat([p.gyro_scale_sd, p.accelerometer_scale_sd], 3)
        self._scale = 1.0 + scale_sd * generator(seed, f"{self.name} scale").standard_normal(6)
        tilt_bias = p.tilt_bias_max_rad * self._rng.uniform(-1.0, 1.0, 2)
        self._bias = np.concatenate([sd * self._rng.standard_normal(6), tilt_bias])
        noises = (p.gyro_noise_radps, p.accelerometer_noise_mps2, p.tilt_noise_rad)
        self._noise = np.repeat(noises, (3, 3, 2))
        self._tilt_error = (0.0, 0.0)

    def measure(self, view: View, time_ns: int) -> ImuSample:
        """The sample of this instant."""
        rate, force = view.imu()
        roll, pitch = self._tilt(tilt_of(view.site_pose(self.name)[1][2]), tilt_of(force))
        said = np.array([*rate.tolist(), *force.tolist(), roll, pitch])
        noise = self._rng.standard_normal(14)
        self._bias[:6] += self._walk * noise[8:]
        said[:6] *= self._scale
        said += self._bias + self._noise * noise[:8]
        return ImuSample(time_ns, said[:3], said[3:6], float(said[6]), float(said[7]))

    def _tilt(self, true: Tilt, apparent: Tilt) -> Tilt:
        """Let the vertical be erected for one sample; roll and pitch against it."""
        step = 1.0 / (self._p.rate_hz * self._p.erection_time_s)
        (roll, pitch), (roll_error, pitch_error) = true, self._tilt_error
        roll_error += step * (apparent[0] - roll - roll_error)
        pitch_error += step * (apparent[1] - pitch - pitch_error)
        self._tilt_error = (roll_error, pitch_error)
        return roll + roll_error, pitch + pitch_error


def tilt_of(up: Floats) -> Tilt:
    """Roll (left side up) and pitch (nose down) [rad] from "up" in vehicle axes (3,)."""
    x, y, z = up.tolist()
    return atan2(y, z), atan2(-x, hypot(y, z))
