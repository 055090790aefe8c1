"""The steering fuzzy controller: rules by hand, scenes of Fig. 6.6, and mirrored worlds."""

import pickle
from math import cos, inf, pi, sin
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nav.fuzzy.inference import activations, infer, strengths
from nav.parameters.fuzzy import SteeringParameters
from nav.parameters.loader import ParameterError, from_toml
from nav.planning.focus import angle_between, deduction, situation
from nav.planning.steering import Aim, decide, nearest

TEXT = (Path(__file__).parents[1] / "nav/parameters/steering.toml").read_text()
PARAMETERS = from_toml(SteeringParameters, TEXT, "steering.toml")
THETA = np.linspace(-pi / 2, pi / 2, 181)
D_MAX = 35.0
REAL_M, SAFE_M = 0.95, 1.5


def steer(theta, real, safe, heading, goal, previous, speed, V0):
    return decide(theta, real, safe, Aim(heading, goal, previous), speed, V0, PARAMETERS)


# ---------------------------------------------------------------- the rules, by hand


def ramp(x, low, high):
    return min(max((x - low) / (high - low), 0.0), 1.0)


def three_sets(x, a, b, c, d):
    small, large = 1 - ramp(x, a, b), ramp(x, c, d)
    return {"S": small, "M": min(1 - small, 1 - large), "L": large}


def stretch_by_hand(ratio):
    travelling = ramp(ratio, 0.3, 0.7)
    return 1.6 * (1 - travelling) + 1.0 * travelling


def focus_by_hand(delta_1, delta_2, stretch):
    abcd = [stretch * x for x in (0.21, 0.49, 0.79, 1.22)]
    p, q = three_sets(delta_1, *abcd), three_sets(delta_2, *abcd)
    strength = [
        min(p["S"], q["S"]),
        max(min(p["S"], q["M"]), min(p["M"], q["S"]), min(p["M"], q["M"])),
        max(min(p["S"], q["L"]), min(p["L"], q["S"])),
        max(min(p["L"], q["M"]), min(p["M"], q["L"])),
        min(p["L"], q["L"]),
    ]
    weighted = sum(s * v for s, v in zip(strength, (0, 4, 8, 13, 20), strict=True))
    return weighted / sum(strength)


def gap(a, b):
    difference = abs(a - b) % (2 * pi)
    return min(difference, 2 * pi - difference)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.45, 0.6, 0.7, 1.0])
def test_focus_and_persistence_agree_with_an_evaluation_by_hand(ratio):
    stretch = situation(5.0 * ratio, 5.0, PARAMETERS).stretch
    assert stretch == pytest.approx(stretch_by_hand(ratio), abs=1e-12)
    for heading, goal in [(0.0, 0.0), (0.3, -0.8), (-1.0, 2.0), (3.0, -3.0)]:
        found = deduction(THETA, heading, goal, 0.4, stretch, PARAMETERS)
        for theta, value in zip(THETA.tolist(), found.tolist(), strict=True):
            focus = focus_by_hand(gap(theta, heading), gap(theta, goal), stretch)
            persistence = 5.0 * ramp(gap(theta, 0.4), 0.21, 0.61)
            assert value == pytest.approx(focus + persistence, abs=1e-9)


