"""Whatever arrives, what leaves is finite and within limits; and a mirrored world is driven through
in a mirrored way.

The messages of a real drive are meddled with: numbers replaced, arrays cut, stamps shifted, devices
silenced, strange messages put in between, and the call's own clock set wrong.
"""

import pickle
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cache
from math import isfinite
from typing import Any

import numpy as np
import pytest
from arbitrary import KINDS, LAGS_NS, lags_ns, messages, numbers
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from nav.messages import (
    EgoEstimate,
    Floats,
    Gear,
    GpsFix,
    GpsQuality,
    LidarScan,
    Outputs,
    SensorMessage,
)
from nav.navigator import IonNavigator
from nav.parameters import parameters_from
from nav.planning.boundaries import REAL, TOUCH
from nav.planning.curve import sampled
from nav.planning.local_path import clear_distances
from nav.planning.scanning import Boundaries
from nav.planning.steering import nearest
from nav.states import obstacle_avoidance
from nav.states.memory import Memory
from nav.states.situation import Situation
from scenarios.dead_end.course import build
from scenarios.episode import Episode
from scenarios.parameter_files import parameter_texts

AVOIDING = 650
STARTS = {0: "", 120: "path_point_keeping", AVOIDING: "obstacle_avoidance"}
"""Ticks of the drive at which the meddling begins, and the navigator's state there."""
TICKS = 180
"""So long it lasts: longer than the ego state's patience with what it refuses."""

AFTERWARDS = 15
"""Ticks after it: three decisions."""


class Drive:
    """What a navigator was given on its way into a dead end, and what it was at the starts."""

    def __init__(self) -> None:
        episode = Episode(build(0), 0)
        self.given: list[tuple[int, list[SensorMessage]]] = []
        self.navigator: dict[int, bytes] = {}
        for tick in range(max(STARTS) + TICKS):
            if tick in STARTS:
                self.navigator[tick] = pickle.dumps(episode.navigator)
            sensed = [r.message for r in episode.tick() if isinstance(r.message, SensorMessage)]
            self.given.append((episode.simulator.time_ns, sensed))


drive = cache(Drive)

# ---------------------------------------------------------------- what may arrive


@dataclass(frozen=True)
class Meddling:
    """What is done to the messages of some ticks."""

    first: int
    count: int
    what: str
    kind: type[Any] = LidarScan
    number: float = 0.0
    which: int = 0
    """Field, element, or device."""
    lag_ns: int = 0
    message: SensorMessage | None = None

    def __call__(self, now_ns: int, given: list[SensorMessage]) -> tuple[int, list[SensorMessage]]:
        """The call's time and messages as they become."""
        if self.what == "clock":
            return now_ns + self.lag_ns, given
        if self.what == "insert":
            assert self.message
            return now_ns, [replace(self.message, time_ns=now_ns + self.message.time_ns), *given]
        if self.what == "silence":
            return now_ns, [m for m in given if not isinstance(m, self.kind)]
        return now_ns, [self._spoilt(m) if isinstance(m, self.kind) else m for m in given]

    def _spoilt(self, m: SensorMessage) -> SensorMessage:
        if self.what == "shift":
            return replace(m, time_ns=m.time_ns + self.lag_ns)
        names = [f.name for f in fields(m) if f.type in (float, Floats)]
        name = names[self.which % len(names)]
        value = getattr(m, name)
        if not isinstance(value, np.ndarray):
            return replace(m, **{name: self.number})
        if self.what == "cut":
            return replace(m, **{name: value[: self.which % (len(value) + 1)]})
        value = value.copy()
        value[self.which % len(value)] = self.number
        return replace(m, **{name: value})


meddlings = st.builds(
    Meddling,
    first=st.integers(0, 40),
    count=st.sampled_from([1, 2, 10, 30, 160]),
    what=st.sampled_from(["clock", "insert", "silence", "shift", "cut", "number", "number"]),
    kind=st.sampled_from(KINDS[:6]),
    number=numbers,
    which=st.integers(0, 400),
    lag_ns=lags_ns,
    message=messages,
)

# ---------------------------------------------------------------- what may leave


