"""The low-level controller: every call it turns the command in force into actuator targets."""

from dataclasses import dataclass, field
from math import sqrt

from nav.control.limits import limited
from nav.control.path_following import bend_ahead, curvature_command, path_error
from nav.control.prediction import Prediction, Predictor
from nav.control.speed import SpeedController
from nav.messages import (
    ActuatorTargets,
    Command,
    EgoEstimate,
    FollowPath,
    Gear,
    UnitOperation,
    VehicleState,
)
from nav.parameters.control import ControlParameters
from nav.parameters.vehicle import Steering
from nav.planning.curve import Curve, curve_through
from nav.steering_circle import steering_angle

TICK_S = 0.02
CRAWL_MPS = 0.5
"""A high throttle is for a vehicle that hardly moves."""


@dataclass
class LowLevelController:
    """Follows the newest command; stops when none is fresh."""

    parameters: ControlParameters
    steering: Steering
    speed: SpeedController = field(init=False)
    predictor: Predictor = field(init=False)
    curvature_per_m: float = 0.0
    """Of the vehicle's way when a steering target of now takes effect."""
    command: Command | None = None
    gear: Gear = Gear.HIGH
    """The one that was asked for last; it stays in while the vehicle stands."""
    curve: Curve | None = None
    commanded_ns: int = 0

    def __post_init__(self) -> None:
        self.speed = SpeedController(self.parameters.speed)
        self.predictor = Predictor(self.steering, TICK_S)

    def command_is(self, command: Command) -> None:
        """Put a command of the high-level controller into force."""
        if isinstance(command, FollowPath) and not self._same_path(command):
            self.curve = curve_through(command.pathpoint_m)
        self.command, self.commanded_ns = command, command.time_ns

    def _same_path(self, command: FollowPath) -> bool:
        old = self.command
        return isinstance(old, FollowPath) and bool((old.pathpoint_m == command.pathpoint_m).all())

    def step(
        self, time_ns: int, ego: EgoEstimate | None, vehicle: VehicleState | None
    ) -> ActuatorTargets:
        """Targets for the next 20 ms."""
        targets = self._targets(time_ns, ego, vehicle)
        self.predictor.sent(targets.steering_rad)
        return targets

    def _targets(
        self, time_ns: int, ego: EgoEstimate | None, vehicle: VehicleState | None
    ) -> ActuatorTargets:
        if ego is None or vehicle is None:
            return self._stop(time_ns, 0.0, vehicle)
        then = self.predictor.predict(ego, vehicle.steering_rad)
        self.curvature_per_m = then.curvature_per_m
        command, fresh = self.command, self._is_fresh(time_ns)
        if fresh and isinstance(command, FollowPath):
            return self._follow(command, ego, vehicle, then)
        if fresh and isinstance(command, UnitOperation):
            return self._operate(command, ego, vehicle)
        return self._stop(time_ns, ego.speed_mps, vehicle)

    def _follow(
        self, command: FollowPath, ego: EgoEstimate, vehicle: VehicleState, then: Prediction
    ) -> ActuatorTargets:
        """Along the pathpoints, in the high gear."""
        assert self.curve is not None
        error = path_error(self.curve, then.x_m, then.y_m, then.heading_rad)
        path = self.parameters.path
        bend = bend_ahead(self.curve, error.arc_m, path.preview_s * ego.speed_mps)
        curvature = curvature_command(error, bend, ego.speed_mps, path)
        steering = steering_angle(curvature, self.steering)
        set_point = command.speed_mps if self._engage(Gear.HIGH, ego, vehicle) else 0.0
        if abs(steering - vehicle.steering_rad) > self.parameters.steering_lag_rad:
            set_point = min(set_point, max(ego.speed_mps, self.parameters.steering_lag_mps))
        throttle, brake = self.speed.step(set_point, ego.speed_mps, TICK_S)
        if ego.speed_mps < min(set_point, CRAWL_MPS):
            throttle = max(throttle, command.least_throttle)
        return self._limited(ego.time_ns, steering, throttle, brake)

    def _operate(
        self, command: UnitOperation, ego: EgoEstimate, vehicle: VehicleState
    ) -> ActuatorTargets:
        """Shift at a stand, steer, then drive what remains."""
        backwards = command.gear == Gear.REVERSE
        speed = -ego.speed_mps if backwards else ego.speed_mps
        p = self.parameters.operations
        off = abs(command.steering_rad - vehicle.steering_rad)
        steered = off < p.steered_rad or speed > p.rolling_mps
        goes = self._engage(command.gear, ego, vehicle) and steered
        reachable = sqrt(2.0 * p.braking_mps2 * max(command.remaining_m, 0.0))
        set_point = min(command.speed_mps, reachable) if goes else 0.0
        throttle, brake = self.speed.step(set_point, speed, TICK_S)
        return self._limited(ego.time_ns, command.steering_rad, throttle, brake)

    def _engage(self, gear: Gear, ego: EgoEstimate, vehicle: VehicleState) -> bool:
        """Ask for a gear, for another one at a stand only; whether it is in."""
        if abs(ego.speed_mps) < self.parameters.speed.stand_mps:
            self.gear = gear
        return vehicle.gear == gear and not vehicle.shifting

    def _is_fresh(self, time_ns: int) -> bool:
        return time_ns - self.commanded_ns <= self.parameters.command_timeout_s * 1e9

    def _stop(
        self, time_ns: int, speed_mps: float, vehicle: VehicleState | None
    ) -> ActuatorTargets:
        throttle, brake = self.speed.step(0.0, speed_mps, TICK_S)
        held = 0.0 if vehicle is None else vehicle.steering_rad
        return self._limited(time_ns, held, throttle, brake)

    def _limited(
        self, time_ns: int, steering_rad: float, throttle: float, brake: float
    ) -> ActuatorTargets:
        return limited(time_ns, steering_rad, throttle, brake, self.gear, self.steering.limit_rad)