@pytest.mark.parametrize("stretch", [1.0, 1.27, 1.6])
def test_focus_rules_agree_with_an_evaluation_by_hand_over_a_dense_grid(stretch):
    axis = np.linspace(0.0, pi, 160)
    delta_1, delta_2 = (x.ravel() for x in np.meshgrid(axis, axis))
    inputs = {"delta_1_rad": delta_1 / stretch, "delta_2_rad": delta_2 / stretch}
    pairs = zip(delta_1.tolist(), delta_2.tolist(), strict=True)
    by_hand = [focus_by_hand(a, b, stretch) for a, b in pairs]
    np.testing.assert_allclose(infer(PARAMETERS.focus, inputs), by_hand, rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", ["situation", "focus", "persistence", "select"])
def test_every_input_fires_a_rule(name):
    """Over a dense grid that reaches beyond the inputs' ranges."""
    base = getattr(PARAMETERS, name)
    axes = [np.linspace(v.range[0] - 0.2, 1.2 * v.range[1] + 0.1, 41) for v in base.inputs.values()]
    grid = (x.ravel() for x in np.meshgrid(*axes))
    found = strengths(base, dict(zip(base.inputs, grid, strict=True)))
    assert (found.max(axis=0) > 0.0).all()


TABLE_6_1 = {
    ("S", "S"): "safe", ("S", "M"): "safe", ("S", "L"): "real",
    ("M", "S"): "safe", ("M", "M"): "real", ("M", "L"): "real",
    ("L", "S"): "safe", ("L", "M"): "real", ("L", "L"): "real",
}  # fmt: skip


def test_table_6_1_agrees_with_an_evaluation_by_hand():
    """Rows are |theta_SD - phi|, columns |theta_SD - theta_RD|, in open space."""
    axis = np.linspace(0.0, 0.8, 120)
    rows, columns = (x.ravel() for x in np.meshgrid(axis, axis))
    inputs = {"offset_rad": rows, "spread_rad": columns, "open_m": 20.0}
    found = activations(PARAMETERS.select, strengths(PARAMETERS.select, inputs))
    for i, (row, column) in enumerate(zip(rows.tolist(), columns.tolist(), strict=True)):
        p = three_sets(row, 0.14, 0.28, 0.42, 0.59)
        q = three_sets(column, 0.10, 0.21, 0.24, 0.35)
        cells = {cell: min(p[cell[0]], q[cell[1]]) for cell in TABLE_6_1}
        by_hand = [max(cells[c] for c in cells if TABLE_6_1[c] == w) for w in ("real", "safe")]
        assert found[:, i] == pytest.approx(by_hand, abs=1e-9)


def test_equations_6_5_and_6_6_agree_with_an_evaluation_by_hand():
    rng = np.random.default_rng(6)
    for _ in range(60):
        real = rng.uniform(2.0, D_MAX, THETA.size)
        safe = real * rng.uniform(0.5, 1.0, THETA.size)
        heading, goal, previous = rng.uniform(-1.0, 1.0, 3).tolist()
        found = steer(THETA, real, safe, heading, goal, previous, 5.0, 5.0)
        for D, limit, theta in ((real, 13.0, found.theta_RD), (safe, 16.0, found.theta_SD)):
            adjusted = [
                float(D[i])
                - focus_by_hand(gap(t, heading), gap(t, goal), 1.0)
                - 5.0 * ramp(gap(t, previous), 0.21, 0.61)
                for i, t in enumerate(THETA.tolist())
            ]
            criterion = min(limit, max(adjusted) - 0.3)
            among = [t for t, a in zip(THETA.tolist(), adjusted, strict=True) if a > criterion]
            assert theta == min(among, key=lambda t: gap(t, goal))
        assert found.theta_D == (found.theta_SD if found.selected == "safe" else found.theta_RD)


# ---------------------------------------------------------------- scenes


def free_distance(theta, obstacles, radius):
    """Distance from the origin along a ray to points or segments expanded by `radius`."""
    ux, uy = cos(theta), sin(theta)
    nearest_m = D_MAX
    for x, y in obstacles:
        along, across = x * ux + y * uy, y * ux - x * uy
        if along > 0 and abs(across) < radius:
            nearest_m = min(nearest_m, max(along - (radius**2 - across**2) ** 0.5, 0.0))
    return nearest_m


def corridor_distance(theta, half_width):
    return half_width / abs(sin(theta)) if abs(sin(theta)) > 1e-9 else inf


def scan(obstacles, half_width=inf, theta=THETA):
    """D_R, D_S of points in a straight corridor along x, from its centre line."""
    return [
        np.array(
            [
                min(free_distance(t, obstacles, r), corridor_distance(t, half_width - r))
                for t in theta
            ]
        )
        for r in (REAL_M, SAFE_M)
    ]


def segment(x0, y0, x1, y1):
    """Points every 0.1 m."""
    count = int(max(abs(x1 - x0), abs(y1 - y0)) / 0.1) + 2
    return list(zip(np.linspace(x0, x1, count), np.linspace(y0, y1, count), strict=True))


def gate(x, offset, width, half_width):
    """Flanks closed out to the corridor's edges."""
    right, left = offset - width / 2, offset + width / 2
    return segment(x, -half_width, x, right) + segment(x, left, x, half_width)


@pytest.mark.parametrize("goal", [0.0, 0.3, -0.6, 1.2])
def test_free_space_leads_to_the_goal(goal):
    found = steer(THETA, *scan([]), 0.0, goal, None, 5.0, 5.0)
    assert found.theta_D == pytest.approx(goal, abs=0.5 * pi / 180 + 1e-9)
    assert found.selected == "safe"


def test_in_a_free_corridor_it_keeps_to_the_middle():
    assert steer(THETA, *scan([], 4.5), 0.0, 0.0, None, 5.0, 5.0).theta_D == 0.0


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("x", [16.0, 12.0, 9.0])
def test_a_car_over_the_line_is_passed_on_the_open_side(side, x):
    """It covers the line by 0.5 m; its near face is x ahead in a corridor of 9 m."""
    car = segment(x, 0.5 * side, x, -4.5 * side)
    found = steer(THETA, *scan(car, 4.5), 0.0, 0.0, None, 5.0, 5.0)
    clear_rad = np.arctan2(0.5 + REAL_M, x)
    assert side * found.theta_D > 0.9 * clear_rad
    assert abs(found.theta_D) < 0.5


def test_a_far_car_is_not_yet_avoided():
    found = steer(THETA, *scan(segment(20.0, 0.5, 20.0, -4.5), 4.5), 0.0, 0.0, None, 5.0, 5.0)
    assert (found.theta_D, found.criterion_safe_m) == (0.0, 16.0)


@pytest.mark.parametrize("offset", [1.5, -1.5])
@pytest.mark.parametrize("x", [17.0, 14.0, 11.0, 8.0])
def test_a_gate_off_the_line_is_steered_at(offset, x):
    """3.2 m wide: the real boundary leaves 1.3 m, the safe one 0.2 m."""
    found = steer(THETA, *scan(gate(x, offset, 3.2, 4.5), 4.5), 0.0, 0.0, None, 5.0, 5.0)
    across = x * np.tan(found.theta_D)
    assert abs(across - offset) < 1.6 - 0.76, (found.theta_RD, found.theta_SD, found.selected)


def test_before_a_wall_all_across_it_takes_the_longest_direction():
    wall = segment(8.0, -8.0, 8.0, 8.0)
    real, safe = scan(wall, 6.0)
    found = steer(THETA, real, safe, 0.0, 0.0, None, 2.0, 5.0)
    adjusted = real - found.deduction_m
    row = int(np.argmin(np.abs(THETA - found.theta_RD)))
    assert adjusted[row] > adjusted.max() - 0.3
    assert found.criterion_real_m < 13.0


def test_inside_the_safe_boundary_the_real_one_decides():
    """Close to a post every safe distance is 0: theta_SD leads nowhere, theta_RD around it."""
    real, safe = scan([(2.4, 0.2)])
    found = steer(THETA, real, np.minimum(safe, 1.0), 0.0, 0.0, None, 1.0, 5.0)
    assert found.selected == "real"
    assert found.theta_D < -np.arctan2(0.5, 2.4)


def test_low_speed_widens_the_search():
    travelling = steer(THETA, *scan([]), 0.0, 0.0, None, 5.0, 5.0)
    exploring = steer(THETA, *scan([]), 0.0, 0.0, None, 0.5, 5.0)
    assert (exploring.deduction_m <= travelling.deduction_m).all()
    assert exploring.breakpoints_rad == pytest.approx([1.6 * x for x in travelling.breakpoints_rad])
    assert exploring.candidates_safe.sum() > travelling.candidates_safe.sum()


def test_a_dead_end_is_left_sideways_when_slow():
    """The way ahead ends after 12 m; far aside there are 26 m."""
    real = np.where(np.abs(THETA - 1.2) < 0.1, 26.0, 12.0)
    fast = steer(THETA, real, real, 0.0, 0.0, None, 5.0, 5.0).theta_D
    slow = steer(THETA, real, real, 0.0, 0.0, None, 0.5, 5.0).theta_D
    assert abs(fast) < 0.2
    assert slow > 1.0


def test_persistence_keeps_the_side_that_was_chosen():
    """Two openings, the right one a little nearer to the goal direction."""
    right, left = np.abs(THETA + 0.32) < 0.03, np.abs(THETA - 0.34) < 0.03
    distance = np.where(right | left, 17.0, 9.0)
    fresh = steer(THETA, distance, distance, 0.0, 0.0, None, 5.0, 5.0).theta_D
    kept = steer(THETA, distance, distance, 0.0, 0.0, 0.34, 5.0, 5.0).theta_D
    assert fresh < 0.0 < kept


# ---------------------------------------------------------------- properties


def test_ties_go_to_the_previous_decision_then_left():
    theta = np.array([-0.2, -0.1, 0.1, 0.2])
    among = np.array([True, True, True, True])
    assert nearest(theta, among, 0.0, None) == 2
    assert nearest(theta, among, 0.0, -0.3) == 1
    assert nearest(theta, among, 0.0, 0.3) == 2
    assert nearest(theta + pi, among, -pi, None) == 2


def test_angle_between_wraps_in_any_frame():
    assert angle_between(3.0, -3.0) == pytest.approx(2 * pi - 6.0)
    assert angle_between(np.array([7.0]), 7.0 - 4 * pi) == pytest.approx([0.0])


@pytest.mark.parametrize("frame", [2.0, 3.1, -3.0, 9.0])
def test_the_frame_does_not_matter(frame):
    real, safe = scan(gate(12.0, 1.5, 3.2, 4.5), 4.5)
    here = steer(THETA, real, safe, 0.05, 0.1, 0.2, 4.0, 5.0)
    there = steer(THETA + frame, real, safe, 0.05 + frame, 0.1 + frame, 0.2 + frame, 4.0, 5.0)
    assert there.theta_D - frame == pytest.approx(here.theta_D, abs=1e-9)
    assert there.selected == here.selected


angles = st.floats(-1.5, 1.5)
distances = st.lists(st.tuples(st.floats(0, 35), st.floats(0, 1)), min_size=1, max_size=61)


@settings(max_examples=150, deadline=None)
@given(distances, angles, angles, st.none() | angles, st.floats(0, 12), st.floats(0, 12))
def test_any_scan_gives_one_of_its_directions_and_a_mirrored_one_its_mirror(
    pairs, heading, goal, previous, speed, V0
):
    real = np.array([r for r, _ in pairs])
    safe = np.array([r * s for r, s in pairs])
    theta = np.linspace(-1.2, 1.1, len(pairs))
    found = steer(theta, real, safe, heading, goal, previous, speed, V0)
    back = None if previous is None else -previous
    mirror = steer(-theta[::-1], real[::-1], safe[::-1], -heading, -goal, back, speed, V0)
    assert found.theta_D in theta
    assert np.isfinite(found.deduction_m).all()
    assert found.candidates_real.any()
    assert found.candidates_safe.any()
    assert max(found.select_rules.values()) > 0.0
    assert mirror.deduction_m.tolist() == found.deduction_m[::-1].tolist()
    for a, b in ((found.theta_RD, mirror.theta_RD), (found.theta_SD, mirror.theta_SD)):
        tie = gap(a, goal) == pytest.approx(gap(-b, goal), abs=2e-9)
        assert b == -a or (tie and a > goal and b > -goal)


def test_decision_and_parameters_can_be_pickled():
    real, safe = scan([(9.0, 0.1)])
    found = steer(THETA, real, safe, 0.0, 0.0, None, 5.0, 5.0)
    again = pickle.loads(pickle.dumps((found, PARAMETERS)))
    assert again[0].theta_D == found.theta_D
    assert again[1] == PARAMETERS


@pytest.mark.parametrize(
    ("right", "wrong", "message"),
    [
        ("epsilon_m = 0.3", "epsilon_m = 0.0", "epsilon_m: 0.0 must be positive"),
        ("delta_3_rad", "delta_rad", "persistence.inputs: are delta_rad; expected delta_3_rad"),
        ('"safe"', '"secure"', "'secure' is an unknown term; known are real, safe"),
        ("range = [0.5, 3.0]", "range = [-0.5, 3.0]", "situation.output.range: .* positive"),
    ],
)
def test_refuses(right, wrong, message):
    assert right in TEXT
    with pytest.raises(ParameterError, match=message):
        from_toml(SteeringParameters, TEXT.replace(right, wrong), "steering.toml")
