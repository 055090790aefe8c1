"""The NQE course against the numbers that are known of it, measured on what was built."""

import pickle
from functools import lru_cache
from itertools import pairwise

import numpy as np
import pytest
from free_passage import corners_m, free_width_m, lateral_m, rotation, samples

from nav.route.rddf import FOOT_M, MPH_MPS, parse
from scenarios.course import Course
from scenarios.nqe import build

SEEDS = range(10)
course = lru_cache(maxsize=None)(build)
each_seed = pytest.mark.parametrize("seed", SEEDS)


def of_kind(c: Course, *kinds: str):
    return [o for o in c.world.obstacles if o.kind in kinds]


def footprint(c: Course, owner: str) -> np.ndarray:
    parts = [corners_m(o)[:, :2] for o in c.world.obstacles if o.owner == owner]
    return np.concatenate(parts)


def speed_at(c: Course, points: np.ndarray) -> np.ndarray:
    """Limits [mph] and half-widths [ft] at the samples of the route nearest to points."""
    at, _, width = samples(c, 0.25)
    length = np.hypot(*np.diff(c.waypoint_m, axis=0).T)
    counts = [len(np.arange(0.0, part, 0.25)) for part in length]
    speed = np.repeat(c.speed_mps[:-1], counts)
    k = [np.hypot(*(at - p).T).argmin() for p in points]
    return np.stack([speed[k] / MPH_MPS, width[k] / FOOT_M], axis=1)


def turns(c: Course) -> list[tuple[float, float]]:
    """Angle [deg] and least radius [m] of each turn, from the waypoints alone."""
    span = np.diff(c.waypoint_m, axis=0)
    heading = np.unwrap(np.arctan2(span[:, 1], span[:, 0]))
    bend = np.diff(heading)
    found, angle, radius = [], 0.0, np.inf
    for k, b in enumerate(np.append(bend, 0.0)):
        if abs(b) > 0.02 and angle * b >= 0.0:
            chord = np.hypot(*(c.waypoint_m[k + 2] - c.waypoint_m[k]))
            angle, radius = angle + b, min(radius, chord / (2.0 * abs(np.sin(b))))
        elif angle:
            found.append((float(np.degrees(abs(angle))), float(radius)))
            angle, radius = 0.0, np.inf
    return found


@each_seed
def test_length_is_2_7_miles(seed):
    length = np.hypot(*np.diff(course(seed).waypoint_m, axis=0).T).sum()
    assert length == pytest.approx(2.7 * 1609.344, rel=0.01)


@each_seed
def test_fifty_one_gates_of_the_right_width_and_offset(seed):
    gates = course(seed).gates
    assert len(gates) == 51
    width = np.array([np.hypot(*(g.left_m - g.right_m)) for g in gates])
    assert ((width >= 3.2) & (width <= 4.5)).all()
    middles = np.array([(g.left_m + g.right_m) / 2.0 for g in gates])
    offset = np.abs(lateral_m(middles, course(seed)))
    assert ((offset >= 0.8) & (offset <= 1.5)).sum() >= 15
    assert offset.max() <= 1.501


@each_seed
def test_gates_are_in_driving_order_and_left_is_left(seed):
    c = course(seed)
    at, direction, _ = samples(c)
    stations = []
    for gate in c.gates:
        k = int(np.hypot(*(at - (gate.left_m + gate.right_m) / 2.0).T).argmin())
        x, y = gate.left_m - gate.right_m
        assert direction[k, 0] * y - direction[k, 1] * x > 3.0
        stations.append(k)
    assert stations == sorted(stations)


@each_seed
def test_the_opening_is_the_only_way_through_a_gate(seed):
    c = course(seed)
    width = speed_at(c, np.array([(g.left_m + g.right_m) / 2.0 for g in c.gates]))[:, 1]
    for number, gate in enumerate(c.gates, start=1):
        across = (gate.left_m - gate.right_m) / np.hypot(*(gate.left_m - gate.right_m))
        parts = [o for o in c.world.obstacles if o.owner == f"gate_{number:02d}"]
        for post, way in ((gate.left_m, across), (gate.right_m, -across)):
            line = post + way * np.arange(0.01, 7.0, 0.1)[:, None]
            inside = np.abs(lateral_m(line, c)) < width[number - 1] * FOOT_M
            closed = np.any([covers(o, line) for o in parts], axis=0)
            assert closed[inside].all()
            assert inside.any()
        opening = gate.right_m + np.linspace(0.02, 0.98, 40)[:, None] * (gate.left_m - gate.right_m)
        assert not any(covers(o, opening).any() for o in parts)


