"""The speed fuzzy controller: equation (6.8) against an evaluation by hand."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nav.fuzzy.inference import infer
from nav.parameters.fuzzy import SpeedParameters
from nav.parameters.loader import ParameterError, from_toml
from nav.planning.speed import set_point

TEXT = (Path(__file__).parents[1] / "nav/parameters/speed.toml").read_text()
PARAMETERS = from_toml(SpeedParameters, TEXT, "speed.toml")
DECELERATION_MPS2 = 3.0
DELAY_S = 0.5


def ramp(x, low, high):
    return min(max((x - low) / (high - low), 0.0), 1.0)


def distance_sets(x):
    danger, small, large = 1 - ramp(x, 4, 6), 1 - ramp(x, 7, 13), ramp(x, 13, 29)
    return {
        "DA": danger,
        "S": min(1 - danger, small),
        "M": min(1 - small, 1 - large),
        "L": large,
    }


def anti_collision_by_hand(D1, D):
    a, b = distance_sets(D1), distance_sets(D)
    strength = {
        "STOP": max(a["DA"], b["DA"]),
        "S": min(a["S"], max(b["S"], b["M"], b["L"])),
        "MS": max(min(a["M"], b["S"]), min(a["L"], b["S"])),
        "M": min(a["M"], b["M"]),
        "ML": max(min(a["L"], b["M"]), min(a["M"], b["L"])),
        "L": min(a["L"], b["L"]),
    }
    speed = {"STOP": 0.0, "S": 2.0, "MS": 2.5, "M": 5.5, "ML": 6.5, "L": 11.2}
    return sum(strength[t] * speed[t] for t in speed) / sum(strength.values())


def safe_steering_by_hand(turn):
    small, large = 1 - ramp(turn, 0.14, 0.35), ramp(turn, 0.61, 1.05)
    medium = min(1 - small, 1 - large)
    return (small * 11.2 + medium * 5.0 + large * 2.0) / (small + medium + large)


def grid(low, high, count):
    x = np.linspace(low, high, count)
    first, second = np.meshgrid(x, x)
    return first.ravel(), second.ravel()


def test_anti_collision_rules_agree_with_an_evaluation_by_hand():
    D1, D = grid(0.0, 42.0, 150)
    found = infer(PARAMETERS.anti_collision, {"D1_m": D1, "D_m": D})
    by_hand = [anti_collision_by_hand(a, b) for a, b in zip(D1.tolist(), D.tolist(), strict=True)]
    np.testing.assert_allclose(found, by_hand, rtol=0, atol=1e-9)


def test_safe_steering_rules_agree_with_an_evaluation_by_hand():
    turn = np.linspace(0.0, 3.15, 3000)
    found = infer(PARAMETERS.safe_steering, {"delta_theta_rad": turn})
    np.testing.assert_allclose(
        found, [safe_steering_by_hand(t) for t in turn.tolist()], rtol=0, atol=1e-9
    )


@pytest.mark.parametrize(("selected", "narrow"), [("safe", np.inf), ("real", 3.0), ("", np.inf)])
def test_the_set_point_is_the_least_of_its_terms(selected, narrow):
    values = ((3.0, 9.0, 20.0, 35.0), (3.0, 9.0, 20.0, 35.0), (-0.8, 0.0, 0.3), (1.0, 5.0, 12.0))
    for D1, D, turn, V0 in product(*values):
        decision = set_point(D1, D, turn, V0, selected, PARAMETERS)
        expected = min(V0, anti_collision_by_hand(D1, D), safe_steering_by_hand(abs(turn)), narrow)
        assert decision.speed_mps == pytest.approx(expected, abs=1e-9)
        assert decision.terms_mps[decision.limited_by] == decision.speed_mps


def test_the_vehicle_never_overdrives_its_distances():
    """Stopping distance fits into what the nearer of both distances leaves before D_safe."""
    D1, D = grid(0.0, 42.0, 337)
    speed = infer(PARAMETERS.anti_collision, {"D1_m": D1, "D_m": D})
    stopping = speed**2 / (2.0 * DECELERATION_MPS2) + DELAY_S * speed
    left = np.minimum(D1, D) - PARAMETERS.safe_distance_m
    assert (stopping <= np.maximum(left, 0.0) + 1e-12).all()


def test_it_stops_in_danger_and_drives_freely_in_the_open():
    assert set_point(2.0, 40.0, 0.0, 10.0, "safe", PARAMETERS).speed_mps == 0.0
    assert set_point(40.0, 2.0, 0.0, 10.0, "safe", PARAMETERS).speed_mps == 0.0
    free = set_point(30.0, 30.0, 0.0, 11.0, "safe", PARAMETERS)
    assert (free.speed_mps, free.limited_by) == (11.0, "V0")


def test_more_distance_never_means_less_speed_along_the_diagonal():
    d = np.linspace(0.0, 40.0, 800)
    speed = infer(PARAMETERS.anti_collision, {"D1_m": d, "D_m": d})
    assert (np.diff(speed) >= -1e-12).all()


def test_every_rule_is_told_with_its_strength():
    decision = set_point(34.0, 6.5, 0.0, 9.0, "safe", PARAMETERS)
    assert decision.anti_collision_rules["D1_m is L and D_m is S -> MS"] == 1.0
    assert sum(decision.anti_collision_rules.values()) == 1.0
    assert decision.safe_steering_rules["delta_theta_rad is S -> L"] == 1.0


def test_completed_rules_say_that_they_are():
    completed = [r for r in PARAMETERS.anti_collision.rules if r.source.startswith("completed")]
    assert [rule.label for rule in completed] == ["D1_m is L and D_m is S -> MS"]


@given(
    st.floats(0, 1e6), st.floats(0, 1e6), st.floats(-7, 7), st.floats(-1, 50),
    st.sampled_from(["", "safe", "real"]),
)  # fmt: skip
def test_any_input_fires_a_rule_and_stays_within_limits(D1, D, turn, V0, selected):
    decision = set_point(D1, D, turn, V0, selected, PARAMETERS)
    assert 0.0 <= decision.speed_mps <= max(V0, 0.0)
    assert max(decision.anti_collision_rules.values()) > 0.0
    assert max(decision.safe_steering_rules.values()) > 0.0
    assert decision == set_point(D1, D, -turn, V0, selected, PARAMETERS)


@pytest.mark.parametrize(
    ("right", "wrong", "message"),
    [
        ("safe_distance_m = 1.5", "safe_distance_m = 4.5", "safe_distance_m: 4.5 must lie where"),
        ("STOP = 0.0", "STOP = 1.0", "STOP: must be there and be 0"),
        ("narrow_mps = 3.0", "narrow_mps = -3.0", "narrow_mps: -3 must not be negative"),
        ("delta_theta_rad", "turn_rad", "safe_steering.inputs: are turn_rad; expected delta_theta"),
    ],
)
def test_refuses(right, wrong, message):
    assert right in TEXT
    with pytest.raises(ParameterError, match=message):
        from_toml(SpeedParameters, TEXT.replace(right, wrong), "speed.toml")
