"""The twin: a vehicle with its sensors in one world, advanced one navigator tick at a time."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import mujoco
import numpy as np

import models
from nav.messages import ActuatorTargets, SensorMessage
from twin import assembly, clock
from twin.body import Body, Start
from twin.faults import Faults
from twin.plant import Plant
from twin.sensors.parameters import SensorParameters, sensor_parameters
from twin.sensors.sight import Sight
from twin.sensors.suite import SensorSuite
from twin.terrain import TerrainWindow
from twin.truth import Truth
from twin.world import World

TICK_STEPS = 6
"""Physics steps in one navigator tick of 20 ms."""
TICK_S = TICK_STEPS * clock.STEP_S


class Kind(NamedTuple):
    """What makes a vehicle the one that it is."""

    model: str
    """One of `models`."""
    plant: Callable[[mujoco.MjModel, Start, int, Mapping[str, str]], Body]
    """Drives it in a compiled model, from a start, with a seed, among the owners of geoms."""
    sensors: Callable[[], SensorParameters]


RANGER = Kind(models.RANGER, Plant, sensor_parameters)


class Simulator:
    """One world in motion. Picklable in the middle; goes on with the same bits."""

    def __init__(
        self,
        world: World,
        seed: int,
        disabled: frozenset[str] = frozenset(),
        kind: Kind = RANGER,
    ) -> None:
        x, y, heading = world.start
        self.window = TerrainWindow(world.terrain, x, y)
        model = assembly.compile(world, self.window, kind.model)
        self._world, self.sight = world, Sight(world)
        ground = float(world.terrain.height(np.array([x]), np.array([y]))[0])
        self.plant = kind.plant(model, (x, y, ground, heading), seed, assembly.owners(world))
        self._look_around(x, y)
        self.faults = Faults(world.faults, seed)
        if isinstance(self.plant, Plant):
            self.plant.fail(self.faults)
        self.sensors = SensorSuite(world, self.sight, seed, disabled, kind.sensors(), self.faults)

    @property
    def time_ns(self) -> int:
        """Time since the start, [ns]."""
        return clock.time_ns(self.plant.k)

    def advance(self, targets: ActuatorTargets) -> list[SensorMessage]:
        """Drive for 20 ms under `targets`; the messages delivered meanwhile, in their order."""
        self.plant.apply(self.time_ns, targets)
        delivered: list[SensorMessage] = []
        for _ in range(TICK_STEPS):
            self.plant.step()
            delivered += self.sensors.poll(self.plant)
        self.faults.way_m += abs(self.plant.speed_mps) * TICK_S
        self._follow()
        return delivered

    def reset(self, sensor: str) -> None:
        """The navigator resets a sensor."""
        self.faults.reset(self.time_ns, sensor)

    def truth(self) -> Truth:
        """The true state, for judges and pictures only."""
        return self.plant.truth()

    def _follow(self) -> None:
        x, y, _ = self.plant.site_pose("reference")[0]
        if self.window.recenter(float(x), float(y)):
            self.window.write_hfield(self.plant.model, self.plant.data)
            self._look_around(float(x), float(y))

    def _look_around(self, x: float, y: float) -> None:
        """Let sensors and vehicle meet what is around a place."""
        things, w = self._world.around(x, y), self.window
        self.sight.show(things)
        self.plant.surround(things)
        self.sight.set_ground(w.z, w.x0, w.y0, w.spacing)
