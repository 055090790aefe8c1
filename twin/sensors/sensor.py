"""What all sensors share: what they look at, when they measure, and where they are mounted."""

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from nav.messages import SensorMessage
from twin import clock
from twin.sensors.parameters import MountingParameters, Timing
from twin.truth import Applied

Floats = NDArray[np.float64]
Ints = NDArray[np.signedinteger]
Bools = NDArray[np.bool_]


class View(Protocol):
    """What sensors see of the vehicle at one physics step."""

    @property
    def k(self) -> int:
        """The step's number."""
        ...

    @property
    def wheel_speed_radps(self) -> Floats:
        """Shape (6,), spin of the wheels, forward positive, in the order of `VehicleState`."""
        ...

    @property
    def applied(self) -> Applied:
        """What the actuators do."""
        ...

    def site_pose(self, name: str) -> tuple[Floats, Floats]:
        """Position (3,) [m] of a site and its rotation (3, 3) into the world frame."""
        ...

    def site_velocity(self, name: str) -> tuple[Floats, Floats]:
        """Linear (3,) [m/s] and angular (3,) [rad/s] velocity of a site, world frame."""
        ...

    def imu(self) -> tuple[Floats, Floats]:
        """Angular rate (3,) [rad/s] and specific force (3,) [m/s^2], vehicle frame."""
        ...


class Schedule(NamedTuple):
    """When a sensor measures and when it is heard, in physics steps."""

    period: int
    phase: int
    delay: int

    def due(self, k: int) -> bool:
        """Whether it measures at step k."""
        return k % self.period == self.phase


class Sensor(Protocol):
    """One device: a quantity with noise; the suite gives it its rate and its delay."""

    name: str
    schedule: Schedule

    def measure(self, view: View, time_ns: int) -> SensorMessage:
        """The message that says what `view` looks like at `time_ns`."""
        ...


def schedule(timing: Timing, stagger_steps: int = 0) -> Schedule:
    """The integer steps of a timing.

    Raises:
        ValueError: the rate does not divide that of the physics, or the delay is negative.
    """
    period = clock.interval(timing.rate_hz)
    if timing.delay_steps < 0:
        raise ValueError(f"delay_steps is {timing.delay_steps}, expected 0 or more")
    return Schedule(period, (timing.phase_steps + stagger_steps) % period, timing.delay_steps)


def generator(seed: int, name: str) -> np.random.Generator:
    """The random numbers of one consumer: nobody else's draws move them."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=tuple(name.encode())))


class Mounting(NamedTuple):
    """How a device really sits on its site: an offset and a small turn, in the site's frame."""

    offset_m: Floats
    """Shape (3,)."""
    rotation: Floats
    """Shape (3, 3)."""

    def pose(self, view: View, site: str) -> tuple[Floats, Floats]:
        """Position (3,) and rotation (3, 3) of the device in the world."""
        position, rotation = view.site_pose(site)
        # The bits of `@`, at half its cost: eleven devices ask for hundreds of poses a second.
        return position + rotation.dot(self.offset_m), rotation.dot(self.rotation)


def draw_mounting(rng: np.random.Generator, parameters: MountingParameters) -> Mounting:
    """Errors of a bracket; the turn is a rotation vector by Rodrigues' formula."""
    offset = parameters.position_sd_m * rng.standard_normal(3)
    x, y, z = turn = parameters.angle_sd_rad * rng.standard_normal(3)
    angle = float(np.linalg.norm(turn)) or 1.0
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]) / angle
    return Mounting(offset, np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)
