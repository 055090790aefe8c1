"""All sensors of the vehicle: polled after every physics step, heard in order of delivery."""

from heapq import heappop, heappush
from math import lcm

from nav.messages import SensorMessage
from twin import clock
from twin.faults import Faults
from twin.sensors.compass import Compass
from twin.sensors.gps import Gps
from twin.sensors.imu import Imu
from twin.sensors.lidar import Lidar
from twin.sensors.odometry import Odometry
from twin.sensors.parameters import SensorParameters, sensor_parameters
from twin.sensors.radar import Radar
from twin.sensors.road_camera import RoadCamera
from twin.sensors.sensor import Sensor, View
from twin.sensors.sight import Sight
from twin.sensors.sonar import Sonar
from twin.world import World


class SensorSuite:
    """Schedules and delivers; picklable in the middle.

    Messages are delivered by step, those of one step in the fixed order of the sensors.
    """

    def __init__(
        self,
        world: World,
        sight: Sight,
        seed: int,
        disabled: frozenset[str] = frozenset(),
        parameters: SensorParameters | None = None,
        faults: Faults | None = None,
    ) -> None:
        """Build what is not disabled; `faults` are those of the world by default.

        Raises:
            ValueError: a disabled name that is no sensor's; the message lists those that exist.
        """
        sensors = _sensors(world, sight, seed, parameters or sensor_parameters())
        names = [sensor.name for sensor in sensors]
        if unknown := sorted(disabled.difference(names)):
            raise ValueError(f"no sensor {unknown[0]!r}; known are {', '.join(names)}")
        self._cycle = lcm(*(sensor.schedule.period for sensor in sensors))
        kept = [(i, s) for i, s in enumerate(sensors) if s.name not in disabled]
        self.fitted = [sensor for _, sensor in kept]
        """All that are not disabled, in their order."""
        self._due = [[p for p in kept if p[1].schedule.due(k)] for k in range(self._cycle)]
        self.faults = Faults(world.faults, seed) if faults is None else faults
        self._queue: list[tuple[int, int, int, SensorMessage]] = []

    def poll(self, view: View) -> list[SensorMessage]:
        """Measure what is due at step `view.k`; return what is delivered at it."""
        k = view.k
        for order, sensor in self._due[k % self._cycle]:
            now = clock.time_ns(k)
            message = sensor.measure(view, now)
            if sensor.name in self.faults:
                self._fail(k, order, sensor, message)
            else:
                heappush(self._queue, (k + sensor.schedule.delay, order, k, message))
        delivered: list[SensorMessage] = []
        while self._queue and self._queue[0][0] <= k:
            delivered.append(heappop(self._queue)[3])
        return delivered

    def _fail(self, k: int, order: int, sensor: Sensor, message: SensorMessage) -> None:
        """Let be heard what a sensor's faults leave of its message."""
        now = clock.time_ns(k)
        said = self.faults.heard(now, sensor.name, message)
        if said is not None:
            late = round(self.faults.late_s(now, sensor.name) * clock.STEPS_PER_SECOND)
            heappush(self._queue, (k + sensor.schedule.delay + late, order, k, said))


def _sensors(world: World, sight: Sight, seed: int, p: SensorParameters) -> list[Sensor]:
    """Every sensor, in the order in which simultaneous messages are heard."""
    return [
        *(Lidar(unit, sight, seed, p.lidar, p.mounting) for unit in p.lidar.units),
        Sonar(sight, seed, p.sonar, p.mounting),
        *([Radar(sight, seed, p.radar, p.mounting)] if p.radar else []),
        Gps(world, sight.solid, seed, p.gps, p.mounting),
        Imu(seed, p.imu),
        Compass(seed, p.compass, sight),
        Odometry(seed, p.odometry),
        *([RoadCamera(world.road, seed, p.road_camera)] if world.road and p.road_camera else []),
    ]