def assert_sound(outputs: Outputs, navigator: IonNavigator) -> None:
    """Finite, within the vehicle's limits, never throttle and brake together."""
    targets = outputs.targets
    assert all(isfinite(x) for x in (targets.steering_rad, targets.throttle, targets.brake))
    assert abs(targets.steering_rad) <= navigator.parameters.vehicle.steering.limit_rad
    assert 0.0 <= targets.throttle <= 1.0
    assert 0.0 <= targets.brake <= 1.0
    assert targets.throttle == 0.0 or targets.brake == 0.0
    assert targets.gear in Gear
    for report in outputs.reports:
        for f in fields(report):
            if f.type in (float, Floats):
                assert np.isfinite(getattr(report, f.name)).all(), (report, f.name)


def through(start: int, meddling: Sequence[Meddling]) -> Outputs:
    """The last of the answers to a stretch of the drive, meddled with; each has been looked at."""
    navigator: IonNavigator = pickle.loads(drive().navigator[start])
    last = max([0, *(each.first + each.count for each in meddling)])
    stop = start + min(last + AFTERWARDS, TICKS)
    for tick, (now_ns, sensed) in enumerate(drive().given[start:stop]):
        for each in meddling:
            if each.first <= tick < each.first + each.count:
                now_ns, sensed = each(now_ns, sensed)
        outputs = navigator.step(now_ns, sensed)
        assert outputs.targets.time_ns == now_ns
        assert_sound(outputs, navigator)
    return outputs


@settings(max_examples=60, deadline=None, derandomize=True, phases=[Phase.generate])
@given(st.sampled_from(list(STARTS)), st.lists(meddlings, min_size=1, max_size=4))
def test_whatever_arrives_what_leaves_is_sound(start, meddling):
    """Without shrinking, which takes minutes: four meddlings are few enough to read."""
    through(start, meddling)


@pytest.mark.parametrize("start", STARTS)
def test_the_drive_that_is_meddled_with_is_good_and_moves(start):
    navigator: IonNavigator = pickle.loads(drive().navigator[start])
    assert navigator.high_level.plan is None or navigator.state == STARTS[start]
    for now_ns, sensed in drive().given[start : start + TICKS]:
        navigator.step(now_ns, sensed)
    assert navigator.admission.dropped == {}
    assert navigator.ego.estimate(now_ns).speed_mps > 0.1


def moved(fix: GpsFix, place_deg: tuple[float, float], sd_m: float) -> GpsFix:
    """The same fix of another place."""
    return replace(fix, latitude_deg=place_deg[0], longitude_deg=place_deg[1], sd_m=sd_m)


@pytest.mark.parametrize(
    "place_deg", [(34.045, -117.6), (34.05, -117.61), (0.0, 0.0), (89.9, 90.0), (-89.9, 179.0)]
)
@pytest.mark.parametrize("sd_m", [0.1, 0.0, -5.0])
def test_a_gps_that_insists_on_another_place_breaks_nothing(place_deg, sd_m):
    """Half a kilometre aside, one behind the start, where no place is set, the poles. Who never
    lost its satellites does not jump: it is not believed, and the vehicle stands."""
    navigator = fixed_by(lambda tick, fix: moved(fix, place_deg, sd_m))
    assert navigator.state == "alarm"
    assert np.abs(navigator.ego.estimate(navigator.admission.now_ns).position_m).max() < 100.0


def test_a_gps_that_is_elsewhere_after_an_outage_is_believed():
    def aside(tick, fix):
        south = replace(fix, latitude_deg=fix.latitude_deg - 0.005)
        return gone(fix) if tick < 10 else south

    navigator = fixed_by(aside)
    assert np.abs(navigator.ego.estimate(navigator.admission.now_ns).position_m).max() > 400.0


def fixed_by(fixes):
    """The navigator after a stretch of the drive with other fixes."""
    navigator, start = pickle.loads(drive().navigator[AVOIDING]), AVOIDING
    for tick, (now_ns, sensed) in enumerate(drive().given[start : start + TICKS]):
        others = [fixes(tick, m) if isinstance(m, GpsFix) else m for m in sensed]
        assert_sound(navigator.step(now_ns, others), navigator)
    return navigator


def gone(fix: GpsFix) -> GpsFix:
    """The same without a solution."""
    return replace(fix, quality=GpsQuality.NONE)


