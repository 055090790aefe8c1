"""Every mutant is broken as it says: in the first seconds of a drive, or where its fault lies."""

import pickle
from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest

from nav.fusion.scan_geometry import Pose, Sweep
from nav.messages import (
    ActuatorTargets,
    Gear,
    GpsFix,
    GpsQuality,
    LidarScan,
    RoadEstimate,
    SensorMessage,
    SonarScan,
    VehicleState,
)
from nav.navigator import IonNavigator
from nav.planning.speed import set_point
from nav.route import rddf
from nav.states.situation import Situation
from nav.states.transitions import TRANSITIONS
from nav.states.watchdog import Watchdog
from scenarios.course import Course
from scenarios.dead_end.course import build
from scenarios.episode import Episode
from scenarios.mutants import MUTANTS, mutated
from scenarios.parameter_files import parameters_of
from scenarios.sharp_turn.course import build as bends
from tape.digest import Digest
from tape.record import record

S = 10**9
SEED = 0
TICKS, HALF = 150, 140
"""Three seconds: start-up, and the first decisions of Obstacle Avoidance."""
NEARER_M = (-36.0, 0.0, 0.0)
"""So that the vehicle starts in the dead end: walls to both sides, and soon ahead."""
ELSEWHERE = (
    "frozen_gps", "gps_never_lost", "gear_reads_high", "half_lock", "no_reverse", "watchdog_off",
    "watchdog_eager", "watchdog_blind", "alarm_endless", "alarm_hasty", "bends_at_full_speed",
    "danger_begins_late", "corridor_doubled", "frozen_map", "never_tunnel_mode",
    "never_robotic_operations", "never_rollback", "never_road_following", "never_alarm",
    "careless_health_monitor", "believes_all",
)  # fmt: skip
"""Nothing happens in those seconds that would show these."""


class Heard(NamedTuple):
    """One call of the navigator."""

    time_ns: int
    messages: list[SensorMessage]


class Drive(NamedTuple):
    """An episode and its navigator before they begin, pickled; what that hears, and sees last."""

    episode: bytes
    navigator: bytes
    heard: list[Heard]
    situation: Situation


def _dead_end() -> Course:
    course = build(SEED)
    walls = [
        replace(o, center_m=tuple(np.add(o.center_m, NEARER_M).tolist()))
        for o in course.world.obstacles
    ]
    return replace(course, world=replace(course.world, obstacles=tuple(walls)))


@cache
def drive() -> Drive:
    """Three seconds in the dead end."""
    episode, heard = Episode(_dead_end(), SEED), []
    fresh, navigator = pickle.dumps(episode), pickle.dumps(episode.navigator)
    for _ in range(TICKS):
        records = episode.tick()
        sensed = [r.message for r in records if isinstance(r.message, SensorMessage)]
        heard.append(Heard(episode.simulator.time_ns, sensed))
    situation = episode.navigator.high_level.situation
    assert situation is not None
    return Drive(fresh, navigator, heard, situation)


def episode() -> Episode:
    return pickle.loads(drive().episode)


def healthy() -> IonNavigator:
    return pickle.loads(drive().navigator)


def mutant(name: str) -> IonNavigator:
    return MUTANTS[name].make(healthy())


def listen(navigator: IonNavigator, heard: list[Heard], digest: Digest) -> Digest:
    for call in heard:
        targets, reports = navigator.step(*call)
        for message in (targets, *reports):
            digest.update(record(call.time_ns, message))
    return digest


@cache
def healthy_digest() -> str:
    return listen(healthy(), drive().heard, Digest()).hex()


def test_there_are_enough_and_each_says_what_is_broken():
    assert len(MUTANTS) >= 28
    sentences = [m.sentence for m in MUTANTS.values()]
    assert len(set(sentences)) == len(sentences)
    assert all(s.endswith(".") for s in sentences)


def test_an_unknown_one_is_refused_with_those_that_are_known():
    with pytest.raises(
        ValueError, match=r"'sleepy': no such mutant; known are deaf_sonar, .*no_br"
    ):
        mutated(episode(), "sleepy")


def test_a_judge_keeps_the_healthy_route():
    broken = mutated(episode(), "wrong_datum")
    route, path = broken.navigator.high_level.route, broken.judge.estimated.path
    np.testing.assert_allclose(route.position_m - path.position_m, [[0.0, 1.5]] * len(path.arc_m))


