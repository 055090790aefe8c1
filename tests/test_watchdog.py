"""The watchdog of section 6.3: when it bites, what it dares, and when it lets go."""

from dataclasses import replace

import pytest
from test_states import situation

from nav.messages import DirectCommand, FollowPath
from nav.parameters import parameters_from
from nav.states.machine import Machine
from nav.states.watchdog import Watchdog
from scenarios.parameter_files import parameter_texts

P = parameters_from(parameter_texts())
WALL = (2.6, 4.0, -30.0, 30.0)
"""Across the route, dangerously close."""


def with_watchdog(**values):
    dog = replace(P.states.watchdog, **values)
    return replace(P, states=replace(P.states, watchdog=dog))


def bite_s(shift_s, **values):
    """When it bites a vehicle that stands in Obstacle Avoidance and shifts for a while."""
    p = with_watchdog(**values).states.watchdog
    dog = Watchdog()
    for k in range(4000):
        s = replace(situation(t=0.1 * k), shifting=k * 0.1 < shift_s)
        dog.observe(s, "obstacle_avoidance", 0.1, p)
        if dog.bites(p):
            return 0.1 * k
    return None


@pytest.mark.parametrize("shift_s", [2.0, 10.0, 60.0])
def test_it_can_leave_out_the_time_of_a_shift(shift_s):
    still_s = P.states.watchdog.still_s
    assert bite_s(shift_s, counts_shift_time=True) == pytest.approx(still_s, abs=0.3)
    assert bite_s(shift_s, counts_shift_time=False) == pytest.approx(still_s + shift_s, abs=0.3)


def test_it_bites_who_stays_outside_the_main_states():
    p, dog = P.states.watchdog, Watchdog()
    for k in range(10_000):
        x = 0.5 * k  # it moves all the time
        s = situation(t=0.1 * k)
        s = replace(s, ego=replace(s.ego, position_m=[x, 0.0]))
        dog.observe(s, "robotic_operations", 0.1, p)
        if reason := dog.bites(p):
            break
    assert "outside the two main states" in reason
    assert 0.1 * k == pytest.approx(p.outside_s, abs=0.3)


def test_it_does_not_disturb_an_alarm():
    p, dog = P.states.watchdog, Watchdog()
    for k in range(1000):
        dog.observe(situation(t=0.1 * k), "alarm", 0.1, p)
    assert not dog.bites(p)


def seized(override):
    machine = Machine(with_watchdog(override=override))
    machine.dog.seize()
    return machine


@pytest.mark.parametrize(
    ("override", "confirmed_m", "drives"),
    [("paper", 0.5, True), ("guarded", 0.5, False), ("guarded", 5.0, True)],
)
def test_the_guard_stands_before_what_two_sensors_confirm(override, confirmed_m, drives):
    machine = seized(override)
    plan = machine.decide(replace(situation(WALL), confirmed_m=confirmed_m))
    assert machine.state == "path_point_keeping"
    if drives:
        assert isinstance(plan.command, FollowPath)
        assert plan.command.least_throttle == P.states.watchdog.throttle
    else:
        assert isinstance(plan.command, DirectCommand)


@pytest.mark.parametrize(("override", "drives"), [("paper", True), ("guarded", False)])
def test_the_guard_stands_before_the_corridors_edge(override, drives):
    across = situation(WALL)  # its boundary begins where the vehicle's nose is
    plan = seized(override).decide(replace(situation(), edges=across.boundaries))
    assert isinstance(plan.command, FollowPath) is drives
    far = situation((6.0, 8.0, -30.0, 30.0))
    plan = seized(override).decide(replace(situation(), edges=far.boundaries))
    assert isinstance(plan.command, FollowPath)


def test_it_lets_go_after_its_distance():
    machine = seized("paper")
    machine.decide(situation())
    moved = situation(t=1.0)
    far = replace(moved.ego, position_m=[P.states.watchdog.distance_m + 0.1, 0.0])
    machine.decide(replace(moved, ego=far))
    assert machine.dog.drives_s is None
    assert "m driven" in machine.reason


def test_it_lets_go_when_nothing_moves():
    machine = seized("paper")
    for k in range(300):
        machine.decide(situation(WALL, t=0.1 * k))
        if machine.dog.drives_s is None:
            break
    assert 0.1 * k == pytest.approx(P.states.watchdog.longest_s, abs=0.5)
