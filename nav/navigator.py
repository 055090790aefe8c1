"""ION's navigator: wiring only. The same code drives the twin and the truck."""

from collections import deque
from collections.abc import Sequence
from math import atan2

from nav.admission import Admission
from nav.control.low_level import LowLevelController
from nav.fusion.ego_state import EgoState
from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.scan_geometry import Pose
from nav.high_level import HighLevelController, Senses
from nav.messages import (
    EgoEstimate,
    LidarScan,
    ObstacleCells,
    Outputs,
    Report,
    SensorMessage,
    SonarScan,
    VehicleState,
)
from nav.parameters import Parameters
from nav.route.rddf import Route
from nav.route.waypoints import route_frame, waypoints_of

HIGH_LEVEL_EVERY = 5
"""Calls between decisions: 10 Hz of 50 Hz."""
CELLS_EVERY = 50
"""Calls between reports of the map: 1 Hz."""
STALE_NS = 500_000_000
"""A sensor message older than this is of no use."""


class IonNavigator:
    """Implements `nav.messages.Navigator`. Picklable in the middle."""

    def __init__(self, parameters: Parameters, route: Route) -> None:
        frame = route_frame(route)
        self.parameters = parameters
        self.admission = Admission(STALE_NS, tuple(parameters.vehicle.lidar_mounts))
        waypoints = waypoints_of(route, frame)
        x, y = waypoints.position_m[1] - waypoints.position_m[0]
        along_route = atan2(float(y), float(x))  # the crew parks so; of use without a compass
        self.ego = EgoState(parameters.ego_state, parameters.vehicle, frame, along_route)
        self.obstacles = ObstacleMap(parameters.obstacle_map, parameters.vehicle)
        self.high_level = HighLevelController(parameters, waypoints)
        self.low_level = LowLevelController(parameters.control, parameters.vehicle.steering)
        self.calls = 0
        newest = parameters.obstacle_map.scans_per_sensor
        self._scans = {
            name: deque[LidarScan](maxlen=newest) for name in parameters.vehicle.lidar_mounts
        }
        self._sonar: SonarScan | None = None
        self._vehicle: VehicleState | None = None
        self._ready_ns: int | None = None

    @property
    def state(self) -> str:
        """The state of the machine (Fig. 6.3)."""
        return self.high_level.machine.state

    def step(self, time_ns: int, messages: Sequence[SensorMessage]) -> Outputs:
        """Take all messages since the last call, in order of delivery; say what to do."""
        for message in self.admission.admit(time_ns, messages):
            self._take(message)
        ego = self.ego.estimate(time_ns)
        self.calls += 1
        reports = self._decide(time_ns, ego) if ego and self.calls % HIGH_LEVEL_EVERY == 0 else ()
        return Outputs(self.low_level.step(time_ns, ego, self._vehicle), reports)

    def _take(self, message: SensorMessage) -> None:
        if isinstance(message, LidarScan):
            self._scans[message.sensor].append(message)
            return
        if isinstance(message, SonarScan):
            self._sonar = message
            return
        if isinstance(message, VehicleState):
            self._vehicle = message
        self.ego.update(message)

    def _decide(self, time_ns: int, ego: EgoEstimate) -> tuple[Report, ...]:
        self._sense(time_ns, ego)
        if not self._warm(time_ns):
            return (ego,)
        senses = Senses(
            ego,
            self.low_level.curvature_per_m,
            self.ego.gps_lost_s(time_ns),
            self._sonar_ranges(time_ns),
        )
        command, decision = self.high_level.decide(time_ns, senses, self.obstacles)
        self.low_level.command_is(command)
        cells = (self._cells(time_ns),) if self.calls % CELLS_EVERY == 0 else ()
        return (ego, command, decision, *cells)

    def _sense(self, time_ns: int, ego: EgoEstimate) -> None:
        """Bring the map up to date with all scans since the last decision."""
        x, y = (float(v) for v in ego.position_m)
        self.obstacles.recenter(x, y)
        self.obstacles.integrate(self._scans_with_poses())
        if self._sonar and time_ns - self._sonar.time_ns < STALE_NS:
            pose = self.ego.pose_at(self._sonar.time_ns)
            self.obstacles.integrate_sonar(self._sonar.range_m, pose)

    def _scans_with_poses(self) -> list[tuple[LidarScan, Pose]]:
        """The newest scans of each scanner since the last decision, oldest first."""
        scans = [scan for each in self._scans.values() for scan in each]
        for each in self._scans.values():
            each.clear()
        scans.sort(key=lambda scan: scan.time_ns)
        return [(scan, self.ego.pose_at(scan.time_ns)) for scan in scans]

    def _warm(self, time_ns: int) -> bool:
        """Whether the ego state has been known long enough for the map to fill."""
        if self._ready_ns is None:
            self._ready_ns = time_ns
        return time_ns - self._ready_ns >= self.parameters.states.warm_up_s * 1e9

    def _sonar_ranges(self, time_ns: int) -> dict[str, float]:
        if self._sonar is None or time_ns - self._sonar.time_ns > STALE_NS:
            return {}
        names = self.parameters.vehicle.sonar_mounts
        return dict(zip(names, self._sonar.range_m.tolist(), strict=True))

    def _cells(self, time_ns: int) -> ObstacleCells:
        cells = self.obstacles.occupied()
        return ObstacleCells(time_ns, cells.position_m, cells.confidence)