@pytest.mark.parametrize("name", MUTANTS)
def test_it_drives_otherwise_and_goes_on_from_a_pickle(name):
    heard, navigator = drive().heard, mutant(name)
    digest = listen(navigator, heard[:HALF], Digest())
    copy, same = pickle.loads(pickle.dumps((navigator, digest)))
    listen(navigator, heard[HALF:], digest)
    assert listen(copy, heard[HALF:], same) == digest
    assert navigator.state in TRANSITIONS
    assert (digest.hex() == healthy_digest()) is (name in ELSEWHERE)


def test_an_episode_goes_on_with_its_mutant_from_a_pickle():
    broken = mutated(episode(), "shaking_steering")
    for _ in range(10):
        broken.tick()
    copy = pickle.loads(pickle.dumps(broken))
    assert copy.tick()[-1].payload == broken.tick()[-1].payload


# ---------------------------------------------------------------- what needs its own situation


def hear(name: str, *messages: SensorMessage) -> list[Any]:
    ears = mutant(name).hear  # pyright: ignore[reportAttributeAccessIssue]
    return [heard for m in messages for heard in ears(m.time_ns, [m])]


def act(name: str, *targets: ActuatorTargets) -> list[ActuatorTargets]:
    hands = mutant(name).act  # pyright: ignore[reportAttributeAccessIssue]
    return [hands(t) for t in targets]


def fix(t, latitude, quality=GpsQuality.CONVERGED):
    return GpsFix(t * S, quality, 8, latitude, -117.0, 0.0, 0.1, np.zeros(3))


def test_a_frozen_gps_repeats_what_it_said_with_new_times():
    said = hear("frozen_gps", *(fix(t, 34.0 + t) for t in (9, 10, 11, 12)))
    assert [f.latitude_deg for f in said] == [43.0, 44.0, 44.0, 44.0]
    assert [f.time_ns for f in said] == [9 * S, 10 * S, 11 * S, 12 * S]


def test_a_gps_that_is_never_lost_sounds_sure_of_itself():
    (said,) = hear("gps_never_lost", fix(1, 34.0, GpsQuality.NONE))
    assert said.quality is GpsQuality.CONVERGED


def test_a_gear_is_always_the_high_one():
    (said,) = hear("gear_reads_high", VehicleState(S, np.zeros(6), 0, 0, 0, Gear.REVERSE, False))
    assert said.gear is Gear.HIGH


