"""The course of the small robot: its numbers, its criterion, and drives with and without eyes."""

from collections import Counter

import numpy as np
import pytest

from ion.courses import Source
from ion.drive.options import Options, job_of
from ion.errors import UsageError
from nav.route import rddf
from scenarios.episode import Episode
from scenarios.run import run
from scenarios.small_robot import build
from scenarios.small_robot.course import GATES_M, HALF_WIDTH_M, LENGTH_M
from scenarios.small_robot.placement import MARGIN_M, Placement, draw, leaves_room, way_m
from scenarios.things import generator

ROBOT_WIDTH_M = 0.497
EASY = Placement(0.2, 1.0, 0.1, 2.0, 0.2, 0.15, False, (0.6, 0.6))


def figures(seed, *ablate):
    return run(Episode(build(seed), seed, ablate))


def along(course):
    """Unit vector of the corridor."""
    step = course.waypoint_m[-1] - course.waypoint_m[0]
    return step / np.linalg.norm(step)


# ---------------------------------------------------------------- the course


@pytest.mark.parametrize("seed", range(20))
def test_three_gates_in_a_straight_corridor(seed):
    course = build(seed)
    ahead = along(course)
    left = np.array([-ahead[1], ahead[0]])
    assert np.linalg.norm(course.waypoint_m[-1] - course.waypoint_m[0]) == pytest.approx(LENGTH_M)
    assert course.half_width_m == pytest.approx(np.full(6, 6 * 0.3048))
    kinds = Counter(obstacle.kind for obstacle in course.world.obstacles)
    assert kinds == {"wall": 2, "gate_flank": 6, "third": 3}
    for gate, at in zip(course.gates, GATES_M, strict=True):
        across = gate.left_m - gate.right_m
        assert across @ left == pytest.approx(np.linalg.norm(across))
        assert across @ left >= ROBOT_WIDTH_M + 2 * MARGIN_M
        assert gate.left_m @ ahead == pytest.approx(at)
    assert course.facts == {"leaves_room": True}


@pytest.mark.parametrize("seed", range(20))
def test_the_third_obstacle_stands_in_the_way_straight_on(seed):
    course = build(seed)
    ahead = along(course)
    left = np.array([-ahead[1], ahead[0]])
    thirds = [o for o in course.world.obstacles if o.kind == "third"]
    for gate, third in zip(course.gates, thirds, strict=True):
        offset = np.array(third.center_m[:2]) - 0.5 * (gate.left_m + gate.right_m)
        assert 1.0 < offset @ ahead < 3.0
        assert abs(offset @ left) < third.half_size_m[0] + 0.5 * ROBOT_WIDTH_M


def test_a_seed_draws_always_the_same_and_another_seed_another():
    one, same, other = build(5), build(5), build(6)
    assert one.world.obstacles == same.world.obstacles
    assert one.route_text == same.route_text
    assert one.world.obstacles != other.world.obstacles


def test_the_route_is_a_route_file():
    course = build(0)
    route = rddf.parse(course.route_text, course.route_name)
    assert len(route) == 6
    assert route.speed_mps == pytest.approx(np.full(6, 1.5 * 0.44704))


# ---------------------------------------------------------------- the criterion


def test_two_arcs_sideways():
    assert way_m(0.0) == 0.0
    assert way_m(0.5) == pytest.approx(np.sqrt(0.75))  # 2 R sin 60 deg with R = 0.5
    assert way_m(1.0) == way_m(3.0) == 1.0
    assert way_m(np.inf) == np.inf


@pytest.mark.parametrize(
    "changed",
    [
        {"opening_m": ROBOT_WIDTH_M + 2 * MARGIN_M - 0.01},
        {"behind_m": 1.0},
        {"third_half_m": HALF_WIDTH_M - 0.4},
    ],
)
def test_what_leaves_no_room(changed):
    assert leaves_room(EASY, HALF_WIDTH_M)
    assert not leaves_room(EASY._replace(**changed), HALF_WIDTH_M)


def test_mirrored_placements_are_alike():
    for k in range(200):
        drawn = draw(generator(k, "mirror"), HALF_WIDTH_M)
        for behind in (0.9, 1.1, 1.3, 1.5):
            p = drawn._replace(behind_m=behind)
            q = p._replace(offset_m=-p.offset_m, third_y_m=-p.third_y_m)
            assert leaves_room(p, HALF_WIDTH_M) == leaves_room(q, HALF_WIDTH_M)


# ---------------------------------------------------------------- the command


def test_ablations_are_those_of_this_vehicle(tmp_path):
    with pytest.raises(UsageError, match=r"no-lidar-roof: unknown; known are .*no-lidar-deck"):
        job_of(Options("small_robot", out=tmp_path, ablate=("no-lidar-roof",)))
    assert job_of(Options("small_robot", out=tmp_path, ablate=("no-lidar-deck",)))
    assert Source("small_robot").course(0).vehicle == "pioneer"


# ---------------------------------------------------------------- drives


def test_the_robot_gets_through():
    found = figures(0)
    assert found["outcome"] == "finished"
    assert found["gates_passed"] == found["gates_total"] == 3
    assert (found["contacts"], found["departures"]) == (0, 0)
    assert found["leaves_room"]
    assert 0.0 < found["min_clearance_m"] < 1.0


def test_who_drives_blind_touches_something():
    found = figures(0, "blind")
    assert (found["outcome"], found["contacts"]) == ("contact", 1)


@pytest.mark.slow
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("seed", range(1, 20))
def test_the_robot_gets_through_every_placement(seed):
    found = figures(seed)
    assert (found["outcome"], found["gates_passed"], found["contacts"]) == ("finished", 3, 0)


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_blind_drives_touch_nearly_always():
    touched = [figures(seed, "blind")["contacts"] for seed in range(20)]
    assert sum(touched) >= 19