def covers(obstacle, points):
    """Whether points (n, 2) lie in the obstacle's footprint."""
    local = (points - obstacle.center_m[:2]) @ rotation(obstacle.quat)[:2, :2]
    half = np.array(obstacle.half_size_m[:2])
    if obstacle.shape == "cylinder":
        return np.hypot(*local.T) <= half[0]
    return (np.abs(local) <= half).all(axis=1)


@each_seed
def test_turns(seed):
    found = turns(course(seed))
    sharp = [radius for angle, radius in found if angle > 60.0]
    assert len(sharp) >= 12
    assert sum(radius <= 10.0 for radius in sharp) >= 3
    assert min(radius for _, radius in found) >= 8.5


@each_seed
def test_tunnel_measures(seed):
    c = course(seed)
    axis = c.tunnel_center_line_m
    into, out = np.diff(axis, axis=0)
    assert np.hypot(*into) + np.hypot(*out) == pytest.approx(100.0 * FOOT_M)
    bend = np.degrees(np.arctan2(into[0] * out[1] - into[1] * out[0], into @ out))
    assert 2.0 <= abs(bend) <= 4.0
    points = np.concatenate([axis[0] + into * np.linspace(0.0, 1.0, 20)[:, None],
                             axis[1] + out * np.linspace(0.0, 1.0, 20)[:, None]])  # fmt: skip
    miss = np.abs(lateral_m(points, c))
    assert miss.min() >= 0.299
    assert miss.max() <= 0.601
    assert speed_at(c, points)[:, 0] == pytest.approx(np.full(40, 5.0))


@each_seed
def test_tunnel_is_3_0_to_3_6_m_wide_inside(seed):
    c = course(seed)
    axis = c.tunnel_center_line_m
    middle = (axis[0] + axis[1]) / 2.0
    across = (
        np.array([[0.0, -1.0], [1.0, 0.0]]) @ (axis[1] - axis[0]) / np.hypot(*(axis[1] - axis[0]))
    )
    line = np.arange(-3.0, 3.0, 0.005)
    walls = [o for o in of_kind(c, "tunnel") if "wall" in o.name]
    taken = np.any([covers(o, middle + line[:, None] * across) for o in walls], axis=0)
    width = line[taken & (line > 0.0)].min() - line[taken & (line < 0.0)].max()
    assert 2.99 <= width <= 3.61


@each_seed
def test_the_tunnel_is_the_only_way(seed):
    """Beside it the corridor is narrower than the vehicle."""
    c = course(seed)
    _, half_width_ft = speed_at(c, c.tunnel_center_line_m[1:2])[0]
    outer = [np.abs(lateral_m(corners_m(o)[:, :2], c)).max() for o in of_kind(c, "tunnel")]
    least = min(
        np.abs(lateral_m(corners_m(o)[:, :2], c)).min() for o in of_kind(c, "tunnel")
        if "wall" in o.name
    )  # fmt: skip
    assert half_width_ft * FOOT_M - least < 1.52
    assert max(outer) > 1.5


@each_seed
def test_satellites_are_hidden_in_the_tunnel_and_seen_outside(seed):
    c = course(seed)
    azimuth, elevation = c.world.satellites.T
    assert len(azimuth) >= 8
    rays = np.stack([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth),
                     np.sin(elevation)], axis=1)  # fmt: skip
    first, middle, last = c.tunnel_center_line_m
    inside = [first + (middle - first) * f for f in (0.3, 0.6, 1.0)]
    inside += [last + (middle - last) * f for f in (0.3, 0.6)]
    boxes = of_kind(c, "tunnel")
    assert not any(sees(c, boxes, p, ray) for p in inside for ray in rays)
    before = first - (middle - first) / np.hypot(*(middle - first)) * 30.0
    assert sum(sees(c, boxes, before, ray) for ray in rays) >= 8


def sees(c, boxes, point, ray):
    antenna = np.array([*point, c.world.terrain.height(*point[:, None])[0] + 1.98])
    return not any(hits(o, antenna, ray) for o in boxes)


def hits(obstacle, origin, ray):
    """Slab test of a ray against a box."""
    turn = rotation(obstacle.quat)
    o, d = (origin - obstacle.center_m) @ turn, ray @ turn
    half = np.array(obstacle.half_size_m)
    near, far = np.sort(np.stack([(-half - o) / d, (half - o) / d]), axis=0)
    return near.max() <= far.min() and far.min() > 0.0


@each_seed
def test_every_car_covers_the_route_line_by_half_a_metre(seed):
    c = course(seed)
    cars = sorted({o.owner for o in of_kind(c, "car")})
    assert len(cars) >= 5
    for car in cars:
        offset = lateral_m(footprint(c, car), c)
        assert min(offset.max(), -offset.min()) >= 0.5
        body = next(o for o in c.world.obstacles if o.name == f"{car}_body")
        assert body.half_size_m[:2] == (2.3, 0.9)


