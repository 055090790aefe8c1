"""The state machine of Fig. 6.3: every transition that exists, and those that must not."""

from dataclasses import replace

import numpy as np
import pytest

from nav.messages import EgoEstimate
from nav.parameters import parameters_from
from nav.planning.arcs import curvature_back
from nav.planning.boundaries import REAL, TOUCH
from nav.planning.curve import sampled
from nav.planning.local_path import clear_distances
from nav.planning.scanning import Boundaries
from nav.states.machine import Machine
from nav.states.memory import Memory
from nav.states.path_point_keeping import bends_mps
from nav.states.situation import Situation
from nav.states.transitions import TRANSITIONS, room_again
from nav.states.trouble import Trouble
from scenarios.parameter_files import parameter_texts

P = parameters_from(parameter_texts())
WALLS = {"left_front": 0.9, "right_front": 0.9, "left_rear": 0.9, "right_rear": 0.9}
OPEN = dict.fromkeys(WALLS, 4.0)


def situation(
    *blocks: tuple[float, float, float, float], t: float = 0.0, gps_lost_s: float = 0.0, sonar=OPEN
) -> Situation:
    """The vehicle at the origin of a straight route along x; blocks must not be touched."""
    level = np.zeros((320, 320), np.uint8)
    centre = -32.0 + (np.arange(320) + 0.5) * 0.2
    for x0, x1, y0, y1 in blocks:
        rows, columns = (centre > y0) & (centre < y1), (centre > x0) & (centre < x1)
        level[np.ix_(rows, columns)] = TOUCH
    boundaries = Boundaries(level, (-32.0, -32.0), 0.2)
    route = sampled(np.column_stack([np.arange(0, 30.5, 0.5), np.zeros(61)]))
    clear = clear_distances(route, boundaries, P.planning.footprint)
    ego = EgoEstimate(int(t * 1e9), [0, 0], 0.0, 3.0, 0.0, 0.0, 0.0, 0.1, 0.01)
    return Situation(
        ego.time_ns, ego, boundaries, route, clear, 0.0, 5.0, 0.0, 1, 0.0, gps_lost_s, sonar
    )


def test_starts_and_stays_on_the_smooth_path():
    m = Machine(P)
    plan = m.decide(situation())
    assert m.state == "path_point_keeping"
    assert plan.command.pathpoint_m.shape == (10, 2)
    assert plan.speed_mps > 3.0
    np.testing.assert_allclose(plan.command.pathpoint_m[:, 1], 0.0, atol=1e-9)


def test_obstacle_on_the_smooth_path_and_back():
    m = Machine(P)
    plan = m.decide(situation((15.0, 20.0, -4.0, 1.5)))
    assert m.state == "obstacle_avoidance"
    assert "obstacle on the smooth path" in m.reason
    assert plan.decision_rad > 0.0
    assert plan.command.pathpoint_m[-1, 1] > 0.3
    m.decide(situation(t=0.1))
    assert m.state == "path_point_keeping"


def test_mirrored_obstacle_gives_mirrored_path():
    left = Machine(P).decide(situation((15.0, 20.0, -4.0, 1.5)))
    right = Machine(P).decide(situation((15.0, 20.0, -1.5, 4.0)))
    np.testing.assert_allclose(
        left.command.pathpoint_m * (1, -1), right.command.pathpoint_m, atol=1e-6
    )


def test_wall_across_stops_the_vehicle():
    m = Machine(P)
    plan = m.decide(situation((2.6, 4.0, -30.0, 30.0)))
    assert plan.speed_mps == 0.0


def test_the_way_back_to_the_smooth_path_is_driven_no_faster_than_its_bends_allow():
    turn = np.linspace(0.0, 1.5, 40)
    bend = sampled(8.0 * np.column_stack([np.sin(turn), 1.0 - np.cos(turn)]))
    p = P.planning.speed
    assert bends_mps(bend, p) == pytest.approx(np.sqrt(8.0 * p.lateral_mps2), rel=0.03)
    assert bends_mps(situation().route_ahead, p) > 20.0
    plan = Machine(P).decide(replace(situation(), V0_mps=9.0, route_ahead=bend))
    assert plan.speed_mps <= bends_mps(bend, p)


def test_with_the_steering_at_the_stops_and_a_straight_way_ahead_nobody_makes_haste():
    at_the_stops = replace(situation(), curvature_per_m=1.0 / P.vehicle.steering.minimum_radius_m)
    assert Machine(P).decide(at_the_stops).speed_mps < 2.0
    turn = np.linspace(0.0, 1.5, 40)
    bend = sampled(5.8 * np.column_stack([np.sin(turn), 1.0 - np.cos(turn)]))
    along = replace(at_the_stops, route_ahead=bend)
    assert Machine(P).decide(along).speed_mps > 2.0
    assert Machine(P).decide(replace(situation(), curvature_per_m=0.05)).speed_mps > 3.0


def test_who_is_astray_makes_no_haste_towards_narrows():
    s = replace(situation(), cross_track_m=0.8, half_width_m=3.7)
    p = P.planning.speed
    assert Machine(P).decide(s).speed_mps > p.settle_mps
    assert Machine(P).decide(replace(s, narrowest_m=2.1)).speed_mps <= p.settle_mps


def test_who_strays_deep_into_the_real_boundary_is_led_out_of_it():
    s = situation()
    level = np.where(s.boundaries.level < TOUCH, REAL, TOUCH).astype(np.uint8)
    boundaries = Boundaries(level, s.boundaries.origin_m, s.boundaries.cell_m)
    inside = clear_distances(s.route_ahead, boundaries, P.planning.footprint)
    s = replace(s, boundaries=boundaries, route_clear=inside, goal_rad=0.4)
    plan = Machine(P).decide(s)
    assert plan.speed_mps > 1.0
    path = plan.command.pathpoint_m
    assert path[-1, 0] == pytest.approx(P.planning.local_path.answer_s * 3.0, rel=0.05)
    assert path[-1, 1] > 0.1


