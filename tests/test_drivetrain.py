import numpy as np
import pytest

from nav.messages import Gear
from twin.clock import STEP_S
from twin.drivetrain import (
    DrivetrainParameters,
    Engine,
    friction_torques,
    tractive_force,
    wheel_torques,
)

P = DrivetrainParameters()


def test_top_speed_stands_where_the_limiter_is():
    assert tractive_force(P, 1.0, Gear.HIGH, 15.0) > 0.0
    assert tractive_force(P, 1.0, Gear.HIGH, P.high.top_mps) == 0.0
    assert tractive_force(P, 1.0, Gear.LOW, 9.9) < tractive_force(P, 1.0, Gear.HIGH, 9.9)


@pytest.mark.parametrize(("gear", "sign"), [(Gear.REVERSE, -1), (Gear.LOW, 1), (Gear.HIGH, 1)])
def test_direction_of_drive_and_of_engine_braking(gear, sign):
    assert sign * tractive_force(P, 1.0, gear, 0.0) > 2000.0
    assert sign * tractive_force(P, 0.0, gear, sign * 5.0) < -200.0
    assert tractive_force(P, 0.0, gear, 0.0) == 0.0


def test_neutral_gives_nothing():
    assert tractive_force(P, 1.0, Gear.NEUTRAL, 3.0) == 0.0


def test_power_at_the_wheels_is_bounded():
    for speed in np.linspace(1.0, 18.0, 35):
        assert tractive_force(P, 1.0, Gear.HIGH, speed) * speed <= P.power_w + 1e-9


def test_engine_lags():
    engine = Engine(P, STEP_S)
    forces = [engine.force(1.0, Gear.HIGH, 0.0) for _ in range(round(P.engine_lag_s / STEP_S))]
    assert forces[-1] == pytest.approx((1 - np.exp(-1)) * P.high.force_n, rel=1e-6)


def test_torques_add_up_and_slow_a_spinning_wheel():
    even = wheel_torques(P, 600.0, [10.0] * 6)
    spinning = wheel_torques(P, 600.0, [20.0] + [10.0] * 5)
    assert sum(even) == pytest.approx(600.0 * 0.3175)
    assert sum(spinning) == pytest.approx(600.0 * 0.3175)
    assert spinning[0] < even[0] < spinning[1]


def test_four_wheels_are_braked():
    assert friction_torques(P, 0.0) == [P.rolling_n_m] * 6
    assert sum(t > P.rolling_n_m for t in friction_torques(P, 1.0)) == 4
