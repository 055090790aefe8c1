"""The drive-by-wire unit: from targets that arrive to positions that the actuators reach.

Numbers with unit, source and grade: models/README.md.
"""

from collections import deque
from dataclasses import dataclass
from math import isfinite

from nav.messages import ActuatorTargets, Gear
from twin.drivetrain import Gearbox
from twin.truth import Applied
from twin.vehicle import STEERING_LIMIT_RAD


@dataclass(frozen=True)
class DriveByWireParameters:
    """Delays, rates and the stop when commands stop arriving."""

    steering_delay_s: float = 0.30
    steering_rate_radps: float = 0.288
    steering_limit_rad: float = STEERING_LIMIT_RAD
    throttle_delay_s: float = 0.10
    throttle_rate_per_s: float = 2.0
    brake_delay_s: float = 0.10
    brake_rate_per_s: float = 4.0
    timeout_s: float = 0.5
    """Without targets for this long: throttle closed, brake on."""


class Delay:
    """What was put in comes out when it is old enough."""

    def __init__(self, delay_s: float, value: float) -> None:
        self.value = value
        self._delay_ns = round(delay_s * 1e9)
        self._waiting: deque[tuple[int, float]] = deque()

    def put(self, time_ns: int, value: float) -> None:
        """Say `value` at `time_ns`; times do not go back."""
        self._waiting.append((time_ns + self._delay_ns, value))

    def get(self, time_ns: int) -> float:
        """The newest value that is old enough."""
        while self._waiting and self._waiting[0][0] <= time_ns:
            self.value = self._waiting.popleft()[1]
        return self.value

    def clear(self, value: float) -> None:
        """Forget what waits; `value` holds at once."""
        self._waiting.clear()
        self.value = value


class DriveByWire:
    """Delay, saturation and rate limits; stops the vehicle when targets stop arriving."""

    def __init__(self, parameters: DriveByWireParameters, gearbox: Gearbox, dt_s: float) -> None:
        """`dt_s` is the time from one `step` to the next."""
        p = self.parameters = parameters
        self.gearbox = gearbox
        self._dt_s = dt_s
        self._steering = Delay(p.steering_delay_s, 0.0)
        self._throttle = Delay(p.throttle_delay_s, 0.0)
        self._brake = Delay(p.brake_delay_s, 1.0)
        self._gear = gearbox.gear
        self._alive_until_ns = 0
        self.applied = Applied(0.0, 0.0, 1.0, int(gearbox.gear), False)

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

    def step(self, time_ns: int, speed_mps: float) -> Applied:
        """Advance by `dt_s`: what the actuators really do at `time_ns`."""
        p, was, gearbox, dt = self.parameters, self.applied, self.gearbox, self._dt_s
        if time_ns >= self._alive_until_ns:
            self._stop()
        gearbox.step(self._gear, speed_mps, dt)
        self.applied = Applied(
            towards(was.steering_rad, self._steering.get(time_ns), p.steering_rate_radps * dt),
            towards(was.throttle, self._throttle.get(time_ns), p.throttle_rate_per_s * dt),
            towards(was.brake, self._brake.get(time_ns), p.brake_rate_per_s * dt),
            int(gearbox.gear),
            gearbox.shifting,
        )
        return self.applied

    def _stop(self) -> None:
        self._throttle.clear(0.0)
        self._brake.clear(1.0)
        self._gear = self.gearbox.gear


def clip(value: float, low: float, high: float) -> float:
    """The nearest value within both ends."""
    return min(max(value, low), high)


def towards(value: float, target: float, step: float) -> float:
    """Where a value is that goes to a target by at most a step."""
    if value == target:
        return value
    return value + clip(target - value, -step, step)
