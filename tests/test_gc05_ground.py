"""The ground of the race: what rises and falls beside the track leaves the track as it is."""

import numpy as np
import pytest

from scenarios.gc05_route.course import build
from scenarios.gc05_route.plan import load_plan
from scenarios.gc05_route.shoulders import Shoulders
from scenarios.geometry import Pose
from scenarios.route.corridor import Corridor
from twin.landforms import Gully

COURSE = build(0)
CORRIDOR = Corridor.of(COURSE.waypoint_m, COURSE.half_width_m)
FORMS = COURSE.world.terrain.features[1:]  # type: ignore[attr-defined]
GULLIES = [form for form in FORMS if isinstance(form, Gully)]
(SHOULDERS,) = (form for form in FORMS if isinstance(form, Shoulders))


def beside(offset_m: float, stations_m: np.ndarray, left: bool) -> np.ndarray:
    """Heights that the shoulders add so far from the corridor's edge."""
    k, point = CORRIDOR.segment(stations_m), CORRIDOR.at(stations_m)
    away = (1.0 if left else -1.0) * (CORRIDOR.half_width_m[k] + offset_m)
    normal = np.stack([-CORRIDOR.direction[k, 1], CORRIDOR.direction[k, 0]], axis=1)
    return SHOULDERS.height(*(point + away[:, None] * normal).T)


def stations_of(kind: str) -> np.ndarray:
    """Every three metres of the stretches of a kind."""
    ends = np.cumsum([0, *(s.waypoints for s in load_plan().stretches)])
    spans = zip(ends, ends[1:], load_plan().stretches, strict=False)
    way = np.append(0.0, CORRIDOR.end_m)
    return np.concatenate(
        [np.arange(way[a], way[b - 1], 3.0) for a, b, s in spans if s.kind == kind]
    )


@pytest.mark.parametrize("left", [True, False])
def test_the_corridor_is_as_it_was(left: bool):
    for offset in (-1.0, 0.0):
        added = beside(offset, np.arange(0.0, CORRIDOR.way_m, 2.0), left)
        assert np.abs(added).max() == 0.0


def test_the_pass_has_a_wall_and_a_drop_at_its_end():
    assert np.median(beside(5.0, stations_of("pass"), left=True)) > 1.0
    first, last = load_plan().drop.waypoints
    at_the_drop = np.arange(CORRIDOR.waypoint(first + 1), CORRIDOR.waypoint(last - 1), 3.0)
    assert np.median(beside(6.0, at_the_drop, left=False)) < -1.5


def test_a_wash_has_banks_and_a_dry_lake_has_none():
    assert np.median(beside(4.0, stations_of("wash"), left=True)) > 0.3
    assert np.abs(beside(4.0, stations_of("dry_lake"), left=True)).max() < 0.35  # its ends


def test_the_ground_is_a_function_of_place_alone():
    rng = np.random.default_rng(0)
    for k in rng.integers(0, 2934, 30):
        x, y = (COURSE.waypoint_m[k][:, None] + np.arange(-40.0, 40.0, 0.5)).round(1)
        whole = SHOULDERS.height(x[None, :], y[:, None])
        i, j = rng.integers(0, 160, 2)
        assert SHOULDERS.height(x[i], y[j]) == whole[j, i]
        assert np.array_equal(SHOULDERS.height(x[None, :17], y[:, None]), whole[:, :17])


def test_the_old_road_ends_in_a_gully_outside_the_corridor():
    assert len(GULLIES) == 2
    for gully in GULLIES:
        pose = Pose(*gully.middle_m, gully.heading_rad)
        for along in np.linspace(-gully.half_length_m, gully.half_length_m, 9):
            assert CORRIDOR.outside(pose.moved(along, 0.0), gully.half_width_m)
        assert gully.height(*(np.array(v) for v in gully.middle_m)) == -gully.depth_m


def test_boulders_hide_the_trap_from_who_comes_to_the_corner():
    plan = load_plan().blind_corner
    corner_m = CORRIDOR.waypoint(plan.waypoint)
    parts = COURSE.world.around(*CORRIDOR.pose(corner_m).at(0.0, 0.0))
    trap = next(o for o in parts if o.owner == "trap_across_576")
    boulders = np.array([o.center_m[:2] for o in parts if o.owner == "boulder_576"])
    for before in np.arange(14.0, 24.0, 1.0):
        eye = np.array(CORRIDOR.pose(corner_m - before).at(0.0, 0.0))
        look = np.array(trap.center_m[:2]) - eye
        u = (boulders - eye) @ look / (look @ look)
        gap = np.hypot(*(boulders - eye - u[:, None] * look).T)
        assert gap.min() < max(plan.boulder_half_m)
