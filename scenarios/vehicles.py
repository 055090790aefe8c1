"""The vehicles that a course can be driven with: a twin, its outline, and the navigator's file."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from nav.messages import ActuatorTargets, SensorMessage
from nav.parameters import ION
from scenarios.ablation import LIDARS, OTHERS, RADARS
from scenarios.verdicts.shapes import Outline
from twin import pioneer
from twin.dubins import DubinsSimulator, dubins_parameters
from twin.faults import ACTUATORS
from twin.sensors.parameters import SensorParameters
from twin.simulator import RANGER, Kind, Simulator
from twin.truth import Truth
from twin.world import World


class Twin(Protocol):
    """A simulated vehicle in a world. Picklable in the middle."""

    @property
    def time_ns(self) -> int:
        """Time since the start, [ns]."""
        ...

    def advance(self, targets: ActuatorTargets) -> list[SensorMessage]:
        """Drive for 20 ms under `targets`; the messages delivered meanwhile, in their order."""
        ...

    def reset(self, sensor: str) -> None:
        """The navigator resets a sensor."""
        ...

    def truth(self) -> Truth:
        """The true state, for judges and pictures only."""
        ...


@dataclass(frozen=True)
class Vehicle:
    """One kind of vehicle."""

    twin: Callable[[World, int, frozenset[str]], Twin]
    """Builds it from the world, the seed, and the sensors that are silent."""
    outline: Outline
    """What the judge measures clearance from."""
    kind: Kind | None = None
    """Of who drives in MuJoCo."""
    height_m: float = 1.98
    lidars: tuple[str, ...] = LIDARS
    """The names of its scanners ..."""
    radars: tuple[str, ...] = RADARS
    """... and of its radars."""
    devices: tuple[str, ...] = (*LIDARS, *RADARS, *OTHERS, "road_camera", *ACTUATORS)
    """What of it can fail."""

    def begin(
        self, world: World, seed: int, silent: frozenset[str], sensors: SensorParameters | None
    ) -> Twin:
        """The vehicle at the start, with its own sensors or with others."""
        if sensors is None or self.kind is None:
            return self.twin(world, seed, silent)
        return Simulator(world, seed, silent, self.kind._replace(sensors=lambda: sensors))


DUBINS = "dubins"
"""The point of section 6.5; its obstacles come raw, so the judge expands it to a disc."""
_DISC = Outline(0.0, 0.0, 0.0, dubins_parameters().drive.disc_radius_m)

VEHICLES = {
    ION: Vehicle(Simulator, Outline(), RANGER),
    DUBINS: Vehicle(DubinsSimulator, _DISC, lidars=("lidar_field",), radars=(), devices=()),
    "pioneer": Vehicle(
        pioneer.simulator,
        Outline(0.254, -0.254, 0.2485),
        pioneer.PIONEER,
        0.46,
        ("lidar_deck",),
        radars=(),
        devices=("lidar_deck", *OTHERS),
    ),
}
"""By the name that a course gives, which is also that of the navigator's parameter file."""
