"""The Pioneer P3-AT: four wheels, a belt on each side, skid steering, a SICK on its deck."""

from collections.abc import Mapping

import mujoco
import numpy as np

import models
from nav.messages import ActuatorTargets
from twin import clock
from twin.body import CONTROL_S, Body, Floats, Start
from twin.sensors.parameters import SensorParameters, sensor_parameters
from twin.simulator import Kind, Simulator
from twin.skid_steer import SkidSteer, SkidSteerParameters
from twin.truth import Applied
from twin.world import World

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
"""The order of every array with one value a wheel."""
DRIVES = ("left_drive", "right_drive")


class Pioneer(Body):
    """The robot in a compiled world.

    Args:
        model: holds the robot (models/pioneer_p3at.xml); see `Body`.
        start: see `Body`.
        seed: draws nothing: it has no gearbox.
        owners: see `Body`.
        parameters: of the drive-by-wire unit.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        start: Start,
        seed: int,
        owners: Mapping[str, str] | None = None,
        parameters: SkidSteerParameters | None = None,
    ) -> None:
        del seed  # Unused.
        super().__init__(model, start, owners or {}, "pioneer", WHEELS)
        self._shim = SkidSteer(parameters or SkidSteerParameters(), CONTROL_S)
        self._drives = [model.actuator(name).id for name in DRIVES]

    @property
    def applied(self) -> Applied:
        """What the unit does at this instant."""
        return self._shim.applied

    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Hand targets to the unit."""
        self._shim.apply(time_ns, targets)

    def _control(self) -> None:
        """Give both sides their speeds."""
        self.data.ctrl[self._drives] = self._shim.step(clock.time_ns(self.k))

    @property
    def wheel_speed_radps(self) -> Floats:
        """Shape (6,), [rad/s], in the places of `VehicleState`: those of the middle axle, which it
        does not have, repeat what the belt of the side does."""
        front_left, front_right, rear_left, rear_right = super().wheel_speed_radps
        middle = 0.5 * (front_left + rear_left), 0.5 * (front_right + rear_right)
        return np.array([front_left, front_right, *middle, rear_left, rear_right])


def sensors() -> SensorParameters:
    """What the robot carries."""
    return sensor_parameters("pioneer.toml")


PIONEER = Kind(models.PIONEER, Pioneer, sensors)


def simulator(world: World, seed: int, disabled: frozenset[str] = frozenset()) -> Simulator:
    """The robot with its sensors in a world."""
    return Simulator(world, seed, disabled, PIONEER)
