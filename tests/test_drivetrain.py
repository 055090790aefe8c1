import numpy as np
import pytest

from nav.messages import Gear
from twin.clock import STEP_S
from twin.drivetrain import (
    DrivetrainParameters,
    Engine,
    Gearbox,
    GearboxParameters,
    friction_torques,
    tractive_force,
    wheel_torques,
)

P = DrivetrainParameters()


def gearbox(gear, **parameters):
    return Gearbox(GearboxParameters(**parameters), np.random.default_rng(0), gear)


def walk(box, target, limit_s=70.0):
    """Positions on the way and seconds until the linkage rests in `target`."""
    seen, steps = [box.gear], 0
    while (box.gear != target or box.shifting) and steps * STEP_S < limit_s:
        box.step(target, 0.0, STEP_S)
        steps += 1
        if box.gear != seen[-1]:
            seen.append(box.gear)
    return seen, steps * STEP_S


def test_linkage_walks_through_every_position():
    seen, _ = walk(gearbox(Gear.HIGH), Gear.REVERSE)
    assert seen == [Gear.HIGH, Gear.LOW, Gear.NEUTRAL, Gear.REVERSE]


def test_shift_takes_the_time_of_its_distribution():
    _, exact_s = walk(gearbox(Gear.HIGH, shift_s_per_position=1.5, shift_sigma=0.0), Gear.REVERSE)
    assert exact_s == pytest.approx(4.5, abs=5 * STEP_S)
    _, longest_s = walk(gearbox(Gear.HIGH, shift_s_per_position=500.0), Gear.REVERSE)
    assert longest_s == pytest.approx(60.0, abs=5 * STEP_S)


def test_median_of_a_position():
    box = gearbox(Gear.LOW)
    times = [walk(box, target)[1] for _ in range(100) for target in (Gear.HIGH, Gear.LOW)]
    assert np.median(times) == pytest.approx(2.0, rel=0.1)
    assert np.std(np.log(times)) == pytest.approx(0.4, rel=0.15)


def test_no_shift_while_rolling():
    box = gearbox(Gear.HIGH)
    for _ in range(3000):
        box.step(Gear.LOW, 1.0, STEP_S)
    assert (box.gear, box.shifting) == (Gear.HIGH, False)


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