@pytest.mark.parametrize(
    ("gps_lost_s", "sonar", "state"),
    [
        (1.0, WALLS, "tunnel_mode"),
        (60.0, OPEN, "path_point_keeping"),
        (0.0, WALLS, "path_point_keeping"),
        (60.0, {**OPEN, "left_front": 0.9}, "path_point_keeping"),
        (60.0, {}, "path_point_keeping"),
    ],
)
def test_tunnel_mode_needs_lost_gps_and_two_walls(gps_lost_s, sonar, state):
    m = Machine(P)
    m.decide(situation(gps_lost_s=gps_lost_s, sonar=sonar))
    assert m.state == state


def test_tunnel_mode_leads_to_the_centre_line():
    m = Machine(P)
    walls = {**WALLS, "left_front": 1.3, "left_rear": 1.3, "right_front": 0.5, "right_rear": 0.5}
    plan = m.decide(situation(gps_lost_s=1.0, sonar=walls))
    assert plan.command.pathpoint_m[-1, 1] == pytest.approx(0.4, abs=0.05)


def test_tunnel_mode_leaves_only_to_path_point_keeping():
    assert [target for target, _ in TRANSITIONS["tunnel_mode"]] == ["path_point_keeping"]
    m = Machine(P)
    m.decide(situation(gps_lost_s=1.0, sonar=WALLS))
    blocked = situation((15.0, 20.0, -4.0, 1.5), t=1.0, gps_lost_s=2.0, sonar=WALLS)
    m.decide(blocked)
    assert m.state == "tunnel_mode"
    m.decide(situation(t=2.0, gps_lost_s=3.0, sonar=OPEN))
    assert m.state == "tunnel_mode"
    m.decide(situation(t=3.0, gps_lost_s=4.0, sonar=OPEN))
    assert (m.state, m.reason) == ("path_point_keeping", "walls ended")


def test_new_path_at_a_waypoint_at_the_fifth_point_and_when_blocked():
    m = Machine(P)
    first = m.decide(situation())
    assert first.replanned == "new state"
    assert m.decide(situation(t=0.1)).replanned == ""
    assert m.decide(replace(situation(t=0.2), waypoint=2)).replanned == "waypoint passed"
    far = situation(t=0.3)
    moved = replace(far.ego, position_m=np.array([6.0, 0.0]))
    at_fifth = replace(far, ego=moved, waypoint=2)
    assert m.decide(at_fifth).replanned == "fifth pathpoint reached"


def test_a_goal_behind_counts_only_while_it_is_steered_for():
    """Operations turn the vehicle; asked for again at once, all six tries would go in a second."""
    m = Machine(P)
    limit_s = P.states.stuck.behind_s
    blocked = replace(situation((15.0, 20.0, -4.0, 1.5)), goal_rad=np.pi, half_width_m=20.0)
    t = 0.0
    while m.state != "robotic_operations" and t < limit_s + 1.0:
        m.decide(replace(blocked, time_ns=int(t * 1e9)))
        t += 0.1
    assert m.reason == "the goal lies behind"
    assert t > limit_s
    m.decide(replace(blocked, time_ns=int(t * 1e9)))
    assert m.memory.trouble.behind_s == 0.0


def test_a_path_that_ends_before_it_is_joined_is_not_clear():
    """Behind the end of the route, far beside it, a path of half a metre is free and leads nowhere:
    field 34 of density 240 drove on beside it, blind, into a circle."""
    stub = sampled(np.array([[0.0, 0.0], [0.4, 0.0]]))
    clear = clear_distances(stub, situation().boundaries, P.planning.footprint)
    missed = replace(situation(), route_ahead=stub, route_clear=clear, cross_track_m=-9.0)
    m = Machine(P)
    m.decide(missed)
    assert m.reason == "smooth path ends before it is joined"
    m.decide(replace(missed, cross_track_m=0.1))
    assert m.state == "path_point_keeping"


def test_a_way_around_is_looked_for_at_once_and_not_kept_beyond_the_trouble():
    trouble, s = Trouble(), replace(situation(), far_goal_m=(20.0, 0.0))
    s = replace(s, wide=s.boundaries)
    trouble.look(s, P.states.stuck)
    assert trouble.way == []
    for _ in range(2):  # the second time as the first
        trouble.begin(s)
        trouble.look(s, P.states.stuck)
        assert trouble.way
        assert trouble.goal_m is not None
        on = replace(s, arc_m=s.arc_m + 2.0 * P.states.stuck.progress_m)
        trouble.observe(on, 0.1, P.states.stuck)
        trouble.look(on, P.states.stuck)
        assert trouble.way == []
        assert trouble.goal_m is None


def test_who_cannot_roll_back_any_farther_operates_again():
    memory = Memory()
    memory.trouble.rolls_far = True
    assert room_again(situation(), memory, P) == "0.0 m back"
    for k in range(20):
        memory.trail.record((0.5 * k - 9.5, 0.0, 0.0), P.states.rollback.longest_m)
    assert room_again(situation(), memory, P) == ""


def test_a_place_that_the_vehicle_stands_on_lies_on_no_circle():
    assert curvature_back(0.0, 0.0, 4.0) == 0.0
    assert curvature_back(-2.0, 2.0, 1.0) == 0.5
    assert curvature_back(-2.0, -2.0, 4.0) == -0.25
