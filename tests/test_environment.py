"""The truck as an environment: the conformance tests of dm_env, and what is promised beyond."""

import pickle
import re
from pathlib import Path

import dm_env
import numpy as np
import pytest
from absl.testing import absltest
from dm_env import test_utils

from nav.messages import ActuatorTargets, Gear
from nav.navigator import IonNavigator
from nav.route import rddf
from scenarios.environment import CONTACT, ActionError, Environment, load
from scenarios.episode import Episode
from scenarios.observations import NEVER_S
from scenarios.parameter_files import parameters_of
from scenarios.random_field.course import build as field
from scenarios.trial import builder

STAND = np.array([0.0, 0.0, 1.0, 3.0])
AHEAD = np.array([0.0, 0.4, 0.0, 3.0])
DOC = Path(__file__).parents[1] / "docs" / "environment.md"


class TestConformance(test_utils.EnvironmentTestMixin, absltest.TestCase):
    """dm_env's own; full throttle in a field of circles ends an episode soon."""

    def make_object_under_test(self):
        return Environment(field)

    def make_action_sequence(self):
        for _ in range(1200):
            yield np.array([0.1, 1.0, 0.0, 3.0])


class TestConformanceOfTheTruck(test_utils.EnvironmentTestMixin, absltest.TestCase):
    def make_object_under_test(self):
        return load("dead_end")


def steps(environment, action, count):
    return [environment.step(action) for _ in range(count)]


def test_same_seed_and_actions_give_the_same_bits():
    one, other = (steps(load("dead_end", 3), AHEAD, 100)[-1] for _ in range(2))
    assert one.reward == other.reward
    for name, seen in one.observation.items():
        np.testing.assert_array_equal(seen, other.observation[name])


def test_each_reset_draws_the_next_seed():
    environment = load("dead_end", 3)
    environment.reset()
    steps(environment, AHEAD, 5)
    environment.reset()
    assert environment.seed == 4
    assert environment.time_s == 0.0


def test_a_device_has_its_own_rate_and_is_unknown_at_first():
    environment = load("dead_end")
    first = environment.reset().observation
    assert first["gps_age_s"] == NEVER_S
    assert not first["lidar_bumper"].any()
    ages = [float(s.observation["compass_age_s"]) for s in steps(environment, STAND, 100)[50:]]
    assert np.ptp(ages) == pytest.approx(0.08, abs=0.03)  # 10 Hz
    last = environment.step(STAND).observation
    assert last["imu"][5] == pytest.approx(9.8, abs=0.5)
    assert last["lidar_bumper"].max() == 81.92


def test_the_navigator_drives_it_as_in_an_episode():
    """The project's own navigator as the agent: the same way to the bit."""
    course = builder("scenarios.dead_end")(0)
    episode, environment = Episode(course, 0), load("dead_end", 0)
    environment.reset()
    for _ in range(300):
        episode.tick()
    navigator = IonNavigator(parameters_of("ion"), rddf.parse(course.route_text, course.route_name))
    targets, heard = ActuatorTargets(0, 0.0, 0.0, 1.0, Gear.HIGH), []
    take = environment._heard.take
    environment._heard.take = lambda messages: (heard.append(messages), take(messages))
    for _ in range(300):
        environment.step(
            np.array([targets.steering_rad, targets.throttle, targets.brake, targets.gear])
        )
        targets = navigator.step(environment.simulator.time_ns, heard[-1]).targets
    truth = environment.simulator.truth()
    np.testing.assert_array_equal(truth.position_m, episode.truth.position_m)
    assert truth.position_m[0] > 3.0


def test_reward_is_way_along_the_route_and_contact_ends_it():
    environment = load("real_wall")
    environment.reset()
    gained, step = 0.0, None
    while step is None or not step.last():
        step = environment.step(np.array([0.0, 0.6, 0.0, 3.0]))
        gained += step.reward
    assert environment.judge.outcome == "contact"
    assert step.discount == 0.0
    assert gained == pytest.approx(environment._here.arc_m + CONTACT, abs=3.0)


def test_time_that_is_up_is_no_end_of_the_world():
    environment = load("dead_end")
    environment.reset()
    environment.judge.stop("timeout")
    step = environment.step(STAND)
    assert step.last()
    assert step.discount == 1.0
    assert environment.step(STAND).first()


@pytest.mark.parametrize("action", [
    np.zeros(3), np.array([0.0, np.nan, 0.0, 3.0]), np.array([0.0, 1.5, 0.0, 3.0]),
    np.array([-0.6, 0.0, 0.0, 3.0]),
])  # fmt: skip
def test_what_no_vehicle_can_take_is_refused(action):
    environment = load("dead_end")
    environment.reset()
    with pytest.raises(ActionError, match="expected"):
        environment.step(action)
    assert environment.time_s == 0.0


def test_an_unknown_scenario_or_option_is_refused():
    with pytest.raises(ValueError, match="there are: dead_end"):
        load("deadend")
    with pytest.raises(ValueError, match="takes no such option"):
        load("dead_end", density=3)


def test_a_fault_is_observed():
    environment = load("dead_end", faults=("gps silent 0s",))
    assert steps(environment, STAND, 100)[-1].observation["gps_age_s"] == NEVER_S


def test_picklable_in_the_middle():
    environment = Environment(field)
    steps(environment, AHEAD, 20)
    other = pickle.loads(pickle.dumps(environment))
    one, two = (steps(e, AHEAD, 20)[-1] for e in (environment, other))
    np.testing.assert_array_equal(one.observation["lidar_field"], two.observation["lidar_field"])


def test_physics_looks_and_does_not_touch():
    pytest.importorskip("dm_control")
    plain, watched = load("dead_end"), load("dead_end")
    for environment in (plain, watched):
        environment.reset()
    for _ in range(50):
        assert watched.physics.data.time == watched.simulator.plant.data.time
        for environment in (plain, watched):
            environment.step(AHEAD)
    assert watched.physics.named.data.xpos["ranger"][0] == plain.simulator.truth().position_m[0]
    with pytest.raises(RuntimeError, match="step the environment"):
        watched.physics.step()


def test_a_point_has_no_physics():
    with pytest.raises(TypeError, match="a point"):
        _ = Environment(field).physics


def test_the_example_of_the_documentation_runs(capsys):
    example = re.search(r"```python\n(.*?)```", DOC.read_text(), re.S)
    exec(compile(example[1], str(DOC), "exec"), {})
    assert re.search(r"\d+ steps, reward -?\d", capsys.readouterr().out)


def test_the_specs_name_what_stands_in_them():
    spec = load("dead_end").observation_spec()
    assert "specific force" in spec["imu"].name
    assert isinstance(load("dead_end").discount_spec(), dm_env.specs.BoundedArray)
