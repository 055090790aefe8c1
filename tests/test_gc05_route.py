"""The race: its route has the known figures, and what stands on it leaves a way."""

from collections import defaultdict

import numpy as np
import pytest
from free_passage import corners_m, free_width_m, lateral_m

from nav.route.rddf import FOOT_M, RouteError, parse
from scenarios.gc05_route import underpasses
from scenarios.gc05_route.course import build
from scenarios.gc05_route.plan import load_plan
from scenarios.gc05_route.route import text
from scenarios.gc05_route.wayside import FREE_M
from scenarios.route.statistics import miles_at, statistics, turns_rad

ROUTE = parse(text(), "gc05.rddf")


def test_the_known_figures():
    s = statistics(ROUTE)
    assert s.waypoints == 2935
    assert s.miles == pytest.approx(131.6, abs=0.01)
    assert s.mean_spacing_m == pytest.approx(72.0, abs=0.5)
    assert s.sharp_turns > 100
    assert np.degrees(s.switchback_rad) > 120.0
    assert 28.0 < miles_at(ROUTE)[575] < 32.0
    assert s.at_limits_s < 0.65 * 36_000.0


def test_no_turn_is_sharper_than_those_of_gc04_but_the_two_near_waypoint_576():
    turn = np.degrees(np.abs(turns_rad(ROUTE)))
    robotic = load_plan().robotic
    at = [number - 2 for number in robotic.waypoints]
    assert turn[at] == pytest.approx(robotic.turn_deg, abs=0.5)
    assert np.delete(turn, at).max() < 73.5


def test_limits_are_those_of_gc04():
    plan, s = load_plan(), statistics(ROUTE)
    for mph, share in zip(plan.speeds.mph, plan.speeds.share, strict=True):
        assert s.speed_share[mph] == pytest.approx(share, abs=0.005)
    least, median, mean, _ = s.half_width_ft
    assert (least, median) == (6.0, 8.0)
    assert mean == pytest.approx(10.6, abs=1.5)


def test_the_route_meets_itself_nowhere():
    c = build(0)
    point = c.waypoint_m
    for k in range(len(point) - 8):
        gap = np.hypot(*(point[k + 8 :] - point[k]).T).min()
        assert gap > 2.5 * c.half_width_m[k]


def test_three_narrow_underpasses():
    c = build(0)
    assert len(set(underpasses.segments(c.waypoint_m))) == 3
    assert sum(o.kind == "tunnel" for o in c.world.everything()) == 9


@pytest.mark.parametrize("seed", range(3))
def test_at_least_four_hundred_things_stand_on_the_line(seed):
    across = [o for o in build(seed).world.everything() if "across" in o.name]
    assert len({o.owner for o in across}) >= 400
    assert {o.kind for o in across} == {"rock", "car", "tank_trap", "hay_bale"}


def test_they_cover_the_line_by_half_a_metre():
    c = build(0, 300, 420)
    sides = defaultdict[str, list[float]](list)
    for o in c.world.everything():
        if "across" in o.name:
            sides[o.owner] += lateral_m(corners_m(o)[:, :2], c).tolist()
    assert len(sides) > 5
    assert min(min(max(side), -min(side)) for side in sides.values()) >= 0.48


@pytest.mark.parametrize(("first", "last"), [(1, 90), (460, 560), (2560, 2780)])
def test_things_leave_a_way(first, last):
    c = build(1, first, last)
    free, narrow = free_width_m(c), 2.0 * c.half_width_m[:-1].min()
    assert free.min() >= min(FREE_M - 0.1, narrow)


def test_a_stretch_has_the_things_of_the_whole():
    whole, part = build(3), build(3, 700, 720)
    at = part.waypoint_m[10]
    assert part.world.around(*at) == whole.world.around(*at)
    assert part.world.terrain.height(*at) == whole.world.terrain.height(*at)
    assert len(part.waypoint_m) == 21
    assert len(part.world.everything()) < 400


def test_faults_are_where_they_are_on_the_whole():
    assert [f.begins for f in build(0).world.faults] == [14_000.0, 36_000.0]
    later = build(0, 300, 700).world.faults
    assert len(later) == 1
    assert 0.0 < later[0].begins < 36_000.0


def test_a_stretch_that_is_not_there_is_refused():
    with pytest.raises(RouteError, match="no stretch from 30 to 20"):
        build(0, 30, 20)


def test_sharp_turns_are_wider_than_the_rest_as_on_gc04():
    width = np.minimum(ROUTE.half_width_m[:-2], ROUTE.half_width_m[1:-1]) / FOOT_M
    sharp = np.degrees(np.abs(turns_rad(ROUTE))) > 30.0
    assert 10.0 <= np.median(width[sharp]) <= 13.0
