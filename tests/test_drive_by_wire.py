import numpy as np
import pytest

from nav.messages import ActuatorTargets, Gear
from twin import clock
from twin.drive_by_wire import Delay, DriveByWire, DriveByWireParameters
from twin.drivetrain import Gearbox, GearboxParameters

P = DriveByWireParameters()


def shim():
    gearbox = Gearbox(GearboxParameters(), np.random.default_rng(0), Gear.HIGH)
    return DriveByWire(P, gearbox, clock.STEP_S)


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
    assert np.flatnonzero(angles)[0] == round(P.steering_delay_s * clock.STEPS_PER_SECOND)
    assert np.diff(angles).max() == pytest.approx(P.steering_rate_radps * clock.STEP_S)
    assert angles[-1] == 0.5


def test_lock_to_lock_takes_four_seconds():
    unit = shim()
    run(unit, 0, 3.0, steering_rad=-P.steering_limit_rad)
    angles = np.array([a.steering_rad for a in run(unit, 900, 5.0, steering_rad=1.0)])
    moving = np.flatnonzero(np.diff(angles)).size * clock.STEP_S
    assert moving == pytest.approx(4.0, abs=0.02)


def test_targets_are_saturated():
    last = run(shim(), 0, 4.0, steering_rad=3.0, throttle=2.0, brake=-1.0)[-1]
    assert last.steering_rad == P.steering_limit_rad
    assert (last.throttle, last.brake) == (1.0, 0.0)


def test_stops_when_targets_stop():
    unit = shim()
    assert run(unit, 0, 2.0, throttle=0.6, steering_rad=0.2)[-1].throttle == 0.6
    quiet = silence(unit, 600, 1.5)
    assert quiet[round(0.45 * 300)].throttle == 0.6
    assert quiet[round(1.0 * 300)].throttle == 0.0
    assert quiet[-1].brake == 1.0
    assert quiet[-1].steering_rad == 0.2
    assert run(unit, 1050, 1.0, throttle=0.3)[-1][1:3] == (0.3, 0.0)


def test_what_is_no_number_counts_as_not_arrived():
    last = run(shim(), 0, 1.0, steering_rad=float("nan"), throttle=0.5)[-1]
    assert (last.throttle, last.brake) == (0.0, 1.0)


def test_gear_is_reported_while_the_linkage_walks():
    applied = run(shim(), 0, 15.0, gear=Gear.NEUTRAL, brake=1.0)
    assert [applied[0].gear, applied[-1].gear] == [Gear.HIGH, Gear.NEUTRAL]
    assert applied[10].shifting
    assert not applied[-1].shifting
    assert Gear.LOW in {a.gear for a in applied}
