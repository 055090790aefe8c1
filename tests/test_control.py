"""The low-level controller: limits, braking, path following on a kinematic vehicle."""

from math import cos, pi, sin

import numpy as np
import pytest

from nav.control.limits import limited
from nav.control.low_level import LowLevelController
from nav.control.speed import SpeedController
from nav.messages import EgoEstimate, FollowPath, Gear, UnitOperation, VehicleState
from nav.parameters import parameters_from
from nav.steering_circle import curvature, steering_angle
from scenarios.parameter_files import parameter_texts
from scenarios.scenario_file import read_scenario

P = parameters_from(parameter_texts())
TICK_NS = 20_000_000


def ego(x=0.0, y=0.0, heading=0.0, speed=3.0, yaw_rate=0.0, time_ns=0) -> EgoEstimate:
    return EgoEstimate(time_ns, [x, y], heading, speed, yaw_rate, 0.0, 0.0, 0.1, 0.01)


def vehicle(time_ns=0, gear=Gear.HIGH, shifting=False, steering=0.0) -> VehicleState:
    return VehicleState(time_ns, [0.0] * 6, steering, 0.0, 0.0, gear, shifting)


def test_limits_saturate_and_the_brake_wins():
    t = limited(5, 9.0, 3.0, 0.1, Gear.HIGH, 0.5)
    assert (t.steering_rad, t.throttle, t.brake) == (0.5, 0.0, 0.1)
    t = limited(5, -9.0, 3.0, -1.0, Gear.HIGH, 0.5)
    assert (t.steering_rad, t.throttle, t.brake) == (-0.5, 1.0, 0.0)


def test_steering_follows_the_measured_circle_and_is_odd():
    s = P.vehicle.steering
    assert steering_angle(1 / 5.8, s) == pytest.approx(s.limit_rad, rel=0.01)
    assert steering_angle(-0.1, s) == -steering_angle(0.1, s)
    assert steering_angle(9.0, s) == steering_angle(1 / s.minimum_radius_m, s)
    for k in (0.0, 0.01, -0.05, 0.1, -0.17):
        assert curvature(steering_angle(k, s), s) == pytest.approx(k, abs=1e-9)


def test_no_fresh_command_stops_the_vehicle():
    control = LowLevelController(P.control, P.vehicle.steering)
    assert control.step(0, ego(), vehicle()).brake > 0.0
    points = np.column_stack([np.linspace(0, 9, 10), np.zeros(10)])
    control.command_is(FollowPath(0, points, 3.0))
    assert control.step(TICK_NS, ego(speed=0.0), vehicle()).brake == 0.0
    late = int(0.6e9)
    stop = control.step(late, ego(), vehicle())
    assert (stop.throttle, stop.brake > 0.0) == (0.0, True)


def test_no_throttle_while_the_gear_is_shifting():
    control = LowLevelController(P.control, P.vehicle.steering)
    points = np.column_stack([np.linspace(0, 9, 10), np.zeros(10)])
    control.command_is(FollowPath(0, points, 3.0))
    assert control.step(TICK_NS, ego(speed=0.0), vehicle(shifting=True)).throttle == 0.0
    assert control.step(TICK_NS, ego(speed=0.0), vehicle(gear=Gear.NEUTRAL)).throttle == 0.0


def test_another_gear_is_asked_for_at_a_stand_only():
    control = LowLevelController(P.control, P.vehicle.steering)
    control.command_is(UnitOperation(0, Gear.REVERSE, 0.0, 3.0, 1.0))
    rolling = control.step(TICK_NS, ego(speed=1.0), vehicle())
    assert (rolling.gear, rolling.brake > 0.0) == (Gear.HIGH, True)
    assert control.step(2 * TICK_NS, ego(speed=0.0), vehicle()).gear == Gear.REVERSE


def test_speed_controller_brakes_above_and_drives_below():
    speed = SpeedController(P.control.speed)
    throttle, brake = speed.step(3.0, 6.0, 0.02)
    assert throttle == 0.0
    assert brake > 0.3
    throttle, brake = speed.step(3.0, 1.0, 0.02)
    assert throttle > 0.0
    assert brake == 0.0


@pytest.mark.parametrize("speed_mps", [0.3, 1.0, 2.0, 4.0, 8.0, -3.0])
def test_a_stop_brakes_no_weaker_than_a_set_point_just_above_it(speed_mps):
    above = P.control.speed.stop_mps + 0.01
    brake = [SpeedController(P.control.speed).step(v, speed_mps, 0.02)[1] for v in (0.0, above)]
    assert brake[0] >= max(min(brake[1], 1.0) - 0.01, P.control.speed.hold_brake)


def test_the_twin_holds_its_speed_without_overshoot(tmp_path):
    """A bound is what can be stopped for; half a metre a second more is 1.3 m of way."""
    file = tmp_path / "straight.toml"
    file.write_text(
        'title = "Straight on."\ncourse = "trial"\ntime_limit_s = 60.0\n'
        "waypoints = [[0, 0, 2.7, 25], [150, 0, 2.7, 25], [300, 0, 2.7, 0]]\n"
    )
    episode, over_mps, least_mps = read_scenario(file).episode(0), 0.0, 99.0
    while episode.time_s < 16.0:
        episode.tick()
        if episode.decision:
            over_mps = max(over_mps, episode.truth.speed_mps - episode.decision.speed_mps)
        if episode.time_s > 12.0:
            least_mps = min(least_mps, episode.truth.speed_mps)
    assert over_mps < 0.2
    assert least_mps > P.planning.speed.open_mps - 0.3


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_offset_decays_on_a_straight_line(side):
    control = LowLevelController(P.control, P.vehicle.steering)
    x, y, heading, delta, speed = 0.0, side * 1.0, 0.0, 0.0, 3.0
    late = [0.0] * 15
    offsets = []
    for k in range(600):
        x0 = x - 1.0
        points = np.column_stack([np.linspace(x0, x0 + 12.0, 10), np.zeros(10)])
        now = k * TICK_NS
        yaw_rate = speed * curvature(delta, P.vehicle.steering)
        control.command_is(FollowPath(now, points, speed))
        here = ego(x, y, heading, speed, yaw_rate, now)
        target = control.step(now, here, vehicle(now, steering=delta))
        late.append(target.steering_rad)
        rate = P.vehicle.steering.rate_radps * 0.02
        delta += min(max(late.pop(0) - delta, -rate), rate)
        heading += yaw_rate * 0.02
        x, y = x + speed * 0.02 * cos(heading), y + speed * 0.02 * sin(heading)
        offsets.append(y * side)
    assert abs(offsets[-1]) < 0.05
    assert min(offsets) > -0.25
    assert abs(heading) < pi / 60
