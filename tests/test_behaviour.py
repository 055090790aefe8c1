"""How a drive was driven: each figure against a drive that is computed by hand."""

import json
import math
import pickle
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from test_verdicts import course, decision, estimate, truth

from ion.courses import scenario_source
from nav.messages import ActuatorTargets, Gear, LidarScan
from nav.states import diagram
from nav.states.watchdog import Watchdog
from scenarios.behaviour import Behaviour
from scenarios.behaviour.comfort import Comfort
from scenarios.behaviour.commands import Commands
from scenarios.behaviour.energy import Energy
from scenarios.behaviour.localization import Localization
from scenarios.behaviour.reaction import Reaction
from scenarios.behaviour.sensing import STOPPING, Sensing
from scenarios.behaviour.speed import Speed
from scenarios.behaviour.transitions import KNOWN, Transitions
from scenarios.behaviour.watchdog import Standing, bit
from scenarios.episode import Episode
from scenarios.parameter_files import parameters_of
from scenarios.vehicles import VEHICLES
from tape.record import Record
from twin.truth import Applied

TICK_S = 0.02
TICK_NS = 20_000_000
LIMIT_RAD = parameters_of().vehicle.steering.limit_rad
DOG = parameters_of().states.watchdog


class FakePlant:
    """200 N m at wheels that turn at 10 rad/s on average; engine braking for negative torque."""

    def __init__(self, torque_n_m=200.0, shifting=False):
        self.drive_torque_n_m = torque_n_m
        self.wheel_speed_radps = np.array([9.0, 11.0, 10.0, 10.0, 10.0, 10.0])
        self.applied = Applied(0.0, 0.0, 0.0, 3, shifting, 3.0)


def episode(k, x=0.0, speed=0.0, heading=0.0, clearance_m=math.inf, segment=0, **other) -> Any:
    """What the figures ask of an episode."""
    judge = SimpleNamespace(
        clearance=SimpleNamespace(now_m=clearance_m), progress=SimpleNamespace(segment=segment)
    )
    simulator = SimpleNamespace(plant=other.get("plant"))
    at = other.get("course") or course()
    return SimpleNamespace(
        truth=truth(k, x, 0.0, heading, speed), judge=judge, simulator=simulator, course=at
    )


def records(*messages):
    return [Record("", 0, message, b"") for message in messages]


def targets(k, steering=0.0, throttle=0.0, brake=0.0, gear=Gear.HIGH):
    return ActuatorTargets(k * TICK_NS, steering, throttle, brake, gear)


def decided(k, state="path_point_keeping", reason="", D_m=30.0):
    return replace(decision(k, state), reason=reason, D_m=D_m)


def scan(k):
    return LidarScan(k * TICK_NS, "lidar_roof", np.zeros(361))


def shown(watch, speeds, heading=lambda k: 0.0):
    """A watch that was shown a speed a tick."""
    for k, speed in enumerate(speeds):
        watch(episode(k, speed=speed, heading=heading(k)), [])
    return watch.figures()


# ---------------------------------------------------------------- comfort


def test_a_circle_pushes_sideways_with_speed_times_yaw_rate():
    # through half a turn, where the heading jumps from pi to -pi
    figures = shown(Comfort(), [4.0] * 500, lambda k: math.remainder(0.5 * k * TICK_S, math.tau))
    assert figures["max_lateral_mps2"] == pytest.approx(2.0)
    assert figures["rms_lateral_mps2"] == pytest.approx(2.0)
    assert figures["max_braking_mps2"] == figures["max_jerk_mps3"] == 0.0


