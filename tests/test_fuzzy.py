"""The fuzzy engine: sets, inference, and every refusal."""

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nav.errors import NavError
from nav.fuzzy.inference import activations, average, explain, infer, pick, strengths
from nav.fuzzy.membership import Term, Variable, memberships
from nav.fuzzy.rule_base import RuleBase
from nav.parameters.loader import ParameterError, from_toml

TOML = """
[inputs.distance_m]
range = [0.0, 10.0]
[inputs.distance_m.terms]
near = { shape = "left_shoulder", points = [2.0, 4.0] }
middle = { shape = "triangle", points = [2.0, 4.0, 8.0] }
far = { shape = "right_shoulder", points = [4.0, 8.0] }
[inputs.turn_rad]
range = [-1.0, 1.0]
[inputs.turn_rad.terms]
sharp = { shape = "left_shoulder", points = [-0.9, -0.5] }
left = { shape = "trapezoid", points = [-1.0, -0.9, 0.5, 1.0] }
right = { shape = "right_shoulder", points = [-0.5, 0.5] }
[output]
name = "speed_mps"
range = [0.0, 9.0]
terms = { stop = 0.0, slow = 2.0, fast = 9.0 }
[[rules]]
when = [{ distance_m = "near" }]
then = "stop"
[[rules]]
when = [{ distance_m = "far", turn_rad = "right" }]
then = "fast"
[[rules]]
when = [
  { distance_m = "middle" },
  { turn_rad = "sharp" }, { distance_m = "far", turn_rad = "left" },
]
then = "slow"
"""


def base() -> RuleBase:
    return from_toml(RuleBase, TOML, "test.toml")


def at(name: str, value: float) -> list[float]:
    return memberships(base().inputs[name].flanks, np.array([value]))[:, 0].tolist()


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (0, [1, 0, 0]), (2, [1, 0, 0]), (3, [0.5, 0.5, 0]), (4, [0, 1, 0]),
        (7, [0, 0.25, 0.75]), (8, [0, 0, 1]), (10, [0, 0, 1]),
    ],
)  # fmt: skip
def test_shoulders_and_triangle(value, expected):
    assert at("distance_m", value) == expected


def test_trapezoid_is_full_between_its_inner_points():
    found = [at("turn_rad", x)[1] for x in (-1.0, -0.95, -0.9, 0.0, 0.5, 0.75, 1.0)]
    assert found == pytest.approx([0, 0.5, 1, 1, 1, 0.5, 0])


def test_rules_fire_by_max_of_min_and_are_averaged():
    strength = strengths(base(), {"distance_m": 7.0, "turn_rad": 0.1})
    assert strength[:, 0] == pytest.approx([0.0, 0.6, 0.75])
    assert average(base(), strength)[0] == pytest.approx((9.0 * 0.6 + 2.0 * 0.75) / 1.35)
    assert activations(base(), strength)[:, 0] == pytest.approx([0.0, 0.75, 0.6])


def test_rules_are_picked_and_a_tie_goes_to_the_first_term():
    assert pick(base(), strengths(base(), {"distance_m": 7.0, "turn_rad": 0.1})) == "slow"
    assert pick(base(), strengths(base(), {"distance_m": 9.0, "turn_rad": 0.5})) == "slow"
    assert pick(base(), strengths(base(), {"distance_m": 9.0, "turn_rad": 0.9})) == "fast"


def test_explain_says_rules_in_words_with_their_strengths():
    found = explain(base(), strengths(base(), {"distance_m": 3.0, "turn_rad": 0.0}))
    assert list(found.items())[:2] == [
        ("distance_m is near -> stop", 0.5),
        ("distance_m is far and turn_rad is right -> fast", 0.0),
    ]
    assert " or turn_rad is sharp or " in list(found)[2]


@given(
    st.lists(st.tuples(st.floats(-50, 50), st.floats(-5, 5)), min_size=1, max_size=30),
)
def test_all_at_once_equals_one_by_one_and_stays_within_the_output_range(pairs):
    distance, turn = np.array(pairs).T
    together = infer(base(), {"distance_m": distance, "turn_rad": turn})
    alone = [infer(base(), {"distance_m": d, "turn_rad": t})[0] for d, t in pairs]
    assert together.tolist() == alone
    assert ((together >= 0.0) & (together <= 9.0)).all()


