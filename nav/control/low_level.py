"""The low-level controller: every call it turns the command in force into actuator targets."""

from dataclasses import dataclass, field

from nav.control.limits import limited
from nav.control.path_following import (
    curvature_command,
    path_error,
    predicted,
    steering_angle,
)
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

TICK_S = 0.02


@dataclass
class LowLevelController:
    """Follows the newest command; stops when none is fresh."""

    parameters: ControlParameters
    steering: Steering
    speed: SpeedController = field(init=False)
    command: FollowPath | DirectCommand | None = None
    curve: Curve | None = None
    commanded_ns: int = 0

    def __post_init__(self) -> None:
        self.speed = SpeedController(self.parameters.speed)

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
        if ego is None or vehicle is None or not self._drives(time_ns):
            return self._stop(time_ns, 0.0 if ego is None else ego.speed_mps, vehicle)
        assert isinstance(self.command, FollowPath)
        assert self.curve is not None
        error = path_error(self.curve, *predicted(ego, self.parameters.path.delay_s))
        curvature = curvature_command(error, ego.speed_mps, self.parameters.path)
        ready = vehicle.gear == Gear.HIGH and not vehicle.shifting
        set_point = self.command.speed_mps if ready else 0.0
        throttle, brake = self.speed.step(set_point, ego.speed_mps, TICK_S)
        return self._limited(time_ns, steering_angle(curvature, self.steering), throttle, brake)

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