def test_a_jolt_of_the_heading_counts_by_its_half_second():
    figures = shown(Comfort(), [4.0] * 100, lambda k: 0.1 if k == 50 else 0.0)
    assert figures["max_lateral_mps2"] == pytest.approx(4.0 * 0.1 / 0.5)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_braking_is_a_loss_of_speed_in_either_direction(sign):
    slower = [sign * max(3.0 - 2.0 * k * TICK_S, 0.0) for k in range(150)]
    figures = shown(Comfort(), slower)
    assert figures["max_braking_mps2"] == pytest.approx(2.0)
    assert figures["max_accelerating_mps2"] == pytest.approx(0.0)
    # from 2 m/s^2 to none within half a second
    assert figures["max_jerk_mps3"] == pytest.approx(4.0)


def test_what_stands_does_not_dilute_the_sideways_acceleration():
    speeds = [4.0] * 250 + [0.0] * 250
    figures = shown(Comfort(), speeds, lambda k: 0.01 * k)
    assert figures["rms_lateral_mps2"] == pytest.approx(2.0, rel=0.01)


def test_less_than_half_a_second_tells_nothing():
    assert set(shown(Comfort(), [4.0] * 25).values()) == {None}


# ---------------------------------------------------------------- commands


def commanded(*each, speed=5.0):
    watch = Commands()
    for k, said in enumerate(each):
        watch(episode(k, speed=speed), records(*said))
    return watch.figures()


@pytest.mark.parametrize(
    ("wrong", "count"),
    [
        ({}, 0),
        ({"steering": LIMIT_RAD, "throttle": 1.0}, 0),
        ({"steering": -LIMIT_RAD - 1e-6}, 1),
        ({"steering": math.nan}, 1),
        ({"throttle": math.inf}, 1),
        ({"throttle": 1.01}, 1),
        ({"brake": -0.01}, 1),
        ({"throttle": 0.2, "brake": 0.2}, 1),
    ],
)
def test_infeasible_commands_are_counted(wrong, count):
    figures = commanded([targets(0)], [targets(1, **wrong)], [targets(2)])
    assert figures["commands_infeasible"] == count


@pytest.mark.parametrize(("speed", "count"), [(5.0, 1), (-0.31, 1), (0.29, 0)])
def test_a_new_gear_may_be_asked_for_at_a_stand_only(speed, count):
    back = [targets(k, gear=Gear.REVERSE) for k in (1, 2)]
    figures = commanded([targets(0)], *([said] for said in back), speed=speed)
    assert figures["commands_infeasible"] == count


def test_missing_and_old_targets_are_late():
    figures = commanded([targets(0)], [], [targets(0)], *([targets(0)] for _ in range(5)))
    # ticks 1 (none), 6 and 7 (more than 100 ms old)
    assert figures["commands_late"] == 3


def test_the_rate_of_the_commanded_steering():
    zigzag = [0.004 * (k % 2) for k in range(101)]
    figures = commanded(*([targets(k, angle)] for k, angle in enumerate(zigzag)))
    assert figures["steering_rate_rms_radps"] == pytest.approx(0.2)
    assert figures["steering_reversals_per_min"] == pytest.approx(60.0 * 99 / 2.0)
    calm = commanded(*([targets(k, 0.2 * angle)] for k, angle in enumerate(zigzag)))
    assert calm["steering_reversals_per_min"] == 0.0


def test_steering_at_a_stand_is_not_busy():
    figures = commanded([targets(0, 0.5)], [targets(1, -0.5)], speed=0.0)
    assert figures["steering_rate_rms_radps"] is None


# ---------------------------------------------------------------- energy


def spent(*plants):
    watch = Energy()
    for k, plant in enumerate(plants):
        watch(episode(k, speed=4.0, plant=plant), [])
    return watch.figures()


def test_energy_is_torque_times_wheel_speed():
    figures = spent(*[FakePlant()] * 50)
    assert figures["energy_MJ"] == pytest.approx(2000.0 * 1.0 * 1e-6)
    assert figures["energy_kJ_per_m"] == pytest.approx(2.0 / 4.0)


def test_engine_braking_gives_nothing_back():
    assert spent(FakePlant(), FakePlant(-500.0)) == {
        "energy_MJ": pytest.approx(40e-6), "energy_kJ_per_m": pytest.approx(0.04 / 0.16)
    }  # fmt: skip