def test_inputs_saturate_beyond_their_range():
    inside = infer(base(), {"distance_m": 10.0, "turn_rad": 1.0})
    assert infer(base(), {"distance_m": np.inf, "turn_rad": 7.0}) == inside


def test_one_number_goes_with_many():
    found = infer(base(), {"distance_m": np.linspace(0, 10, 5), "turn_rad": 0.3})
    assert found.shape == (5,)


def test_a_used_rule_base_can_be_pickled():
    one = base()
    before = infer(one, {"distance_m": 6.0, "turn_rad": 0.2})
    again = pickle.loads(pickle.dumps(one))
    assert again == one
    assert infer(again, {"distance_m": 6.0, "turn_rad": 0.2}) == before


REFUSALS = {
    "unordered": ("[2.0, 4.0, 8.0]", "[2.0, 8.0, 4.0]", r"terms\.middle: .*increase strictly"),
    "vertical": ("[2.0, 4.0] }", "[2.0, 2.0] }", r"terms\.near: .*increase strictly"),
    "not finite": ("[2.0, 4.0] }", "[2.0, nan] }", r"terms\.near: .*must be finite"),
    "shape": ('"triangle"', '"bell"', r"terms\.middle: shape: 'bell' .*known are triangle"),
    "count": ("[2.0, 4.0, 8.0]", "[2.0, 8.0]", r"terms\.middle: .*triangle has 3 points, not 2"),
    "range": ("[0.0, 10.0]", "[10.0, 0.0]", r"inputs\.distance_m: range: .*increase"),
    "outside": ("[0.0, 10.0]", "[0.0, 7.0]", r"inputs\.distance_m: terms\.middle: .*outside"),
    "hole": ("[2.0, 4.0, 8.0]", "[3.0, 3.5, 3.9]", r"distance_m: terms: none of .* at 4; close"),
    "output": ("slow = 2.0", "slow = 20.0", r"output: terms\.slow: 20 lies outside"),
    "output range": ("[0.0, 9.0]", "[9.0, 0.0]", r"output: range: .*increase"),
    "input": ('{ turn_rad = "sharp" }', '{ tum_rad = "sharp" }',
              r"rules\[2\]\.when: 'tum_rad' is an unknown input; known are distance_m, turn_rad"),
    "term": ('{ turn_rad = "sharp" }', '{ turn_rad = "sharf" }',
             r"rules\[2\]\.when\.turn_rad: 'sharf' is an unknown term; known are sharp, left"),
    "then": ('then = "slow"', 'then = "sloow"',
             r"rules\[2\]\.then: 'sloow' is an unknown term; known are stop, slow, fast"),
    "unused": ('{ turn_rad = "sharp" }, ', "", r"inputs\.turn_rad\.terms\.sharp: no rule uses it"),
    "unconcluded": ('then = "slow"', 'then = "stop"', r"output\.terms\.slow: no rule concludes"),
    "silence": ('{ distance_m = "near" }', '{ distance_m = "near", turn_rad = "right" }',
                r"rules: none fires at distance_m = 0 \(near\), turn_rad = -0.5 \(left\); add"),
    "empty": ('when = [{ distance_m = "near" }]', "when = []", r"rules\[0\]: when: needs"),
    "unknown key": ('name = "speed_mps"', 'nmae = "speed_mps"', r"output\.nmae: unknown key"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSALS)
def test_refuses(name):
    right, wrong, message = REFUSALS[name]
    assert right in TOML
    with pytest.raises(ParameterError, match=r"test\.toml.*" + message):
        from_toml(RuleBase, TOML.replace(right, wrong, 1), "test.toml")


def test_refuses_a_rule_base_without_rules():
    with pytest.raises(NavError, match="at least one input and one rule"):
        RuleBase(base().inputs, base().output, ())


def test_a_hole_of_one_point_is_found():
    with pytest.raises(NavError, match="none of low, high has a member at 5"):
        Variable(
            (0.0, 10.0),
            {
                "low": Term("left_shoulder", (1.0, 5.0)),
                "high": Term("right_shoulder", (5.0, 9.0)),
            },
        )
