"""ION's navigator: wiring only. The same code drives the twin and the truck."""

from collections import deque
from collections.abc import Sequence
from math import atan2

from nav.admission import Admission
from nav.control.low_level import LowLevelController
from nav.fusion.confirmation import confirmed_m
from nav.fusion.ego_state import EgoState
from nav.fusion.health import HealthMonitor
from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.plausibility import Plausibility
from nav.fusion.radar import Echoes, echoes
from nav.fusion.scan_geometry import Sweep
from nav.high_level import HighLevelController, Senses
from nav.messages import (
    EgoEstimate,
    LidarScan,
    ObstacleCells,
    Outputs,
    RadarTracks,
    Report,
    RoadEstimate,
    SensorMessage,
    SonarScan,
    VehicleState,
    device,
)
from nav.parameters import Parameters
from nav.route.rddf import Route
from nav.route.waypoints import route_frame, waypoints_of
from nav.states.situation import FAR_M

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
        self.admission = Admission(STALE_NS, parameters.vehicle)
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
        self._tracks: RadarTracks | None = None
        self._vehicle: VehicleState | None = None
        self._road: RoadEstimate | None = None
        self._newest: dict[str, LidarScan] = {}
        self._ready_ns: int | None = None
        health = parameters.states.health
        sensors = (*parameters.vehicle.lidar_mounts, *health.devices)
        scanners, radars = parameters.vehicle.lidar_mounts, parameters.vehicle.radars
        self.plausibility = Plausibility(parameters.plausibility, scanners)
        self.health = HealthMonitor(health, sensors, tuple(radars), tuple(scanners))

    @property
    def state(self) -> str:
        """The state of the machine (Fig. 6.3)."""
        return self.high_level.machine.state

    def retune(self, parameters: Parameters) -> None:
        """Let fuzzy controllers and states decide by other parameters from now on; what has been
        made of the others goes on."""
        self.parameters = parameters
        self.health.parameters = parameters.states.health
        self.high_level.retune(parameters)

    def step(self, time_ns: int, messages: Sequence[SensorMessage]) -> Outputs:
        """Take all messages since the last call, in order of delivery; say what to do.

        While the clock is behind what it has been, nothing is known of now, and the vehicle stands.
        """
        for message in self.admission.admit(time_ns, messages):
            if self.plausibility.believes(message, self.ego):
                self._take(message)
        ego = self.ego.estimate(time_ns) if time_ns >= self.admission.now_ns else None
        self.calls += 1
        reports = self._decide(time_ns, ego) if ego and self.calls % HIGH_LEVEL_EVERY == 0 else ()
        return Outputs(self.low_level.step(time_ns, ego, self._vehicle), reports)

    def _take(self, message: SensorMessage) -> None:
        if isinstance(message, LidarScan):
            self._scans[message.sensor].append(message)
            self._newest[message.sensor] = message
            return
        if isinstance(message, SonarScan):
            self._sonar = message
            return
        if isinstance(message, RadarTracks):
            self._tracks = message
            return
        if isinstance(message, RoadEstimate):
            self._road = message
            return
        if isinstance(message, VehicleState):
            self._vehicle = message
        self.ego.update(message)

    def _decide(self, time_ns: int, ego: EgoEstimate) -> tuple[Report, ...]:
        self._sense(time_ns, ego)
        if not self._warm(time_ns):
            return (ego,)
        senses = self._senses(time_ns, ego)
        self.obstacles.weigh(senses.health.lost)
        command, decision = self.high_level.decide(time_ns, senses, self.obstacles)
        self.low_level.command_is(command)
        cells = (self._cells(time_ns),) if self.calls % CELLS_EVERY == 0 else ()
        return (ego, command, decision, *cells)

    def _senses(self, time_ns: int, ego: EgoEstimate) -> Senses:
        sonar = self._sonar_ranges(time_ns)
        return Senses(
            ego=ego,
            curvature_per_m=self.low_level.curvature_per_m,
            gps_lost_s=self.ego.gps_lost_s(time_ns),
            sonar_m=sonar,
            vehicle=self._vehicle,
            health=self.health.check(time_ns, self.admission.newest_ns, self.plausibility.doubted),
            road=self._road if self._road and _is_fresh(self._road.time_ns, time_ns) else None,
            confirmed_m=self._confirmed_m(ego, sonar),
        )

    def _confirmed_m(self, ego: EgoEstimate, sonar_m: dict[str, float]) -> float:
        """Only the guarded watchdog asks for it, so only then it is looked for."""
        if self.high_level.machine.dog.drives_s is None:
            return FAR_M
        scans = {n: s for n, s in self._newest.items() if _is_fresh(s.time_ns, ego.time_ns)}
        vehicle, tilt = self.parameters.vehicle, (ego.roll_rad, ego.pitch_rad)
        return confirmed_m(scans, self.obstacles.geometry, sonar_m, vehicle, tilt)

    def _sense(self, time_ns: int, ego: EgoEstimate) -> None:
        """Bring the map up to date with all scans since the last decision."""
        x, y = (float(v) for v in ego.position_m)
        self.obstacles.recenter(x, y)
        self.obstacles.integrate(self._sweeps(), self._echoes(time_ns))
        if self._sonar and _is_fresh(self._sonar.time_ns, time_ns):
            pose = self.ego.pose_at(self._sonar.time_ns)
            self.obstacles.integrate_sonar(self._sonar.range_m, pose)

    def _echoes(self, time_ns: int) -> Echoes | None:
        """The newest tracks, if they are fresh and the vehicle knows where its radar sits."""
        tracks, radars = self._tracks, self.parameters.vehicle.radars
        if tracks is None or not radars or not _is_fresh(tracks.time_ns, time_ns):
            return None
        return echoes(tracks, radars[device(tracks)], self.ego.pose_at(tracks.time_ns))

    def _sweeps(self) -> list[Sweep]:
        """The newest scans of each scanner since the last decision, oldest first."""
        scans = [scan for each in self._scans.values() for scan in each]
        for each in self._scans.values():
            each.clear()
        scans.sort(key=lambda scan: scan.time_ns)
        return [self._swept(scan) for scan in scans]

    def _swept(self, scan: LidarScan) -> Sweep:
        """A scan, with the estimate at its last beam and, if that makes a difference, its first."""
        sweep_s, pose = self.obstacles.geometry[scan.sensor].sweep_s, self.ego.pose_at(scan.time_ns)
        if not sweep_s:
            return Sweep(scan, pose)
        return Sweep(scan, pose, self.ego.pose_at(scan.time_ns - round(sweep_s * 1e9)))

    def _warm(self, time_ns: int) -> bool:
        """Whether the ego state has been known long enough for the map to fill."""
        if self._ready_ns is None:
            self._ready_ns = time_ns
        return time_ns - self._ready_ns >= self.parameters.states.warm_up_s * 1e9

    def _sonar_ranges(self, time_ns: int) -> dict[str, float]:
        if self._sonar is None or not _is_fresh(self._sonar.time_ns, time_ns):
            return {}
        names = self.parameters.vehicle.sonar_mounts
        return dict(zip(names, self._sonar.range_m.tolist(), strict=True))

    def _cells(self, time_ns: int) -> ObstacleCells:
        cells = self.obstacles.occupied()
        return ObstacleCells(time_ns, cells.position_m, cells.confidence)


def _is_fresh(heard_ns: int, time_ns: int) -> bool:
    return time_ns - heard_ns <= STALE_NS
