"""The ideal drive-by-wire: actuator targets become a and omega of (6.9) at once.

Only the gear takes its time: between forward and reverse the linkage is on its way for a while, and
nothing drives meanwhile.
"""

from dataclasses import dataclass
from math import copysign, isfinite

from nav.messages import ActuatorTargets, Gear
from twin.dubins.kinematics import State, advance, limited
from twin.dubins.parameters import DriveParameters
from twin.truth import Applied

PARKED = Applied(0.0, 0.0, 1.0, int(Gear.HIGH), False, float(Gear.HIGH))
DIRECTION: dict[int, float] = {Gear.REVERSE: -1.0, Gear.NEUTRAL: 0.0, Gear.LOW: 1.0, Gear.HIGH: 1.0}
"""Of the drive; a linkage on its way is in neutral."""


@dataclass
class IdealDrive:
    """Remembers the targets in force and the gear."""

    parameters: DriveParameters
    applied: Applied = PARKED
    _wanted: Gear = Gear.HIGH
    _shifted_ns: int = 0
    """When the linkage arrives."""
    _alive_until_ns: int = 0

    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Put the targets into force; what is not a number counts as not arrived."""
        p = self.parameters
        if not isfinite(targets.steering_rad + targets.throttle + targets.brake):
            return
        self._alive_until_ns = time_ns + round(p.timeout_s * 1e9)
        if targets.gear != self._wanted:
            self._wanted = Gear(targets.gear)
            self._shifted_ns = time_ns + round(p.shift_s * 1e9)
        steering = min(max(targets.steering_rad, -p.steering_limit_rad), p.steering_limit_rad)
        brake = min(max(targets.brake, 0.0), 1.0)
        throttle = 0.0 if brake > 0.0 else min(max(targets.throttle, 0.0), 1.0)
        on_its_way = time_ns < self._shifted_ns
        gear = int(Gear.NEUTRAL if on_its_way else self._wanted)
        self.applied = Applied(steering, throttle, brake, gear, on_its_way, float(gear))

    def step(self, time_ns: int, state: State, dt_s: float) -> State:
        """The state `dt_s` later; the tick begins at `time_ns`."""
        if time_ns >= self._alive_until_ns:
            self.applied = self.applied._replace(throttle=0.0, brake=1.0)
        curvature = self.curvature_per_m()
        braking = self.applied.brake * self.parameters.brake_mps2
        if braking > 0.0:
            return _braked(state, braking, curvature, dt_s)
        drive = DIRECTION[self.applied.gear] * self.applied.throttle
        return advance(state, drive * self.parameters.throttle_mps2, curvature, dt_s)

    def curvature_per_m(self) -> float:
        """omega / u, limited by (6.10)."""
        p = self.parameters
        share = self.applied.steering_rad / p.steering_limit_rad
        return limited(share / p.minimum_radius_m, p.minimum_radius_m)


def _braked(state: State, braking_mps2: float, curvature_per_m: float, dt_s: float) -> State:
    """A brake stops, and holds; it never turns the motion round."""
    speed = state.speed_mps
    rest_s = abs(speed) / braking_mps2
    if rest_s > dt_s:
        return advance(state, -copysign(braking_mps2, speed), curvature_per_m, dt_s)
    end = advance(state, -copysign(braking_mps2, speed), curvature_per_m, rest_s)
    return end._replace(speed_mps=0.0)
