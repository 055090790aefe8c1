"""A tape, moment by moment. A thread reads it; what it has read so far can be asked for."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from threading import Event, Thread

from ion.view.series import Columns, Series
from nav.messages import (
    ActuatorTargets,
    Command,
    Decision,
    EgoEstimate,
    Gear,
    LidarScan,
    ObstacleCells,
    SonarScan,
    VehicleState,
)
from tape.errors import TapeError
from tape.reader import Packed, read_packed
from tape.record import PREFIX
from tape.truth import TRUTH, TrueState

UNSEEN = tuple(PREFIX + name for name in ("imu_sample", "gps_fix", "compass_heading", "radar"))
SCAN_S, CURVE_S = 0.2, 0.1
"""Scans of a scanner, and points of a curve, are kept at most this often."""
BREATH = 2000
"""Messages read before others in this process get their turn."""


@dataclass(frozen=True, eq=False)
class Moment:
    """The newest of each kind at one time; None where there was none yet."""

    time_s: float
    ego: EgoEstimate | None
    truth: TrueState | None
    decision: Decision | None
    command: Command | None
    vehicle: VehicleState | None
    targets: ActuatorTargets | None
    cells: ObstacleCells | None
    sonar: SonarScan | None
    scans: dict[str, LidarScan]
    """By scanner."""
    rolled_m: tuple[float, ...]
    """Way of each wheel since the start, backwards negative."""
    since_s: float
    """When the state of `decision` was entered."""


@dataclass
class Timeline:
    """All that is shown of a tape.

    Args:
        log: the tape; read by `start`.
    """

    log: Path
    ego: Series[EgoEstimate] = field(default_factory=Series)
    truth: Series[TrueState] = field(default_factory=Series)
    decision: Series[Decision] = field(default_factory=Series)
    command: Series[Command] = field(default_factory=Series)
    vehicle: Series[VehicleState] = field(default_factory=Series)
    targets: Series[ActuatorTargets] = field(default_factory=Series)
    cells: Series[ObstacleCells] = field(default_factory=Series)
    sonar: Series[SonarScan] = field(default_factory=Series)
    scans: dict[str, Series[LidarScan]] = field(default_factory=dict)
    estimated: Columns = field(default_factory=lambda: Columns(4))
    """x, y [m] in route frame N, heading [rad], speed [m/s]."""
    true: Columns = field(default_factory=lambda: Columns(3))
    """x, y, z [m], world frame."""
    set_point: Columns = field(default_factory=lambda: Columns(1))
    """V_s [m/s]."""
    steering: Columns = field(default_factory=lambda: Columns(1))
    """Road-wheel angle [rad]."""
    steering_target: Columns = field(default_factory=lambda: Columns(1))
    """Road-wheel angle asked for [rad]."""
    states: list[tuple[float, str, str]] = field(default_factory=list)
    """When which state was entered, and why."""
    replanned: list[tuple[float, str]] = field(default_factory=list)
    """When a new local path was made, and why."""
    end_s: float = 0.0
    """As far as the tape is read."""
    complete: bool = False
    """Whether that is all of it."""
    trouble: str = ""
    """What is wrong with the tape, found while reading."""
    _roll: "_Roll" = field(default_factory=lambda: _Roll())

    @property
    def start_s(self) -> float:
        """When it is first known where the vehicle is."""
        known = [series.time_s[0] for series in (self.truth, self.ego) if series.time_s]
        return min(known, default=0.0)

    def start(self) -> Thread:
        """Read the tape in a thread, to its end."""
        thread = Thread(target=self.read, name="tape", daemon=True)
        thread.start()
        return thread

    def read(self) -> None:
        """Read the tape to its end, or to where it is damaged: then `trouble` says how."""
        rest = Event()
        try:
            for count, item in enumerate(read_packed(self.log, (PREFIX, TRUTH))):
                if not item.topic.startswith(UNSEEN):
                    self.take(item)
                if count % BREATH == 0:
                    rest.wait(0.002)
        except TapeError as error:
            self.trouble = str(error)
        self.complete = True

    def take(self, item: Packed) -> None:
        """Take the next message; also one that has just been sent."""
        time_s = item.delivery_ns * 1e-9
        keep = _KEEP.get(item.kind)
        if keep:
            keep(self, time_s, item)
        self.end_s = max(self.end_s, time_s)

    def at(self, time_s: float) -> Moment:
        """What was known at a time."""
        scans = {name: series.at(time_s) for name, series in self.scans.items()}
        return Moment(
            time_s=time_s,
            ego=self.ego.at(time_s),
            truth=self.truth.at(time_s),
            decision=self.decision.at(time_s),
            command=self.command.at(time_s),
            vehicle=self.vehicle.at(time_s),
            targets=self.targets.at(time_s),
            cells=self.cells.at(time_s),
            sonar=self.sonar.at(time_s),
            scans={name: scan for name, scan in scans.items() if scan},
            rolled_m=self._roll.way_m.at(time_s) or (0.0,) * 6,
            since_s=next((t for t, *_ in reversed(self.states) if t <= time_s), 0.0),
        )


class _Roll:
    """The way of each wheel, from the tooth counters, which do not know which way it turns."""

    def __init__(self) -> None:
        self.way_m = Columns(6)
        self._way_m = [0.0] * 6
        self._last_s = 0.0

    def turn(self, time_s: float, state: VehicleState) -> None:
        step_s = (time_s - self._last_s) * (-1.0 if state.gear == Gear.REVERSE else 1.0)
        speeds = state.wheel_speed_mps.tolist()
        self._way_m = [way + speed * step_s for way, speed in zip(self._way_m, speeds, strict=True)]
        self._last_s = time_s
        self.way_m.append(time_s, *self._way_m)


def _ego(line: Timeline, time_s: float, item: Packed) -> None:
    ego = item.message()
    assert isinstance(ego, EgoEstimate)
    line.ego.append(time_s, item)
    line.estimated.append(time_s, *ego.position_m.tolist(), ego.heading_rad, ego.speed_mps)


def _truth(line: Timeline, time_s: float, item: Packed) -> None:
    state = item.message()
    assert isinstance(state, TrueState)
    line.truth.append(time_s, item)
    line.true.append(time_s, *state.position_m.tolist())


def _decision(line: Timeline, time_s: float, item: Packed) -> None:
    decision = item.message()
    assert isinstance(decision, Decision)
    line.decision.append(time_s, item)
    line.set_point.append(time_s, decision.speed_mps)
    said = (decision.state, decision.reason)
    if not line.states or line.states[-1][1:] != said:
        line.states.append((time_s, *said))
    if decision.replanned:
        line.replanned.append((time_s, decision.replanned))


def _vehicle(line: Timeline, time_s: float, item: Packed) -> None:
    if _due(line.vehicle, time_s, CURVE_S):
        state = item.message()
        assert isinstance(state, VehicleState)
        line.vehicle.append(time_s, item)
        line.steering.append(time_s, state.steering_rad)
        line._roll.turn(time_s, state)


def _targets(line: Timeline, time_s: float, item: Packed) -> None:
    if _due(line.targets, time_s, CURVE_S):
        targets = item.message()
        assert isinstance(targets, ActuatorTargets)
        line.targets.append(time_s, item)
        line.steering_target.append(time_s, targets.steering_rad)


def _scan(line: Timeline, time_s: float, item: Packed) -> None:
    series = line.scans.setdefault(item.topic.removeprefix(PREFIX), Series())
    if _due(series, time_s, SCAN_S):
        series.append(time_s, item)


def _sonar(line: Timeline, time_s: float, item: Packed) -> None:
    if _due(line.sonar, time_s, SCAN_S):
        line.sonar.append(time_s, item)


def _cells(line: Timeline, time_s: float, item: Packed) -> None:
    line.cells.append(time_s, item)


def _command(line: Timeline, time_s: float, item: Packed) -> None:
    line.command.append(time_s, item)


def _due(series: Series, time_s: float, every_s: float) -> bool:
    return not series.time_s or time_s > series.time_s[-1] + every_s - 0.01


_KEEP: dict[type, Callable[[Timeline, float, Packed], None]] = {
    EgoEstimate: _ego, TrueState: _truth, Decision: _decision, VehicleState: _vehicle,
    ActuatorTargets: _targets, LidarScan: _scan, SonarScan: _sonar, ObstacleCells: _cells,
    **dict.fromkeys(Command.__args__, _command),
}  # fmt: skip
