import numpy as np
import pytest

from nav.messages import Gear
from twin.clock import STEP_S
from twin.linkage import Gearbox, GearboxParameters


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
    once = {"shift_sigma": 0.0, "try_again": 0.0}
    _, exact_s = walk(gearbox(Gear.HIGH, shift_s_per_position=1.5, **once), Gear.REVERSE)
    assert exact_s == pytest.approx(4.5, abs=5 * STEP_S)
    _, longest_s = walk(gearbox(Gear.HIGH, shift_s_per_position=500.0), Gear.REVERSE)
    assert longest_s == pytest.approx(60.0, abs=5 * STEP_S)
    _, shortest_s = walk(gearbox(Gear.HIGH, shift_s_per_position=0.01, **once), Gear.REVERSE)
    assert shortest_s == pytest.approx(2.1, abs=5 * STEP_S)


def test_median_of_a_try():
    box = gearbox(Gear.LOW, try_again=0.0)
    times = [walk(box, target)[1] for _ in range(100) for target in (Gear.HIGH, Gear.LOW)]
    assert np.median(times) == pytest.approx(2.0, rel=0.1)
    assert np.std(np.log(times)) == pytest.approx(0.5, rel=0.15)


def test_some_shifts_are_tried_again_and_none_takes_longer_than_a_minute():
    box, again = gearbox(Gear.HIGH, try_again=0.3), 0
    for target in 50 * (Gear.REVERSE, Gear.HIGH):
        at, steps = [box.position], 0
        while (box.gear, box.shifting) != (target, False):
            box.step(target, 0.0, STEP_S)
            at, steps = [*at, box.position], steps + 1
        way = np.diff(at) * (1.0 if target is Gear.HIGH else -1.0)
        again += int(np.count_nonzero(way < -0.5))
        assert 2.0 <= steps * STEP_S <= 60.1
    assert 60 < again < 200  # of 300 positions 0.3, and of those 0.3 once more


def test_the_potentiometer_walks_with_the_linkage():
    box, seen = gearbox(Gear.NEUTRAL, try_again=0.0), []
    while box.gear != Gear.LOW:
        box.step(Gear.LOW, 0.0, STEP_S)
        seen.append(box.position)
    assert seen[0] < 1.1
    assert seen[-1] == 2.0
    assert np.all(np.diff(seen) > 0.0)


def test_no_shift_while_rolling():
    box = gearbox(Gear.HIGH)
    for _ in range(3000):
        box.step(Gear.LOW, 1.0, STEP_S)
    assert (box.gear, box.shifting) == (Gear.HIGH, False)
