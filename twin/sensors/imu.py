"""Vertical gyro: angular rates, specific force, and roll and pitch against a slow vertical."""

from math import atan2, hypot

import numpy as np

from nav.messages import ImuSample
from twin.sensors.parameters import ImuParameters
from twin.sensors.sensor import Floats, View, generator, schedule


class Imu:
    """Rates and accelerations with bias and noise.

    The vertical is erected slowly towards the apparent one, which accelerations tilt: this is the
    dynamic error of roll and pitch, de/dt = (apparent - true - e) / erection time.
    """

    name = "imu"

    def __init__(self, seed: int, p: ImuParameters) -> None:
        self.schedule = schedule(p)
        self._p = p
        self._rng = generator(seed, self.name)
        sd = np.repeat([p.gyro_bias_sd_radps, p.accelerometer_bias_sd_mps2], 3)
        tilt_bias = p.tilt_bias_max_rad * self._rng.uniform(-1.0, 1.0, 2)
        self._bias = np.concatenate([sd * self._rng.standard_normal(6), tilt_bias])
        noises = (p.gyro_noise_radps, p.accelerometer_noise_mps2, p.tilt_noise_rad)
        self._noise = np.repeat(noises, (3, 3, 2))
        self._tilt_error = np.zeros(2)

    def measure(self, view: View, time_ns: int) -> ImuSample:
        """The sample of this instant."""
        rate, force = view.imu()
        tilt = tilt_of(view.site_pose(self.name)[1][2])
        step = 1.0 / (self._p.rate_hz * self._p.erection_time_s)
        self._tilt_error = self._tilt_error + step * (tilt_of(force) - tilt - self._tilt_error)
        said = np.concatenate([rate, force, tilt + self._tilt_error])
        said += self._bias + self._noise * self._rng.standard_normal(8)
        return ImuSample(time_ns, said[:3], said[3:6], float(said[6]), float(said[7]))


def tilt_of(up: Floats) -> Floats:
    """Roll (left side up) and pitch (nose down) [rad], shape (2,), from "up" in vehicle axes."""
    x, y, z = up.tolist()
    return np.array([atan2(y, z), atan2(-x, hypot(y, z))])
