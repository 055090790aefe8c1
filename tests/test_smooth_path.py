from pathlib import Path

import numpy as np
import pytest

from nav.route.corridor import foot
from nav.route.rddf import parse
from nav.route.rounding import Rounding
from nav.route.smooth_path import catmull_rom, project, smooth_path
from nav.route.waypoints import Waypoints, route_frame, waypoints_of

GC04 = Path(__file__).parents[2] / "shared" / "data" / "gc04_race_rddf.txt"
real_data = pytest.mark.skipif(
    not GC04.exists(), reason=f"{GC04} is not here: real data is not committed"
)
OUTLINE = ((2.10, 0.762), (2.10, -0.762), (-0.95, 0.762), (-0.95, -0.762))


def waypoints(position, half_width=4.0):
    position = np.array(position, dtype=float)
    n = len(position)
    return Waypoints(position, np.full(n, half_width), np.full(n, 5.0))


def gc04():
    route = parse(GC04.read_text(), GC04.name)
    return waypoints_of(route, route_frame(route))


def corridor_depth(points, segment, route):
    """How deep points lie in the corridor of the segments n - 2 to n + 2."""
    P, best = route.position_m, np.full(len(points), -np.inf)
    for shift in range(-2, 3):
        s = np.clip(segment + shift, 0, route.segments - 1)
        distance = np.linalg.norm(points - foot(points, P[s], P[s + 1]), axis=1)
        best = np.maximum(best, route.half_width_m[s] - distance)
    return best


def outline_depth(path, route):
    c, s = np.cos(path.heading_rad), np.sin(path.heading_rad)
    corners = [np.column_stack([c * x - s * y, s * x + c * y]) for x, y in OUTLINE]
    depths = [corridor_depth(path.position_m + k, path.segment, route) for k in corners]
    return np.min(depths, axis=0)


def spots(mask, arc_m, apart_m=5.0):
    """How many separate places a mask marks."""
    where = arc_m[mask]
    return int(len(where) > 0) + int((np.diff(where) > apart_m).sum())


# ---------------------------------------------------------------- equations (6.1) to (6.4)


def test_catmull_rom_passes_through_its_points_with_a_continuous_tangent():
    points = np.random.default_rng(8).uniform(0, 10, (8, 2))
    P, T, _ = catmull_rom(points, 10)
    np.testing.assert_allclose(P[::10], points, atol=1e-12)  # (6.3), first two lines
    P_fine, T_fine, _ = catmull_rom(points, 100_000)
    for k in range(1, 7):  # (6.3), third line: the limits from both sides agree
        np.testing.assert_allclose(T_fine[k * 100_000 - 1], T[k * 10], atol=1e-3)
    rate = (P_fine[1:] - P_fine[:-1]) * 100_000  # (6.2)
    np.testing.assert_allclose(rate, T_fine[:-1], atol=1e-3)


def test_catmull_rom_second_derivative_is_that_of_the_tangent():
    points = np.random.default_rng(9).uniform(0, 10, (4, 2))
    _, T, dT = catmull_rom(points, 1000)
    inner = slice(1000, 1999)  # within one piece: at the knots it jumps
    rate = (T[1001:2000] - T[1000:1999]) * 1000
    np.testing.assert_allclose(rate, dT[inner], atol=0.1)


# ---------------------------------------------------------------- shapes that one can check by eye


def test_a_straight_route_stays_straight():
    path = smooth_path(waypoints([[0, 0], [3, 4], [60, 80], [600, 800]]))
    np.testing.assert_allclose(path.heading_rad, np.arctan2(4, 3), atol=1e-9)
    np.testing.assert_allclose(path.curvature_per_m, 0.0, atol=1e-9)
    np.testing.assert_allclose(path.position_m[[0, -1]], [[0, 0], [600, 800]], atol=1e-9)
    assert path.arc_m[-1] == pytest.approx(1000.0)
    assert np.diff(path.arc_m).max() <= 0.5


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_right_angle_is_rounded_inside_the_corridor(side):
    route = waypoints([[0, 0], [60, 0], [60, side * 60]], half_width=5.0)
    path = smooth_path(route)
    assert np.abs(path.curvature_per_m).max() < 1 / 6.5
    assert path.heading_rad[-1] == pytest.approx(side * np.pi / 2)
    assert outline_depth(path, route)[10:-10].min() > 0.0


def test_mirrored_routes_give_mirrored_paths():
    left, right = (smooth_path(waypoints([[0, 0], [40, 0], [50, s * 30]])) for s in (1, -1))
    np.testing.assert_allclose(left.position_m, right.position_m * [1, -1], atol=1e-9)
    np.testing.assert_allclose(left.curvature_per_m, -right.curvature_per_m, atol=1e-9)


def test_a_hairpin_without_room_stays_tight_and_has_no_loop():
    route = waypoints([[0, 0], [50, 0], [50, 6], [0, 6]], half_width=2.0)
    path = smooth_path(route)
    assert np.abs(path.curvature_per_m).max() > 1 / 5.8  # a corner left to Robotic Operations
    assert path.heading_rad[-1] == pytest.approx(np.pi, abs=0.01)
    assert (np.diff(path.heading_rad) > -0.15).all()


