"""What the vehicle's geometry makes of sensor readings: pure functions."""

import math
from typing import NamedTuple

from nav.messages import ImuSample
from nav.parameters.vehicle import VehicleParameters


class Attitude(NamedTuple):
    """The last word of the IMU."""

    roll_rad: float = 0.0
    pitch_rad: float = 0.0
    rate_radps: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def at(self, dt_s: float) -> "Attitude":
        """A little later, or earlier."""
        p, q, _ = self.rate_radps
        return Attitude(self.roll_rad + p * dt_s, self.pitch_rad + q * dt_s, self.rate_radps)


def attitude_of(sample: ImuSample) -> Attitude:
    """Roll, pitch and angular rate of a sample."""
    p, q, r = sample.angular_rate_radps.tolist()
    return Attitude(sample.roll_rad, sample.pitch_rad, (p, q, r))


def heading_rate(attitude: Attitude) -> float:
    """Rate of the heading about the vertical, from the rates about the tilted body axes."""
    _, q, r = attitude.rate_radps
    roll, pitch = attitude.roll_rad, attitude.pitch_rad
    return (math.sin(roll) * q + math.cos(roll) * r) / math.cos(pitch)


def speed_of_wheels(
    wheel_speed_mps: list[float], yaw_rate_radps: float, vehicle: VehicleParameters
) -> float:
    """Speed [m/s] of the reference point, signed as the wheels' speeds, from all six.

    Each wheel's own place is taken off (left wheels are slower in a left turn, the front ones go
    round a wider circle); the median of six bears two that slip or stand.
    """
    side = 0.5 * vehicle.track_m * yaw_rate_radps
    swing = (vehicle.wheelbase_m * yaw_rate_radps) ** 2
    front = [math.copysign(math.sqrt(max(w * w - swing, 0.0)), w) for w in wheel_speed_mps[:2]]
    wheels = front + wheel_speed_mps[2:]
    left, right = [w + side for w in wheels[::2]], [w - side for w in wheels[1::2]]
    _, _, lower, upper, _, _ = sorted(left + right)
    return 0.5 * (lower + upper)


def level(offset_m: tuple[float, float, float], attitude: Attitude) -> tuple[float, float]:
    """Forward and left [m] in the level frame of a point of the tilted vehicle."""
    x, y, z = offset_m
    s, c = math.sin(attitude.roll_rad), math.cos(attitude.roll_rad)
    left, up = c * y - s * z, s * y + c * z
    return math.cos(attitude.pitch_rad) * x + math.sin(attitude.pitch_rad) * up, left


def rocking(offset_m: tuple[float, float, float], attitude: Attitude) -> tuple[float, float]:
    """Forward and left speed [m/s] that rotation gives to a point, to first order in the tilt."""
    x, y, z = offset_m
    p, q, r = attitude.rate_radps
    return q * z - r * y, r * x - p * z
