"""The point-mass simulator as a twin: one field in motion, a navigator tick at a time."""

import numpy as np

from nav.messages import ActuatorTargets, SensorMessage
from twin.dubins.circles import circles_of, touched
from twin.dubins.drive import IdealDrive
from twin.dubins.kinematics import State
from twin.dubins.parameters import DubinsParameters, dubins_parameters
from twin.dubins.sensors import sensors
from twin.truth import Truth
from twin.world import World

TICK_NS = 20_000_000
TICK_S = TICK_NS * 1e-9
AT_ONE_POINT = np.zeros((6, 3))
"""Where a point has its tires."""


class DubinsSimulator:
    """Picklable in the middle; goes on with the same bits.

    Args:
        world: its obstacles are upright cylinders on flat ground.
        seed: draws all noise.
        disabled: names of sensors that are silent.
        parameters: those of `dubins.toml` by default.
    """

    def __init__(
        self,
        world: World,
        seed: int,
        disabled: frozenset[str] = frozenset(),
        parameters: DubinsParameters | None = None,
    ) -> None:
        p = self.parameters = parameters or dubins_parameters()
        self.circles = circles_of(world.obstacles)
        self._owners = tuple(o.owner or o.name for o in world.obstacles)
        self.state = State(*world.start, 0.0)
        self.drive = IdealDrive(p.drive)
        fitted = sensors(self.circles, world.anchor, seed, p)
        self._sensors = [sensor for sensor in fitted if sensor.name not in disabled]
        self._tick = 0
        self._contacts: tuple[str, ...] = ()

    @property
    def time_ns(self) -> int:
        """Time since the start, [ns]."""
        return self._tick * TICK_NS

    def advance(self, targets: ActuatorTargets) -> list[SensorMessage]:
        """Drive for 20 ms under `targets`; what the sensors say at the end of it."""
        self.drive.apply(self.time_ns, targets)
        self.state = self.drive.step(self.time_ns, self.state, TICK_S)
        self._tick += 1
        self._touch()
        due = [s for s in self._sensors if self._tick % s.every_ticks == 0]
        return [s.measure(self.time_ns, self.state, self.drive.applied) for s in due]

    def _touch(self) -> None:
        x, y, *_ = self.state
        hit = touched(self.circles, x, y, self.parameters.drive.disc_radius_m)
        self._contacts = tuple(self._owners[i] for i in hit)

    def reset(self, sensor: str) -> None:
        """No sensor of the field fails."""
        del sensor  # Unused.

    def truth(self) -> Truth:
        """The true state, for judges and pictures only."""
        x, y, heading, speed = self.state
        place = np.array([x, y, 0.0])
        return Truth(
            self.time_ns, place, heading, 0.0, 0.0, speed, AT_ONE_POINT + place, self._contacts
        )
