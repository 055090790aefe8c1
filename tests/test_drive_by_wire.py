import numpy as np
import pytest

from nav.messages import ActuatorTargets, Gear
from twin import clock
from twin.drive_by_wire import BRAKE, STEERING, DriveByWire, DriveByWireParameters
from twin.faults import Faults, parse
from twin.linkage import Gearbox, GearboxParameters
from twin.servo import Delay

P = DriveByWireParameters()
BAND = BRAKE.dead_band + BRAKE.count
"""So near to its target a pedal's servo may stay."""


def shim(*faults):
    gearbox = Gearbox(GearboxParameters(), np.random.default_rng(0), Gear.HIGH)
    known = ("steering", "throttle", "brake", "gear")
    return DriveByWire(P, gearbox, clock.STEP_S, Faults([parse(line, known) for line in faults]))


def run(unit, first, seconds, **targets):
    """Targets every 20 ms for `seconds` from step `first`; what was applied at each step."""
    wanted = {"steering_rad": 0.0, "throttle": 0.0, "brake": 0.0, "gear": Gear.HIGH} | targets
    applied = []
    for k in range(first, first + round(seconds * clock.STEPS_PER_SECOND)):
        if k % 6 == 0:
            unit.apply(clock.time_ns(k), ActuatorTargets(clock.time_ns(k), **wanted))
        applied.append(unit.step(clock.time_ns(k), 0.0))
    return applied


def silence(unit, first, seconds):
    return [
        unit.step(clock.time_ns(k), 0.0)
        for k in range(first, first + round(seconds * clock.STEPS_PER_SECOND))
    ]


def test_delay_gives_the_newest_value_that_is_old_enough():
    delay = Delay(0.1, 0.0)
    delay.put(0, 1.0)
    delay.put(20_000_000, 2.0)
    assert [delay.get(t * 1_000_000) for t in (99, 100, 119, 120, 500)] == [0, 1, 1, 2, 2]


def test_brake_is_on_until_targets_arrive():
    assert silence(shim(), 0, 1.0)[-1].brake == 1.0


def test_steering_waits_for_its_delay_and_keeps_its_rate():
    angles = np.array([a.steering_rad for a in run(shim(), 0, 3.0, steering_rad=0.5)])
    assert np.flatnonzero(angles)[0] == round(STEERING.delay_s * clock.STEPS_PER_SECOND)
    assert np.diff(angles).max() == pytest.approx(STEERING.rate_per_s * clock.STEP_S)
    assert angles[-1] == pytest.approx(0.5, abs=STEERING.count + STEERING.dead_band)


def test_lock_to_lock_takes_four_seconds():
    unit = shim()
    run(unit, 0, 3.0, steering_rad=-STEERING.high)
    angles = np.array([a.steering_rad for a in run(unit, 900, 5.0, steering_rad=1.0)])
    moving = np.flatnonzero(np.diff(angles)).size * clock.STEP_S
    assert moving == pytest.approx(4.0, abs=0.05)


def test_targets_are_saturated():
    last = run(shim(), 0, 4.0, steering_rad=3.0, throttle=2.0, brake=-1.0)[-1]
    assert last.steering_rad == STEERING.high
    assert (last.throttle, last.brake) == pytest.approx((1.0, 0.0), abs=BAND)


def test_stops_when_targets_stop():
    unit = shim()
    driving = run(unit, 0, 2.0, throttle=0.6, steering_rad=0.2)[-1]
    assert driving.throttle == pytest.approx(0.6, abs=BAND)
    quiet = silence(unit, 600, 1.5)
    assert quiet[round(0.45 * 300)] == driving
    assert quiet[round(1.0 * 300)].throttle <= BAND
    assert quiet[-1].brake >= 1.0 - BAND
    assert quiet[-1].steering_rad == driving.steering_rad
    assert run(unit, 1050, 1.0, throttle=0.3)[-1][1:3] == pytest.approx((0.3, 0.0), abs=BAND)


def test_what_is_no_number_counts_as_not_arrived():
    last = run(shim(), 0, 1.0, steering_rad=float("nan"), throttle=0.5)[-1]
    assert (last.throttle, last.brake) == pytest.approx((0.0, 1.0), abs=BAND)


def test_gear_is_reported_while_the_linkage_walks():
    applied = run(shim(), 0, 15.0, gear=Gear.NEUTRAL, brake=1.0)
    assert [applied[0].gear, applied[-1].gear] == [Gear.HIGH, Gear.NEUTRAL]
    assert applied[10].shifting
    assert not applied[-1].shifting
    assert Gear.LOW in {a.gear for a in applied}


def test_a_command_has_counts_and_small_ones_move_nothing():
    near = run(shim(), 0, 1.0, steering_rad=0.9 * STEERING.dead_band)
    assert {a.steering_rad for a in near} == {0.0}
    angles = {round(run(shim(), 0, 2.0, steering_rad=x)[-1].steering_rad, 9) for x in (0.2, 0.2004)}
    assert len(angles) == 1


@pytest.mark.parametrize(("fault", "brake"), [
    ("brake silent 1s", 0.0), ("brake frozen 1s", 0.5), ("brake offset by -0.2 1s", 0.6),
    ("brake late by 2 1s", 0.5), ("throttle silent 1s", 0.8),
])  # fmt: skip
def test_a_brake_fails(fault, brake):
    unit = shim(fault)
    run(unit, 0, 1.0, brake=0.5)
    assert run(unit, 300, 1.0, brake=0.8)[-1].brake == pytest.approx(brake, abs=BAND)


def test_a_steering_without_power_stays_where_it_is():
    unit = shim("steering silent 2s-4s")
    was = run(unit, 0, 2.0, steering_rad=0.3)[-1].steering_rad
    assert run(unit, 600, 1.9, steering_rad=-0.3)[-1].steering_rad == was
    assert run(unit, 1170, 3.0, steering_rad=-0.3)[-1].steering_rad < 0.0


def test_noise_and_flapping_move_a_servo():
    noisy = {a.throttle for a in run(shim("throttle noisy 0s"), 0, 1.0, throttle=0.5)}
    assert len(noisy) > 50
    flaps = [a.brake for a in run(shim("brake flapping by 2 0s"), 0, 4.0, brake=0.7)]
    assert min(flaps[150:]) == pytest.approx(0.0, abs=BAND)
    assert max(flaps[150:]) == pytest.approx(0.7, abs=BAND)


def test_a_gear_that_is_stuck_does_not_shift():
    assert run(shim("gear frozen 0s"), 0, 30.0, gear=Gear.LOW, brake=1.0)[-1].gear == Gear.HIGH