def test_late_scans_are_taken_for_new():
    scans = [LidarScan(k * S // 10, "lidar_roof", np.full(361, 1.0 + k)) for k in range(8)]
    said = hear("late_scans", *scans)
    assert [s.range_m[0] for s in said] == [1.0, 2.0, 3.0, 4.0]
    assert [s.time_ns for s in said] == [s.time_ns for s in scans[4:]]


def test_deaf_sonars_leave_nothing_in_the_map():
    (said,) = hear("deaf_sonar", SonarScan(S, np.full(8, 1.0)))
    obstacles = healthy().obstacles
    obstacles.integrate_sonar(said.range_m, Pose(0.0, 0.0, 0.0, 0.0, 0.0))
    assert not obstacles.grid.any()


def target(t=0.0, steering=0.0, gear=Gear.HIGH):
    return ActuatorTargets(round(t * S), steering, 0.0, 0.5, gear)


def test_a_limited_steering_still_turns_both_ways():
    angles = [t.steering_rad for t in act("half_lock", *(target(0, a) for a in (-0.5, 0.1, 0.5)))]
    assert angles == [-0.288, 0.1, 0.288]


def test_there_is_no_reverse():
    gears = act("no_reverse", *(target(0, 0.0, g) for g in (Gear.REVERSE, Gear.LOW, Gear.HIGH)))
    assert [t.gear for t in gears] == [Gear.HIGH, Gear.LOW, Gear.HIGH]


def test_now_and_then_steering_is_not_a_number():
    said = act("nan_targets", *(target(t + 0.5) for t in range(8)))
    assert np.flatnonzero(np.isnan([t.steering_rad for t in said])).tolist() == [3, 7]


def test_late_and_lost_commands_bear_the_time_at_which_they_leave():
    sent = [target(0.02 * k, float(k)) for k in range(120)]
    late, lost = act("late_commands", *sent), act("lost_commands", *sent)
    assert [t.steering_rad for t in late][:17] == [0.0] * 16 + [1.0]
    assert {t.steering_rad for t in lost[50:100]} == {49.0}
    assert lost[100].steering_rad == 100.0
    assert [t.time_ns for t in late] == [t.time_ns for t in lost] == [t.time_ns for t in sent]


def bites(navigator: IonNavigator, still_s: float) -> bool:
    machine = navigator.high_level.machine
    return bool(Watchdog(still_s=still_s).bites(machine.parameters.states.watchdog))


def test_watchdogs():
    for still_s, expected in ((3.0, (False, False, True)), (61.0, (True, False, True))):
        dogs = (healthy(), mutant("watchdog_off"), mutant("watchdog_eager"))
        assert tuple(bites(navigator, still_s) for navigator in dogs) == expected
    for name in ("watchdog_eager", "watchdog_blind"):
        assert mutant(name).high_level.parameters.states.watchdog.override == "paper"


@pytest.mark.parametrize(("name", "failed_s", "lost_s"), [
    ("alarm_endless", (2, 500), ()), ("alarm_hasty", (2,), (500,)), ("never_alarm", (2,), (500,)),
    ("careless_health_monitor", (), ()),
])  # fmt: skip
def test_a_silent_scanner_is_mourned_otherwise(name, failed_s, lost_s):
    health, spoken = mutant(name).health, dict.fromkeys(healthy().health.sensors, 0)
    told = {}
    for t in (0, 2, 500):
        others = {n: t * S for n in spoken if n != "lidar_roof"}
        told[t] = health.check(t * S, {**others, "lidar_roof": 0})
    assert tuple(t for t in told if told[t].failed) == failed_s
    assert tuple(t for t in told if told[t].lost) == lost_s


def test_all_is_believed():
    navigator, repeated = mutant("believes_all"), [fix(t, 34.0) for t in range(20)]
    beliefs = [
        [n.plausibility.believes(f, n.ego) for f in repeated] for n in (navigator, healthy())
    ]
    assert all(beliefs[0])
    assert not all(beliefs[1])
    assert not navigator.plausibility.doubted


def test_a_frozen_map_takes_in_the_first_seconds():
    near = Pose(0.0, 0.0, 0.0, 0.0, 0.0)
    for t, enters in ((9, True), (11, False)):
        obstacles = mutant("frozen_map").obstacles
        obstacles.integrate([Sweep(LidarScan(t * S, "lidar_bumper", np.full(361, 4.0)), near)])
        assert obstacles.grid.any() == enters


def test_danger_begins_late():
    near = (3.0, 3.0, 0.0, 10.0, "safe")
    assert set_point(*near, healthy().parameters.speed).speed_mps == 0.0
    assert set_point(*near, mutant("danger_begins_late").parameters.speed).speed_mps > 4.0


def test_a_corridor_is_taken_for_twice_as_wide():
    wide, right = (n.high_level.waypoints for n in (mutant("corridor_doubled"), healthy()))
    np.testing.assert_array_equal(wide.half_width_m, 2.0 * right.half_width_m)


def test_bends_do_not_lower_the_speed():
    course = bends(SEED)
    parameters, route = parameters_of("ion"), rddf.parse(course.route_text, course.route_name)
    careful = IonNavigator(parameters, route)
    V0 = careful.high_level.V0
    assert (MUTANTS["bends_at_full_speed"].make(careful).high_level.V0 - V0).max() > 0.25


@pytest.mark.parametrize("name", [name for name in MUTANTS if name.startswith("never_")])
def test_a_state_is_never_entered(name, monkeypatch):
    state = name.removeprefix("never_")
    monkeypatch.setitem(TRANSITIONS, "path_point_keeping", ((state, lambda s, m, p: "due"),))
    seen = drive().situation
    seen = replace(seen, road=RoadEstimate(seen.time_ns, 0.0, 0.0, 5.0, 0.9))
    states = []
    for navigator in (healthy(), mutant(name)):
        machine = navigator.high_level.machine
        machine.memory.trail.record((-5.0, 0.0, 0.0), 60.0)
        machine.decide(seen)
        states.append(navigator.state)
    assert states == [state, "path_point_keeping"]


def test_a_state_that_is_never_entered_does_not_hide_the_next(monkeypatch):
    due = tuple((state, lambda s, m, p: "due") for state in ("alarm", "obstacle_avoidance"))
    monkeypatch.setitem(TRANSITIONS, "path_point_keeping", due)
    navigator = mutant("never_alarm")
    navigator.high_level.machine.decide(drive().situation)
    assert navigator.state == "obstacle_avoidance"