@each_seed
def test_two_car_section(seed):
    c = course(seed)
    first, second = (footprint(c, f"two_cars_01_{which}") for which in ("first", "second"))
    apart = np.hypot(*(first.mean(axis=0) - second.mean(axis=0)))
    assert apart == pytest.approx(100.0 * FOOT_M, abs=3.0)
    sides = [np.sign(lateral_m(car.mean(axis=0)[None], c)[0]) for car in (first, second)]
    assert sides[0] == -sides[1]
    middles = np.array([first.mean(axis=0), second.mean(axis=0)])
    assert speed_at(c, middles) == pytest.approx(np.array([[10.0, 15.0]] * 2))


@each_seed
def test_what_else_stands_there(seed):
    kinds = {o.kind for o in course(seed).world.obstacles}
    assert {"hay_bale", "tires", "tank_trap", "rumble_strip"} <= kinds
    mph = course(seed).speed_mps / MPH_MPS
    assert mph.min() == pytest.approx(5.0)
    assert mph.max() == pytest.approx(25.0)


@each_seed
def test_order_of_the_course(seed):
    """Cattle crossing, tunnel, parked cars, ..., tank trap near the end."""
    names = [o.owner for o in course(seed).world.obstacles]
    first = [
        names.index(n) for n in ("gate_01", "gate_05", "tunnel_01_in", "car_01", "tank_trap_01")
    ]
    assert first == sorted(first)
    assert names.index("tank_trap_01") > names.index("gate_50")


@each_seed
def test_everywhere_is_a_free_passage(seed):
    assert free_width_m(course(seed)).min() >= 2.9


@each_seed
def test_a_pass_between_slopes(seed):
    c = course(seed)
    (bank,) = c.world.terrain.features
    (ax, ay), (bx, by) = bank.line_m
    middle = np.array([(ax + bx) / 2.0, (ay + by) / 2.0])
    left = np.array([ay - by, bx - ax]) / np.hypot(bx - ax, by - ay)
    for side in (left, -left):
        foot, up = (middle + side * d for d in (2.0, 5.0))
        rise = c.world.terrain.height(*np.array([foot, up]).T)
        assert 18.0 < np.degrees(np.arctan2(rise[1] - rise[0], 3.0)) < 33.0
    assert speed_at(c, middle[None]) == pytest.approx(np.array([[5.0, 8.0]]))


@each_seed
def test_ground_is_gentle_on_the_route_line(seed):
    point, direction, _ = samples(course(seed), 1.0)
    height = course(seed).world.terrain.height
    rise = height(*(point + 0.85 * direction).T) - height(*(point - 0.85 * direction).T)
    assert np.percentile(np.abs(rise) / 1.7, 99) < 0.04


def test_legs_lie_apart_so_that_corridors_do_not_touch():
    point, _, _ = samples(course(0), 4.0)
    k = np.arange(len(point))
    apart = np.hypot(*(point[:, None] - point).transpose(2, 0, 1))
    assert apart[np.abs(k[:, None] - k) > 25].min() > 25.0


@each_seed
def test_datum_friction_and_start(seed):
    c = course(seed)
    assert np.hypot(*c.waypoint_m[0]) <= 0.5
    turn = np.degrees(np.arctan2(*(c.waypoint_m[1] - c.waypoint_m[0])[::-1]))
    assert abs(turn) <= 1.0
    assert 0.5 <= c.world.friction <= 0.9
    x, y, heading = c.world.start
    assert abs(lateral_m(np.array([[x, y]]), c)[0]) <= 0.31
    assert abs(np.degrees(heading) - turn) <= 3.0


def test_the_route_text_is_what_the_course_says():
    c = course(3)
    route = parse(c.route_text, c.route_name)
    assert (route.half_width_m == c.half_width_m).all()
    assert (route.speed_mps == c.speed_mps).all()
    assert len(route) == len(c.waypoint_m)
    assert len(c.route_text.split(",")[1].split(".")[1]) >= 9


def test_same_seed_same_bits():
    assert pickle.dumps(build(4)) == pickle.dumps(build(4))


def test_seeds_differ_in_everything_that_they_draw():
    for a, b in pairwise(SEEDS):
        one, other = course(a), course(b)
        moved = [p.center_m != q.center_m for p, q in
                 zip(one.world.obstacles, other.world.obstacles, strict=True)]  # fmt: skip
        assert all(moved)
        assert one.route_text != other.route_text
        assert one.world.friction != other.world.friction
        assert one.world.start != other.world.start


def test_a_course_pickles():
    c = pickle.loads(pickle.dumps(course(5)))
    assert c.world.obstacles == course(5).world.obstacles
    assert (c.waypoint_m == course(5).waypoint_m).all()
    x = np.array([1.0, 2.0])
    assert (c.world.terrain.height(x, x) == course(5).world.terrain.height(x, x)).all()