def test_a_vehicle_that_tells_no_torque_has_no_energy():
    assert spent(None, SimpleNamespace()) == {"energy_MJ": None, "energy_kJ_per_m": None}


# ---------------------------------------------------------------- transitions


def moved_through(*states):
    watch = Transitions()
    for k, state in enumerate(states):
        watch(episode(k), records(decided(k, state)) if state else [])
    return watch.figures()


def test_each_transition_is_told_once_and_sorted():
    drive = ["path_point_keeping", "obstacle_avoidance", "", "path_point_keeping"]
    figures = moved_through(*drive * 2)
    assert figures["transitions"] == [
        "obstacle_avoidance>path_point_keeping", "path_point_keeping>obstacle_avoidance"
    ]  # fmt: skip
    assert figures["states_entered"] == ["obstacle_avoidance", "path_point_keeping"]
    assert figures["transitions_unknown"] == []


def test_a_way_that_the_diagram_does_not_know():
    figures = moved_through("alarm", "rollback", "path_point_keeping")
    # the last is the watchdog's
    assert figures["transitions_unknown"] == ["alarm>rollback"]
    assert figures["states_entered"] == ["alarm", "path_point_keeping", "rollback"]


def test_what_is_known_is_what_the_diagram_draws():
    drawn = re.findall(r"(\w+) --> (\w+):", diagram.mermaid())
    assert {f"{a}>{b}" for a, b in drawn} == KNOWN


# ---------------------------------------------------------------- watchdog


def stood(seconds, reason=lambda k: "", state="obstacle_avoidance", plant=None, place=None):
    """Figures of a vehicle that stands, unless it has another place at a tick."""
    watch, place = Standing(), place or (lambda k: 0.0)
    for k in range(round(seconds / TICK_S)):
        heard = records(decided(k, state, reason(k))) if k % 5 == 0 and state else []
        watch(episode(k, place(k), plant=plant), heard)
    return watch.figures()


def test_a_vehicle_that_stands_without_a_bite():
    assert stood(10.0) == {
        "watchdog_bites": 0,
        "watchdog_latency_s": pytest.approx(10.0),
        "longest_still_s": pytest.approx(10.0),
    }


def test_a_bite_ends_the_wait_but_not_the_stand():
    said = f"watchdog: no change of position in {DOG.still_s:.0f} s"
    figures = stood(10.0, lambda k: said if k >= 300 else "")
    assert figures["watchdog_bites"] == 1
    assert figures["watchdog_latency_s"] == pytest.approx(6.0)
    assert figures["longest_still_s"] == pytest.approx(10.0)


def test_moving_on_ends_both():
    figures = stood(10.0, place=lambda k: 0.0 if k < 200 else 1.01 * DOG.still_m)
    assert figures["watchdog_latency_s"] == pytest.approx(6.0)
    near = stood(10.0, place=lambda k: 0.0 if k < 200 else 0.99 * DOG.still_m)
    assert near["longest_still_s"] == pytest.approx(10.0)


@pytest.mark.parametrize("patient", [{"state": "alarm"}, {"plant": FakePlant(shifting=True)}])
def test_time_that_the_watchdog_does_not_count(patient):
    assert stood(3.0, **patient)["longest_still_s"] == 0.0


def test_before_the_first_decision_nobody_waits():
    assert stood(3.0, state="")["watchdog_latency_s"] is None


def test_the_words_are_those_of_the_watchdog():
    dog = Watchdog(still_s=DOG.still_s + 1.0)
    assert bit(dog.bites(DOG))
    dog = Watchdog(outside_s=DOG.outside_s + 1.0)
    assert bit(dog.bites(DOG))
    dog = Watchdog(drives_s=DOG.longest_s + 1.0)
    here: Any = SimpleNamespace(pose=(0.0, 0.0, 0.0))
    assert not bit(dog.lets_go(here, (0.0, 0.0, 0.0), DOG))
    assert not bit(dog.lets_go(here, (100.0, 0.0, 0.0), DOG))


