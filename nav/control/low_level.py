"""The low-level controller: every call it turns the command in force into actuator targets."""

from dataclasses import dataclass, field

from nav.control.limits import limited
from nav.control.path_following import bend_ahead, curvature_command, path_error
from nav.control.prediction import Prediction, Predictor
from nav.control.speed import SpeedController
from nav.messages import (
    ActuatorTargets,
    DirectCommand,
    EgoEstimate,
    FollowPath,
    Gear,
    VehicleState,
)
from nav.parameters.control import ControlParameters
from nav.parameters.vehicle import Steering
from nav.planning.curve import Curve, curve_through
from nav.steering_circle import steering_angle

TICK_S = 0.02


@dataclass
class LowLevelController:
    """Follows the newest command; stops when none is fresh."""

    parameters: ControlParameters
    steering: Steering
    speed: SpeedController = field(init=False)
    predictor: Predictor = field(init=False)
    curvature_per_m: float = 0.0
    """Of the vehicle's way when a steering target of now takes effect."""
    command: FollowPath | DirectCommand | None = None
    curve: Curve | None = None
    commanded_ns: int = 0

    def __post_init__(self) -> None:
        self.speed = SpeedController(self.parameters.speed)
        self.predictor = Predictor(self.steering, TICK_S)

    def command_is(self, command: FollowPath | DirectCommand) -> None:
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
        if not self._drives(time_ns):
            return self._stop(time_ns, ego.speed_mps, vehicle)
        return self._follow(time_ns, ego, vehicle, then)

    def _follow(
        self, time_ns: int, ego: EgoEstimate, vehicle: VehicleState, then: Prediction
    ) -> ActuatorTargets:
        assert isinstance(self.command, FollowPath)
        assert self.curve is not None
        error = path_error(self.curve, then.x_m, then.y_m, then.heading_rad)
        path = self.parameters.path
        bend = bend_ahead(self.curve, error.arc_m, path.preview_s * ego.speed_mps)
        curvature = curvature_command(error, bend, ego.speed_mps, path)
        steering = steering_angle(curvature, self.steering)
        ready = vehicle.gear == Gear.HIGH and not vehicle.shifting
        set_point = self.command.speed_mps if ready else 0.0
        if abs(steering - vehicle.steering_rad) > self.parameters.steering_lag_rad:
            set_point = min(set_point, max(ego.speed_mps, self.parameters.steering_lag_mps))
        throttle, brake = self.speed.step(set_point, ego.speed_mps, TICK_S)
        return self._limited(time_ns, steering, throttle, brake)

    def _drives(self, time_ns: int) -> bool:
        fresh = time_ns - self.commanded_ns <= self.parameters.command_timeout_s * 1e9
        return fresh and isinstance(self.command, FollowPath)

    def _stop(
        self, time_ns: int, speed_mps: float, vehicle: VehicleState | None
    ) -> ActuatorTargets:
        throttle, brake = self.speed.step(0.0, speed_mps, TICK_S)
        held = 0.0 if vehicle is None else vehicle.steering_rad
        return self._limited(time_ns, held, throttle, brake)

    def _limited(
        self, time_ns: int, steering_rad: float, throttle: float, brake: float
    ) -> ActuatorTargets:
        return limited(time_ns, steering_rad, throttle, brake, Gear.HIGH, self.steering.limit_rad)
