"""Makes a tape of the manoeuvre: the twin drives it, with all the errors of its sensors."""

from collections.abc import Callable, Sequence

import numpy as np

from scenarios.calibration.manoeuvre import Phase, manoeuvre, targets
from scenarios.calibration.quantities import Values
from scenarios.calibration.torque_meter import TorqueMeter
from scenarios.calibration.vehicle import START, settings
from scenarios.route.course import SKY
from scenarios.run import Tape
from tape.record import record, record_of_torque
from twin import clock
from twin.plant import Plant
from twin.sensors.sight import Sight
from twin.sensors.suite import SensorSuite
from twin.simulator import TICK_STEPS
from twin.terrain import RollingGround
from twin.world import World

UNUSED = frozenset(
    {"lidar_bumper", "lidar_roof", "lidar_left", "lidar_right", "sonar", "radar", "compass"}
)
"""Sensors that tell nothing of how the vehicle moves here."""
ANCHOR = (40.0, -83.0)
"""Latitude and longitude of the ground [deg]: Ohio. It plays no part."""


def record_manoeuvre(
    tape: Tape,
    seed: int,
    values: Values,
    phases: Sequence[Phase] = (),
    watch: Callable[[float], None] = lambda _: None,
) -> None:
    """Drive the manoeuvre and write what was measured.

    Args:
        tape: takes all records; whoever opened it closes it.
        seed: draws the sensors' errors.
        values: what the vehicle is like.
        phases: what is driven; the whole manoeuvre by default.
        watch: is shown the time [s] after every 20 ms.
    """
    phases = phases or manoeuvre()
    drive = _Drive(tape, seed, values)
    while drive.plant.k < phases[-1].until_s * clock.STEPS_PER_SECOND:
        drive.tick(phases)
        watch(drive.plant.k * clock.STEP_S)


class _Drive:
    def __init__(self, tape: Tape, seed: int, values: Values) -> None:
        model, drivetrain, gain = settings(values)
        self.plant = Plant(model, START, seed, drivetrain=drivetrain, steering_gain=gain)
        world = World(RollingGround(0, ()), (), 0.0, ANCHOR, (0.0, 0.0, 0.0), SKY)
        sight = Sight(world)
        sight.set_ground(np.zeros((2, 2)), 0.0, 0.0, 1.0)
        self._sensors = SensorSuite(world, sight, seed, UNUSED)
        self._meter = TorqueMeter(seed)
        self._tape = tape

    def tick(self, phases: Sequence[Phase]) -> None:
        """20 ms."""
        asked = targets(phases, clock.time_ns(self.plant.k))
        self.plant.apply(asked.time_ns, asked)
        self._tape.write(record(asked.time_ns, asked))
        for _ in range(TICK_STEPS):
            self.plant.step()
            self._listen()

    def _listen(self) -> None:
        now = clock.time_ns(self.plant.k)
        for message in self._sensors.poll(self.plant):
            self._tape.write(record(now, message))
        if self._meter.due(self.plant.k):
            measured = self._meter.measure(self.plant.drive_torque_n_m, now)
            self._tape.write(record_of_torque(now, measured))
