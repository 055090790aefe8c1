"""The Pioneer's drive-by-wire unit: from a driver's targets to the speeds of its two sides.

The navigator speaks as to a car. Here a steering angle is a curvature, throttle and gear are a
speed, and both become wheel speeds. Numbers with unit, source and grade: models/README.md.
"""

from dataclasses import dataclass
from math import isfinite

from nav.messages import ActuatorTargets, Gear
from twin.servo import Delay, clip, towards
from twin.truth import Applied

DIRECTION = {Gear.REVERSE: -1.0, Gear.NEUTRAL: 0.0, Gear.LOW: 1.0, Gear.HIGH: 1.0}
Sides = tuple[float, float]
"""Left and right, [rad/s]."""


@dataclass(frozen=True)
class SkidSteerParameters:
    """What the unit makes of targets, and how fast."""

    delay_s: float = 0.10
    steering_limit_rad: float = 0.6
    """Full steering: the smallest radius. No wheel of a Pioneer has such an angle."""
    steering_rate_radps: float = 1.2
    radius_m: float = 0.40
    """Of the smallest circle; curvature is in proportion to steering."""
    top_speed_mps: float = 0.7
    """At full throttle."""
    acceleration_mps2: float = 0.5
    braking_mps2: float = 1.0
    """What a full brake adds to it."""
    yaw_rate_radps: float = 2.44
    side_mps: float = 1.2
    """No side runs faster; both slow down alike, so that the curvature stays."""
    track_m: float = 0.67
    """Between the sides, as they act: scrub makes it wider than the wheels stand."""
    wheel_radius_m: float = 0.111
    timeout_s: float = 0.5
    """Without targets for this long it stops."""


class SkidSteer:
    """Delay, limits and rates; stops the robot when targets stop arriving."""

    def __init__(self, parameters: SkidSteerParameters, dt_s: float) -> None:
        """`dt_s` is the time from one `step` to the next."""
        self.parameters = parameters
        self._dt_s = dt_s
        self._steering = Delay(parameters.delay_s, 0.0)
        self._throttle = Delay(parameters.delay_s, 0.0)
        self._brake = Delay(parameters.delay_s, 1.0)
        self._gear = Gear.HIGH
        self._alive_until_ns = 0
        self.speed_mps = 0.0
        """That the sides shall have in the middle."""
        self.applied = Applied(0.0, 0.0, 1.0, int(Gear.HIGH), False, float(Gear.HIGH))

    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Put the targets into force at `time_ns`; what is not a number counts as not arrived."""
        p = self.parameters
        if not isfinite(targets.steering_rad + targets.throttle + targets.brake):
            return
        limit = p.steering_limit_rad
        self._steering.put(time_ns, clip(targets.steering_rad, -limit, limit))
        self._throttle.put(time_ns, clip(targets.throttle, 0.0, 1.0))
        self._brake.put(time_ns, clip(targets.brake, 0.0, 1.0))
        self._gear = Gear(targets.gear)
        self._alive_until_ns = time_ns + round(p.timeout_s * 1e9)

    def step(self, time_ns: int) -> Sides:
        """Advance by `dt_s`: the speeds of the sides at `time_ns`."""
        if time_ns >= self._alive_until_ns:
            self._throttle.clear(0.0)
            self._brake.clear(1.0)
        rate = self.parameters.steering_rate_radps * self._dt_s
        steering = towards(self.applied.steering_rad, self._steering.get(time_ns), rate)
        throttle, brake = self._throttle.get(time_ns), self._brake.get(time_ns)
        self.applied = Applied(steering, throttle, brake, int(self._gear), False, float(self._gear))
        self._hasten(throttle, brake)
        return self._sides(steering)

    def _hasten(self, throttle: float, brake: float) -> None:
        p = self.parameters
        target = 0.0 if brake > 0.0 else DIRECTION[self._gear] * throttle * p.top_speed_mps
        rate = p.acceleration_mps2 + brake * p.braking_mps2
        self.speed_mps = towards(self.speed_mps, target, rate * self._dt_s)

    def _sides(self, steering_rad: float) -> Sides:
        p, speed = self.parameters, self.speed_mps
        curvature = steering_rad / (p.steering_limit_rad * p.radius_m)
        yaw_rate = clip(speed * curvature, -p.yaw_rate_radps, p.yaw_rate_radps)
        apart = 0.5 * p.track_m * yaw_rate
        outer = abs(speed) + abs(apart)
        share = min(1.0, p.side_mps / max(outer, 1e-9)) / p.wheel_radius_m
        return (speed - apart) * share, (speed + apart) * share