@pytest.mark.parametrize("lag_ns", [lag for lag in LAGS_NS if lag < -5_000_000])
def test_a_clock_that_goes_back_stops_the_vehicle_until_it_has_caught_up(lag_ns):
    """Nothing tells then how old the messages are."""
    outputs = through(120, [Meddling(0, AFTERWARDS * 2, "clock", lag_ns=lag_ns)])
    assert outputs.targets.brake == 0.0
    navigator = pickle.loads(drive().navigator[120])
    for now_ns, sensed in drive().given[120:130]:
        outputs = navigator.step(now_ns, sensed)
    outputs = navigator.step(now_ns + lag_ns, [])
    assert outputs.targets.brake > 0.0
    assert outputs.reports == ()


def test_without_any_message_the_vehicle_stops():
    navigator = pickle.loads(drive().navigator[120])
    for now_ns, _ in drive().given[120 : 120 + 100]:
        outputs = navigator.step(now_ns, [])
    assert outputs.targets.brake > 0.0


# ---------------------------------------------------------------- mirrored worlds

P = parameters_from(parameter_texts())
CELL_M, COUNT = 0.2, 321
"""An odd number: the vehicle's axis runs along the middle of a row, and no cell is on two sides."""
steps = st.integers(-40, 40)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.sets(steps, min_size=1), st.integers(-80, 80), st.none() | st.integers(-80, 80))
def test_exact_ties_go_to_the_previous_decision_then_left(directions, goal, previous):
    """By hand, in whole numbers of half a step, where equal is equal."""
    step = 0.04
    theta = np.array(sorted(directions)) * step
    half = [2 * d for d in sorted(directions)]
    expected = min(
        half,
        key=lambda h: (abs(h - goal), 0 if previous is None else abs(h - previous), goal - h),
    )
    before = None if previous is None else previous * step / 2
    found = nearest(theta, np.ones(len(theta), bool), goal * step / 2, before)
    assert half[found] == expected


@dataclass(frozen=True)
class Block:
    """Cells from x, y on, relative to the vehicle."""

    x: int
    y: int
    width: int
    length: int
    level: int


blocks = st.builds(
    Block, st.integers(12, 140), st.integers(-40, 40), st.integers(1, 30), st.integers(1, 30),
    st.sampled_from([REAL, TOUCH]),
)  # fmt: skip


def scene(
    blocks: Sequence[Block], goal_rad: float, speed_mps: float, curvature: float, mirrored: bool
) -> Situation:
    """The vehicle in the middle of the map, heading east; mirrored at its axis."""
    level, middle = np.zeros((COUNT, COUNT), np.uint8), COUNT // 2
    for b in blocks:
        rows, columns = slice(middle + b.y, middle + b.y + b.width), slice(middle + b.x, None)
        level[rows, columns][:, : b.length] = b.level
    origin = -0.5 * COUNT * CELL_M
    side = -1.0 if mirrored else 1.0
    boundaries = Boundaries(level[::-1].copy() if mirrored else level, (origin, origin), CELL_M)
    route = sampled(np.column_stack([np.arange(0, 30.5, 0.5), np.zeros(61)]))
    clear = clear_distances(route, boundaries, P.planning.footprint)
    ego = EgoEstimate(0, [0, 0], 0.0, speed_mps, 0.0, 0.0, 0.0, 0.1, 0.01)
    return Situation(
        0, ego, boundaries, route, clear, side * goal_rad, 5.0, 0.0, 1, side * curvature, 0.0, {}
    )


angles = st.floats(-1.2, 1.2)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(
    st.lists(blocks, max_size=5), angles, st.none() | angles, st.floats(0, 5), st.floats(-0.1, 0.1)
)
def test_a_mirrored_map_is_driven_through_in_a_mirrored_way(
    blocks, goal, previous, speed, curvature
):
    """Where the decision is exactly tied, both worlds go left."""
    plans = []
    for mirrored in (False, True):
        memory = Memory()
        memory.decision_rad = -previous if mirrored and previous is not None else previous
        s = scene(blocks, goal, speed, curvature, mirrored)
        plans.append(obstacle_avoidance.plan(s, memory, P))
    one, other = plans
    if abs(one.decision_rad + other.decision_rad) > 1e-9:
        assert one.decision_rad - goal == pytest.approx(other.decision_rad + goal, abs=2e-9)
        assert one.decision_rad > goal
        return
    assert one.speed_mps == pytest.approx(other.speed_mps, abs=1e-9)
    assert one.selected == other.selected
    np.testing.assert_allclose(
        one.command.pathpoint_m * (1, -1), other.command.pathpoint_m, atol=1e-4
    )