# ---------------------------------------------------------------- speed


def run_along(limits, each):
    """Figures of a drive of (ticks, speed, segment)."""
    watch, k = Speed(), 0
    at = replace(course(), speed_mps=np.array(limits))
    for ticks, speed, segment in each:
        for _ in range(ticks):
            watch(episode(k, speed=speed, segment=segment, course=at), [])
            k += 1
    return watch.figures()


def test_the_excess_over_the_limit_of_the_segment():
    figures = run_along([4.0, 6.0, 0.0], [(50, 3.0, 0), (50, 4.5, 0), (50, 6.2, 1)])
    assert figures["over_limit_mps"] == pytest.approx(0.5)
    assert run_along([4.0, 0.0], [(50, 3.9, 0)])["over_limit_mps"] == 0.0


def test_a_lower_limit_holds_from_fifteen_metres_behind_its_waypoint():
    # 0.2 m a tick: 74 ticks are 14.8 m
    before = [(10, 10.0, 0)]
    assert run_along([10.0, 4.0, 0.0], [*before, (74, 10.0, 1)])["over_limit_mps"] == 0.0
    figures = run_along([10.0, 4.0, 0.0], [*before, (80, 10.0, 1)])
    assert figures["over_limit_mps"] == pytest.approx(6.0)


def test_behind_the_finish_the_last_limit_holds():
    assert run_along([4.0, 0.0], [(10, 4.0, 0), (300, 4.0, 1)])["over_limit_mps"] == 0.0


def test_mean_speed_and_the_way_backwards():
    figures = run_along([9.0, 0.0], [(50, 3.0, 0), (100, 0.01, 0), (50, -1.0, 0)])
    assert figures["mean_moving_mps"] == pytest.approx(2.0)
    assert figures["reversed_m"] == pytest.approx(1.0)
    assert run_along([9.0, 0.0], [(50, 0.0, 0)])["mean_moving_mps"] is None


# ---------------------------------------------------------------- sensing


def sensed(each):
    """Figures of ticks of (speed, messages)."""
    watch = Sensing()
    for k, (speed, messages) in enumerate(each):
        watch(episode(k, speed=speed), records(*messages))
    return watch.figures()


def test_the_way_to_a_stand_against_the_free_distance():
    # 6 m/s: 0.1 s to the decision, 0.1 s to the brake, 0.125 s of its way, then 3 m/s^2
    way_m = 6.0 * 0.325 + 36.0 / 6.0
    assert STOPPING["ion"].way_m(6.0) == pytest.approx(way_m)
    over = [(6.0, [decided(0, D_m=way_m - 0.5)]), *[(6.0, [])] * 4]
    free = [(6.0, [decided(5, D_m=way_m + 0.5)]), *[(6.0, [])] * 4]
    figures = sensed(over + free)
    assert figures["overdrives_sensing_s"] == pytest.approx(0.1)
    assert figures["worst_overdrive_m"] == pytest.approx(0.5)
    assert sensed(free)["worst_overdrive_m"] == 0.0


def test_what_is_left_of_a_manoeuvre_is_no_free_distance():
    figures = sensed([(6.0, [decided(0, "robotic_operations", D_m=0.5)])])
    assert figures["overdrives_sensing_s"] is figures["worst_overdrive_m"] is None


def test_every_vehicle_stops_somehow():
    assert set(STOPPING) == set(VEHICLES)


def test_the_way_driven_blind():
    # ticks 27 to 50 come more than half a second after the last scan
    seen = [(5.0, [scan(0)]), (5.0, [scan(1)])]
    assert sensed([*seen, *[(5.0, [])] * 49])["blind_m"] == pytest.approx(24 * 0.1)
    assert sensed([(5.0, [scan(k)]) for k in range(0, 51)])["blind_m"] == 0.0


# ---------------------------------------------------------------- reaction


