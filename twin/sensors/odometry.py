"""Drive-by-wire unit: wheel speeds, and where the actuators are."""

import numpy as np

from nav.messages import Gear, VehicleState
from twin.sensors.parameters import OdometryParameters
from twin.sensors.sensor import View, generator, schedule


class Odometry:
    """Tooth counters know no sign and believe in one radius for all tires; potentiometers say where
    the actuators are, and from that of the linkage follows which gear is in."""

    name = "odometry"

    def __init__(self, seed: int, p: OdometryParameters) -> None:
        self.schedule = schedule(p)
        self._p = p
        self._rng = generator(seed, self.name)
        self._radius_m = p.wheel_radius_m * (1.0 + p.scale_sd * self._rng.standard_normal(6))
        self._steering_bias_rad = p.steering_bias_sd_rad * self._rng.standard_normal()

    def measure(self, view: View, time_ns: int) -> VehicleState:
        """The state of this instant."""
        p, noise, applied = self._p, self._rng.standard_normal(10), view.applied
        speed = self._radius_m * view.wheel_speed_radps + p.noise_sd_mps * noise[:6]
        steering_error = self._steering_bias_rad + p.steering_noise_rad * noise[6]
        linkage = applied.linkage + p.linkage_noise * float(noise[9])
        gear = Gear(min(max(round(linkage), 0), 3))
        return VehicleState(
            time_ns,
            wheel_speed_mps=np.abs(speed),
            steering_rad=counted(applied.steering_rad + steering_error, p.steering_count_rad),
            throttle=counted(applied.throttle + p.pedal_noise * noise[7], p.pedal_count),
            brake=counted(applied.brake + p.pedal_noise * noise[8], p.pedal_count),
            gear=gear,
            shifting=abs(linkage - gear) > p.linkage_window,
        )


def counted(value: float, count: float) -> float:
    """What a converter makes of a potentiometer's voltage: whole counts."""
    return float(np.rint(value / count) * count)
