"""Courses made of route files: the real one, and small ones."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from free_passage import corners_m, free_width_m, lateral_m

from nav.route.rddf import RouteError, parse
from scenarios.route import build
from twin.earth import to_geodetic

REAL = Path(__file__).parents[2] / "shared" / "data" / "gc04_race_rddf.txt"
needs_real = pytest.mark.skipif(not REAL.exists(), reason=f"no real route file at {REAL}")


def straight_route(count=12, spacing_m=60.0, half_width_ft=12.0):
    """Waypoints eastwards, numbered from 1."""
    lat, lon = to_geodetic((35.0, -115.0), spacing_m * np.arange(count), np.zeros(count))
    return "".join(
        f"{k + 1},{lat[k]:.9f},{lon[k]:.9f},{half_width_ft:g},25,####,####,####\n"
        for k in range(count)
    )


def test_the_stretch_alone_is_the_course():
    c = build(straight_route(), "r.txt", 3, 7, 0)
    route = parse(c.route_text, "r.txt")
    assert route.number.tolist() == [3, 4, 5, 6, 7]
    assert len(c.waypoint_m) == 5
    assert c.waypoint_m[0] == pytest.approx([0.0, 0.0], abs=1e-6)
    assert c.waypoint_m[-1, 0] == pytest.approx(240.0, abs=0.1)
    assert c.world.anchor == (route.latitude_deg[0], route.longitude_deg[0])


def test_it_starts_at_the_first_waypoint_along_the_first_segment():
    c = build(straight_route(), "r.txt", None, None, 0)
    assert c.world.start == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)
    assert len(c.waypoint_m) == 12


def test_the_time_limit_leaves_room():
    c = build(straight_route(), "r.txt", None, None, 0)
    assert c.time_limit_s == pytest.approx(3.0 * 660.0 / (25 * 0.44704) + 120.0, rel=1e-3)


@pytest.mark.parametrize("seed", range(6))
def test_things_leave_a_way(seed):
    c = build(straight_route(40), "r.txt", None, None, seed)
    assert free_width_m(c).min() >= 2.89


def test_things_reach_into_the_corridor_and_some_stand_outside():
    c = build(straight_route(40), "r.txt", None, None, 1)
    near = np.array([np.abs(lateral_m(corners_m(o)[:, :2], c)).min() for o in c.world.everything()])
    assert 3 <= (near < 12 * 0.3048 - 0.05).sum() < 0.3 * len(near)
    assert len(near) > 80


def test_where_the_corridor_is_narrow_nothing_reaches_in():
    c = build(straight_route(40, half_width_ft=4.8), "r.txt", None, None, 1)
    near = [np.abs(lateral_m(corners_m(o)[:, :2], c)).min() for o in c.world.everything()]
    assert min(near) >= 4.8 * 0.3048


def test_the_start_is_clear():
    c = build(straight_route(), "r.txt", None, None, 2)
    assert min(np.hypot(*o.center_m[:2]) for o in c.world.everything()) > 20.0


def test_same_seed_same_bits_and_another_seed_another_course():
    one, same, other = (build(straight_route(), "r.txt", None, None, s) for s in (3, 3, 4))
    assert pickle.dumps(one) == pickle.dumps(same)
    assert one.world.everything() != other.world.everything()
    assert one.world.friction != other.world.friction


def test_names_are_unique():
    names = [o.name for o in build(straight_route(40), "r.txt", None, None, 5).world.everything()]
    assert len(names) == len(set(names))


def test_a_stretch_that_is_not_there_is_refused():
    with pytest.raises(RouteError, match=r"r\.txt: no stretch from 5 to 50"):
        build(straight_route(), "r.txt", 5, 50, 0)


@needs_real
def test_the_real_stretch():
    text = REAL.read_text()
    c = build(text, REAL.name, 2053, 2120, 0)
    assert len(c.waypoint_m) == 68
    assert len(c.world.everything()) > 200
    assert free_width_m(c).min() >= 2.89