def test_the_least_time_to_a_contact():
    watch = Reaction()
    for k, (speed, clearance_m) in enumerate([(2.0, 3.0), (-4.0, 2.0), (0.4, 0.1), (9.0, 16.0)]):
        watch(episode(k, speed=speed, clearance_m=clearance_m), [])
    assert watch.figures() == {"approach_margin_s": pytest.approx(0.5)}


def test_an_open_field_has_no_margin():
    watch = Reaction()
    watch(episode(0, speed=5.0), [])
    assert watch.figures() == {"approach_margin_s": None}


# ---------------------------------------------------------------- localization


def test_the_error_of_the_estimates():
    watch = Localization()
    for k, (x, heading) in enumerate([(0.3, 0.1), (0.0, -0.2), (-0.4, 3.1 * math.pi)]):
        believed = replace(estimate(k, x, -x), heading_rad=heading)
        watch(episode(k, x=0.0, heading=0.1 * math.pi if k == 2 else 0.0), records(believed))
    watch(episode(3, x=9.0), [])  # a tick without an estimate tells nothing
    assert watch.figures() == {
        "position_error_rms_m": pytest.approx(math.sqrt((0.18 + 0.32) / 3)),
        "position_error_max_m": pytest.approx(math.sqrt(0.32)),
        "heading_error_max_rad": pytest.approx(math.pi),
    }


def test_without_an_estimate_nothing_is_wrong():
    assert set(Localization().figures().values()) == {None}


# ---------------------------------------------------------------- all of them


FIGURES = {
    "max_lateral_mps2", "rms_lateral_mps2", "max_braking_mps2", "max_accelerating_mps2",
    "max_jerk_mps3", "commands_infeasible", "commands_late", "steering_rate_rms_radps",
    "steering_reversals_per_min", "energy_MJ", "energy_kJ_per_m", "transitions", "states_entered",
    "transitions_unknown", "watchdog_bites", "watchdog_latency_s", "longest_still_s",
    "over_limit_mps", "mean_moving_mps", "reversed_m", "overdrives_sensing_s",
    "worst_overdrive_m", "blind_m", "approach_margin_s", "position_error_rms_m",
    "position_error_max_m", "heading_error_max_rad",
}  # fmt: skip
UNMEASURED = {
    "sharp_turn": {"approach_margin_s"},  # nothing stands there
    "small_robot": {"energy_MJ", "energy_kJ_per_m"},
    "random_field": {"energy_MJ", "energy_kJ_per_m"},
}


def driven(scene, watch, until_s):
    while scene.time_s < until_s and scene.outcome is None:
        watch(scene, scene.tick())


@pytest.mark.parametrize(
    ("name", "until_s"), [("sharp_turn", 5.0), ("small_robot", 6.0), ("random_field", 4.0)]
)
def test_a_short_drive_has_all_figures_and_goes_on_from_a_pickle(name, until_s):
    scene, watch = Episode(scenario_source(name).course(0), 0), Behaviour()
    driven(scene, watch, 0.8 * until_s)
    again, seen = pickle.loads(pickle.dumps((scene, watch)))
    driven(scene, watch, until_s)
    driven(again, seen, until_s)
    figures = watch.figures()
    assert seen.figures() == figures
    assert json.loads(json.dumps(figures, allow_nan=False)) == figures
    assert set(figures) == FIGURES
    assert {key for key, value in figures.items() if value is None} == UNMEASURED[name]
    assert figures["max_accelerating_mps2"] > 0.1
    assert figures["commands_infeasible"] == figures["commands_late"] == 0
    assert figures["transitions_unknown"] == []


def test_watching_changes_nothing():
    source = scenario_source("small_robot")
    seen, unseen = Episode(source.course(0), 0), Episode(source.course(0), 0)
    driven(seen, Behaviour(), 2.0)
    driven(unseen, lambda episode, records: None, 2.0)
    assert seen.digest.hex() == unseen.digest.hex()