def test_neighbours_of_very_different_length_make_no_loop():
    path = smooth_path(waypoints([[0, 0], [70, 0], [71, 0.5], [72, 0], [142, 0]]))
    assert np.abs(path.heading_rad).max() < 0.6
    assert (np.diff(path.position_m[:, 0]) > 0).all()


def test_samples_know_their_segment_and_speed_limit():
    route = Waypoints(
        np.array([[0.0, 0.0], [20.0, 0.0], [50.0, 0.0]]),
        np.array([4.0, 4.0, 4.0]),
        np.array([3.0, 7.0, 0.0]),
    )
    path = smooth_path(route)
    x = path.position_m[:, 0]
    assert set(path.segment[x < 19.5]) == {0}
    assert set(path.segment[x > 20.5]) == {1}
    np.testing.assert_array_equal(path.speed_limit_mps, np.array([3.0, 7.0])[path.segment])


def test_the_shortest_route_of_all():
    path = smooth_path(waypoints([[0, 0], [0.3, 0]]))
    np.testing.assert_allclose(path.position_m[[0, -1]], [[0, 0], [0.3, 0]], atol=1e-12)


# ---------------------------------------------------------------- projection


def test_projection_is_left_positive_and_local():
    path = smooth_path(waypoints([[0, 0], [50, 0], [50, 30], [0, 30]], half_width=8.0))
    place = project(path, np.array([20.1, 1.5]), near_index=30)
    assert place.cross_track_m == pytest.approx(1.5)
    assert place.arc_m == pytest.approx(20.1)
    assert project(path, np.array([20.1, -2.0]), 30).cross_track_m == pytest.approx(-2.0)
    back = project(path, np.array([20.0, 16.0]), len(path.arc_m) - 40)
    assert back.index > len(path.arc_m) // 2
    assert back.cross_track_m == pytest.approx(14.0)


def test_projection_takes_any_index():
    path = smooth_path(waypoints([[0, 0], [50, 0]]))
    assert project(path, np.array([1.0, 0.0]), -5).arc_m == pytest.approx(1.0)
    assert project(path, np.array([49.0, 0.0]), 10_000).arc_m == pytest.approx(49.0)


# ---------------------------------------------------------------- the whole real race


@real_data
def test_the_real_race_has_no_loop_and_few_tight_spots():
    route = gc04()
    path = smooth_path(route)
    step = np.diff(path.arc_m)
    assert 0.0 < step.min() <= step.max() <= 0.5
    assert path.arc_m[-1] == pytest.approx(229_000, rel=0.01)
    _no_sample_runs_against_its_segment(path, route)
    _no_crossing_within(path, 60.0)
    tight = spots(np.abs(path.curvature_per_m) > 1 / 5.8, path.arc_m)
    assert tight <= 3  # 65 with evenly inserted points alone, 276 on the waypoints as they come


def _no_sample_runs_against_its_segment(path, route):
    along = np.diff(route.position_m, axis=0)[path.segment]
    forwards = np.cos(path.heading_rad) * along[:, 0] + np.sin(path.heading_rad) * along[:, 1]
    assert (forwards > 0).all()
    assert (np.diff(path.segment) >= 0).all()


def _no_crossing_within(path, reach_m):
    """Only where the heading spans more than half a turn can a curve cross itself: look there."""
    count = int(np.ceil(reach_m / np.diff(path.arc_m).min()))
    low = high = path.heading_rad
    span = 1
    while span < count:  # running extremes over windows that double
        step = min(span, count - span)
        low = np.minimum(low[:-step], low[step:])
        high = np.maximum(high[:-step], high[step:])
        span += step
    for start in np.flatnonzero(high - low > np.pi)[::20]:
        assert not crosses_itself(path.position_m[start : start + count + 20])


def crosses_itself(points):
    """Whether any two pieces of a polyline that are not neighbours cross."""
    a, b = points[:-1], points[1:]

    def side(p, q, r):
        u, v = q - p, r - p
        return np.sign(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])

    ends = side(a[:, None], b[:, None], a) * side(a[:, None], b[:, None], b)
    crossing = (ends < 0) & (ends.T < 0)
    return bool(np.triu(crossing, 2).any())


def test_the_test_for_crossings_sees_one():
    turn = np.linspace(-0.3, 1.5 * np.pi, 40)
    lobe = np.column_stack([np.sin(turn), np.sin(2 * turn)])
    assert crosses_itself(lobe)
    assert not crosses_itself(np.column_stack([np.cos(turn), np.sin(turn)]))


@real_data
def test_the_outline_stays_in_the_corridor_of_the_real_race():
    route = gc04()
    path = smooth_path(route)
    inner = slice(10, -10)  # the front reaches past the finish
    assert spots(outline_depth(path, route)[inner] < 0.0, path.arc_m[inner]) == 0


@real_data
def test_rounding_is_what_opens_the_tight_spots():
    path = smooth_path(gc04(), Rounding(steps=0))
    assert spots(np.abs(path.curvature_per_m) > 1 / 5.8, path.arc_m) > 65
