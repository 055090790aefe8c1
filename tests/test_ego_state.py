"""The ego state on a small synthetic vehicle, whose truth is known and whose sensors err as stated
in the data sheets: GPS 0.10 m CEP as a slow offset, compass bias, gyro bias, wheels off by 2 %."""

import math
import pickle
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

import nav.parameters
from nav.fusion.ego_kinematics import Attitude, heading_rate, level, speed_of_wheels
from nav.fusion.ego_state import EgoState
from nav.messages import CompassHeading, Gear, GpsFix, GpsQuality, ImuSample, VehicleState
from nav.parameters.ego_state import EgoParameters
from nav.parameters.loader import from_toml
from nav.parameters.vehicle import VehicleParameters
from nav.route.geodesy import Frame
from nav.steering_circle import curvature

FOLDER = Path(nav.parameters.__path__[0])
FRAME = Frame(34.5, -117.0)
TICK_NS = 10_000_000
RADIUS_M = 12.0


def load(cls, name):
    return from_toml(cls, (FOLDER / name).read_text(), name)


# the synthetic gyro keeps its vertical; what erection does to one is tested in test_erection.py
PARAMETERS = replace(load(EgoParameters, "ego_state.toml"), erection_s=1e9)
VEHICLE = load(VehicleParameters, "vehicle.toml")


@dataclass
class Truth:
    """A vehicle that moves at a speed along a curvature, on ground that tilts it."""

    x: float = 3.0
    y: float = -2.0
    heading: float = 0.7
    speed: float = 0.0
    yaw_rate: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0

    def drive(self, speed, bend, dt):
        self.speed, self.yaw_rate = speed, speed * bend
        middle = self.heading + 0.5 * self.yaw_rate * dt
        self.x += speed * dt * math.cos(middle)
        self.y += speed * dt * math.sin(middle)
        self.heading += self.yaw_rate * dt


@dataclass
class Errors:
    """What the sensors get wrong; all zero for none."""

    gps_m: float = 0.085  # one sigma an axis: 0.10 m CEP
    gps_white_m: float = 0.01
    velocity_mps: float = 0.03
    gyro_radps: float = 0.002
    gyro_bias_radps: float = 1e-4
    compass_rad: float = 0.02
    compass_bias_rad: float = 0.04
    wheel_scale: float = 0.02
    wheels_mps: float = 0.02


class Sensors:
    """Makes messages of a truth; `mute` names those that say nothing."""

    def __init__(self, seed=0, errors=None, mute=(), mirrored=False):
        self.rng = np.random.default_rng(seed)
        self.errors = errors or Errors()
        self.mute = mute
        self.flip = -1.0 if mirrored else 1.0
        self.offset = self.rng.normal(0, self.errors.gps_m, 2)
        self.jump = np.zeros(2)
        self.quality, self.sd_m = GpsQuality.CONVERGED, 0.1
        self.delayed = []
        self.ahead_mps2 = 0.0  # what the accelerometer feels along the vehicle
        self.brake = 0.0

    def messages(self, truth, tick, gear=Gear.LOW):
        now = tick * TICK_NS
        made = [("imu", self.imu(truth, now))]
        if tick % 2 == 0:
            made.append(("wheels", self.wheels(truth, now, gear)))
        if tick % 10 == 0:
            made.append(("compass", self.compass(truth, now)))
        if tick % 5 == 0:
            self.delayed.append(self.fix(truth, now))
        if self.delayed and self.delayed[0].time_ns <= now - 50_000_000:
            made.append(("gps", self.delayed.pop(0)))
        return [message for name, message in made if name not in self.mute]

    def imu(self, truth, now):
        e = self.errors
        rate = truth.yaw_rate + e.gyro_bias_radps + self.rng.normal(0, e.gyro_radps)
        # The heading rate as a tilted gyro sees it; the tilt itself stands still.
        s, c = math.sin(truth.roll), math.cos(truth.roll)
        lean = math.cos(truth.pitch)
        rates = (-rate * math.sin(truth.pitch), rate * s * lean, rate * c * lean)
        p, q, r = rates
        f = self.flip
        angular = np.array([f * p, q, f * r])
        force = np.array([self.ahead_mps2, 0, 9.81])
        return ImuSample(now, angular, force, f * truth.roll, truth.pitch)

    def wheels(self, truth, now, gear):
        e, r, v = self.errors, truth.yaw_rate, truth.speed
        side = 0.5 * VEHICLE.track_m * r
        speeds = []
        for i in range(6):
            along = v - side if i % 2 == 0 else v + side
            speeds.append(math.hypot(along, VEHICLE.wheelbase_m * r) if i < 2 else abs(along))
        noisy = np.array(speeds) * (1 + e.wheel_scale) + self.rng.normal(0, e.wheels_mps, 6)
        wheel = np.abs(noisy)
        if self.flip < 0:
            wheel = wheel[[1, 0, 3, 2, 5, 4]]
        bend = self.flip * (r / v if v else 0.0)
        steer = VEHICLE.steering
        share = steer.linear_m * abs(bend) + steer.quadratic_m2 * bend * bend
        angle = math.copysign(steer.limit_rad * share, bend)
        return VehicleState(now, wheel, angle, 0.0, self.brake, gear, False)

    def compass(self, truth, now):
        e = self.errors
        heading = truth.heading + e.compass_bias_rad + self.rng.normal(0, e.compass_rad)
        heading *= self.flip
        return CompassHeading(now, math.remainder(heading, 2 * math.pi))

    def fix(self, truth, now):
        e, fade = self.errors, math.exp(-0.05 / 120.0)
        drawn = self.rng.normal(0, 1, 2)
        self.offset = self.offset * fade + self.sd_m / 0.1 * e.gps_m * drawn * math.sqrt(
            1 - fade**2
        )
        forward, left = level(VEHICLE.gps_position_m, _attitude(truth))
        c, s = math.cos(truth.heading), math.sin(truth.heading)
        xy = np.array([truth.x + c * forward - s * left, truth.y + s * forward + c * left])
        xy += self.offset + self.jump + self.rng.normal(0, e.gps_white_m, 2)
        reach = truth.yaw_rate * VEHICLE.gps_position_m[0]
        velocity = np.array([truth.speed * c - reach * s, truth.speed * s + reach * c, 0.0])
        velocity[:2] += self.rng.normal(0, e.velocity_mps, 2)
        mirror = np.array([1.0, self.flip])
        lat, lon = FRAME.to_geodetic((xy * mirror)[None])
        velocity[1] *= self.flip
        return GpsFix(now, self.quality, 9, lat[0], lon[0], 0.0, self.sd_m, velocity)


def _attitude(truth):
    return Attitude(truth.roll, truth.pitch)


def loop(second):
    """Speed and curvature of a drive: rest, straight, circle, straight, circle the other way."""
    speed = min(max(second - 3.0, 0.0), 4.0)
    phase = (second - 7.0) % 40.0
    bend = (
        0.0 if second < 7.0 else (1 / RADIUS_M if phase < 15 else (0.0, -1 / RADIUS_M)[phase > 25])
    )
    return speed, bend


@dataclass
class Log:
    """Truth and estimate, side by side, one row a tick in which there was an estimate."""

    second: np.ndarray
    ahead_m: np.ndarray
    cross_m: np.ndarray
    heading_rad: np.ndarray
    speed_mps: np.ndarray
    estimates: list


def run(sensors, seconds, plan=loop, *, ego=None, truth=None, script=None, gear=Gear.LOW):
    ego = ego or EgoState(PARAMETERS, VEHICLE, FRAME)
    truth = truth or Truth()
    rows, estimates = [], []
    for tick in range(int(seconds * 100)):
        if script:
            script(tick / 100, sensors, truth)
        for message in sensors.messages(truth, tick, gear):
            ego.update(message)
        estimate = ego.estimate(tick * TICK_NS)
        if estimate:
            rows.append((tick / 100, *differences(estimate, truth)))
            estimates.append(estimate)
        truth.drive(*plan(tick / 100), TICK_NS * 1e-9)
    return Log(*np.array(rows).reshape(-1, 5).T, estimates)


def differences(estimate, truth):
    dx, dy = estimate.position_m - (truth.x, truth.y)
    c, s = math.cos(truth.heading), math.sin(truth.heading)
    turned = math.remainder(estimate.heading_rad - truth.heading, 2 * math.pi)
    return c * dx + s * dy, c * dy - s * dx, turned, estimate.speed_mps - truth.speed


def rms(values):
    return float(np.sqrt(np.mean(values**2)))


# ---------------------------------------------------------------- the whole filter


def test_without_errors_the_truth_comes_out():
    exact = Errors(*(0.0,) * 9)
    log = run(Sensors(errors=exact), 60)
    assert np.hypot(log.ahead_m, log.cross_m).max() < 0.03
    assert np.abs(log.heading_rad[log.second > 10]).max() < np.radians(
        0.5
    )  # where the circle starts


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_drive_with_straights_and_circles(seed):
    log = run(Sensors(seed), 60)
    moving = log.second > 8
    assert log.second[0] < 1.5
    assert rms(log.cross_m[moving]) < 0.15
    assert np.abs(log.heading_rad[moving]).max() < np.radians(1.0)
    assert rms(log.speed_mps[moving]) < 0.06


def test_the_stated_deviations_are_honest():
    errors, stated = [], []
    for seed in range(4):
        log = run(Sensors(seed), 25)
        errors += [log.ahead_m[-1], log.cross_m[-1]]
        stated.append(log.estimates[-1].position_sd_m)
    assert 0.4 < rms(np.array(errors)) / np.mean(stated) < 2.0


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_tunnel_is_crossed_on_dead_reckoning(seed):
    """30 m at 2.2 m/s without fixes; afterwards single-point fixes do not pull the vehicle away."""

    def script(second, sensors, truth):
        inside = 30.0 <= second < 30.0 + 30.0 / 2.2
        after = second >= 30.0 + 30.0 / 2.2
        sensors.quality = GpsQuality.NONE if inside else GpsQuality.CONVERGED
        if after and sensors.sd_m == 0.1:
            sensors.sd_m, sensors.quality = 1.0, GpsQuality.DIFFERENTIAL
            sensors.offset = np.array([1.0, -0.8])

    def plan(second):
        return min(max(second - 3.0, 0.0), 2.2), 0.05 * math.sin(0.2 * second)

    log = run(Sensors(seed), 60, plan, script=script)
    before = np.hypot(log.ahead_m, log.cross_m)[log.second < 30.0][-1]
    gap = (log.second >= 30.0) & (log.second < 30.0 + 30.0 / 2.2)
    assert np.hypot(log.ahead_m, log.cross_m)[gap].max() < before + 0.3
    track = np.array([e.position_m for e in log.estimates])
    steps = np.linalg.norm(np.diff(track, axis=0), axis=1)
    assert steps[log.second[1:] > 10].max() < 0.022 + 0.06
    assert np.abs(log.cross_m[-1]) < 0.6


def test_gps_loss_is_counted_from_the_last_fix():
    ego, sensors = EgoState(PARAMETERS, VEHICLE, FRAME), Sensors()

    def script(second, sensors, truth):
        sensors.quality = GpsQuality.NONE if second >= 5.0 else GpsQuality.CONVERGED

    run(sensors, 10, ego=ego, script=script)
    assert ego.gps_lost_s(9_990_000_000) == pytest.approx(9.99 - 4.95)
    assert EgoState(PARAMETERS, VEHICLE, FRAME).gps_lost_s(5) == 0.0


def test_a_jump_of_the_gps_is_refused():
    def script(second, sensors, truth):
        sensors.jump = np.array([3.0, -3.0]) if 20 <= second < 22 else np.zeros(2)

    with_jump, without = (run(Sensors(4), 25, script=s) for s in (script, None))
    assert np.abs(with_jump.cross_m - without.cross_m).max() < 0.15


def test_a_gps_that_insists_is_believed():
    def script(second, sensors, truth):
        sensors.jump = np.array([3.0, 0.0]) if second >= 20 else np.zeros(2)

    log = run(Sensors(4), 40, script=script)
    assert np.hypot(log.ahead_m, log.cross_m)[-1] > 2.0


def test_spinning_wheels_are_refused():
    def script(second, sensors, truth):
        scale = 1.5 if 20 <= second < 21.5 else 0.02
        sensors.errors = replace(sensors.errors, wheel_scale=scale)

    log = run(Sensors(5), 30, script=script)
    assert np.abs(log.speed_mps[log.second > 10]).max() < 0.4


def test_wheels_that_slide_under_full_brakes_do_not_let_the_estimate_run_on():
    def plan(second):
        braked = max(10.0 - 5.5 * (second - 20.0), 2.0)
        return min(max(3.0 * (second - 3.0), 0.0), 10.0, braked), 0.0

    def script(second, sensors, truth):
        del truth
        braking = 20.0 <= second < 21.4
        sensors.ahead_mps2 = -5.5 if braking else 0.0
        sensors.errors = replace(sensors.errors, wheel_scale=-0.06 if braking else 0.02)

    log = run(Sensors(6), 30, plan, script=script)
    late = log.second > 10
    assert np.abs(log.speed_mps[late]).max() < 1.0
    assert np.abs(log.ahead_m[late]).max() < 0.3


@pytest.mark.parametrize("turns", [0.9, 0.5, 0.0])
@pytest.mark.parametrize("pitch", [0.0, 0.06, -0.06])
def test_locked_wheels_do_not_hide_how_fast_it_still_is(turns, pitch):
    """On a slope the accelerometer feels gravity, too."""

    def plan(second):
        braked = max(8.0 - 5.0 * (second - 20.0), 0.0)
        return min(max(3.0 * (second - 3.0), 0.0), 8.0, braked), 0.0

    def script(second, sensors, truth):
        truth.pitch = pitch
        braking = 20.0 <= second < 21.6
        sensors.brake = 1.0 if second >= 19.8 else 0.0
        sensors.ahead_mps2 = -9.81 * math.sin(pitch) - (5.0 if braking else 0.0)
        sensors.errors = replace(sensors.errors, wheel_scale=turns - 1.0 if braking else 0.02)

    log = run(Sensors(6), 30, plan, script=script)
    late = log.second > 10
    assert np.abs(log.speed_mps[late]).max() < 0.4
    assert np.abs(log.ahead_m[late]).max() < 0.25


def test_reverse_gear_is_driven_backwards():
    def plan(second):
        return -min(max(second - 3.0, 0.0), 2.0), 0.0

    log = run(Sensors(6), 25, plan, gear=Gear.REVERSE)
    assert log.estimates[-1].speed_mps == pytest.approx(-2.0, abs=0.1)
    assert np.abs(log.heading_rad[-1]) < np.radians(1.0)


def test_a_stop_keeps_position_and_heading():
    def plan(second):
        return (4.0, 0.02) if 3 < second < 20 else (0.0, 0.0)

    log = run(Sensors(7), 80, plan)
    rest = log.second > 25
    track = np.array([e.position_m for e in log.estimates])[rest]
    assert np.ptp(np.unwrap(log.heading_rad[rest])) < np.radians(1.0)
    assert np.linalg.norm(np.ptp(track, axis=0)) < 0.3
    assert np.abs(log.speed_mps[rest]).max() < 0.05


def test_a_tilted_vehicle_takes_its_antenna_into_account():
    truth = Truth(roll=0.15, pitch=-0.1)
    log = run(Sensors(8, Errors(*(0.0,) * 9)), 40, truth=truth)
    assert np.abs(log.cross_m[log.second > 10]).max() < 0.05


# ---------------------------------------------------------------- sensors that are missing


@pytest.mark.parametrize("mute", ["imu", "wheels", "compass"])
def test_one_sensor_may_be_missing(mute):
    def plan(second):  # without compass and crew somebody must move it first
        return min(max(second - 3.0, 0.0), 3.0), 0.04 * (second > 12)

    log = run(Sensors(9, mute=(mute,)), 60, plan)
    late = log.second > 15
    assert rms(log.cross_m[late]) < 0.3
    assert np.abs(log.heading_rad[late]).max() < np.radians(3.0)


def test_wheels_that_fall_silent_as_it_brakes_leave_no_acceleration_behind():
    def plan(second):
        return max(min(4.0, 4.0 - 2.0 * (second - 20.0)), 0.0) if second > 3.0 else 0.0, 0.0

    def silence(second, sensors, truth):
        del truth
        sensors.mute = ("wheels",) if second > 21.0 else ()

    log = run(Sensors(7), 120, plan, script=silence)
    standing = log.second > 60.0
    assert abs(np.mean(log.speed_mps[standing])) < 0.005
    assert np.abs(log.ahead_m[standing]).max() < 0.5


def test_without_gps_it_is_never_ready():
    ego = EgoState(PARAMETERS, VEHICLE, FRAME)
    assert run(Sensors(mute=("gps",)), 20, ego=ego).estimates == []
    assert not ego.ready
    assert ego.gps_lost_s(20_000_000_000) == pytest.approx(20.0)


def test_at_rest_without_a_compass_only_the_crew_knows_the_heading():
    def rest(second):
        return 0.0, 0.0

    assert run(Sensors(mute=("compass",)), 10, rest).estimates == []
    told = EgoState(PARAMETERS, VEHICLE, FRAME, crew_heading_rad=0.9)
    log = run(Sensors(mute=("compass",)), 40, ego=told)
    assert log.second[0] < 4.0
    assert log.estimates[0].heading_sd_rad > 0.15
    assert np.abs(log.heading_rad[log.second > 12]).max() < np.radians(1.0)


def test_compass_and_fixes_start_it_from_rest():
    log = run(Sensors(1), 2)
    assert log.second[0] < 1.2
    assert np.abs(log.heading_rad).max() < 0.15


# ---------------------------------------------------------------- the object


def test_it_is_deterministic_and_pickles_in_the_middle():
    whole = run(Sensors(2), 12)
    ego, sensors, truth = EgoState(PARAMETERS, VEHICLE, FRAME), Sensors(2), Truth()
    for tick in range(1200):
        if tick == 700:
            ego = pickle.loads(pickle.dumps(ego))
        for message in sensors.messages(truth, tick):
            ego.update(message)
        truth.drive(*loop(tick / 100), TICK_NS * 1e-9)
    last = ego.estimate(1199 * TICK_NS)
    assert last.position_m.tobytes() == whole.estimates[-1].position_m.tobytes()
    assert last.heading_rad == whole.estimates[-1].heading_rad


def test_a_mirrored_world_gives_a_mirrored_estimate():
    straight, mirrored = (
        run(Sensors(3, mirrored=m), 30, truth=Truth(roll=0.05, pitch=0.03)).estimates[-1]
        for m in (False, True)
    )
    np.testing.assert_allclose(mirrored.position_m, straight.position_m * [1, -1], atol=1e-5)
    assert mirrored.heading_rad == pytest.approx(-straight.heading_rad, abs=1e-6)
    assert mirrored.yaw_rate_radps == pytest.approx(-straight.yaw_rate_radps, abs=1e-6)
    assert mirrored.roll_rad == -straight.roll_rad


def test_pose_at_reaches_a_few_milliseconds_either_way():
    ego, truth = EgoState(PARAMETERS, VEHICLE, FRAME), Truth()
    run(Sensors(1), 20, ego=ego, truth=truth)
    early, now, late = (ego.pose_at(19_990_000_000 + k * 10_000_000) for k in (-1, 0, 1))
    for a, b in ((early, now), (now, late)):
        assert math.hypot(b.x_m - a.x_m, b.y_m - a.y_m) == pytest.approx(0.04, abs=0.003)
        assert math.remainder(b.heading_rad - a.heading_rad, 2 * math.pi) == pytest.approx(
            truth.yaw_rate * 0.01, abs=1e-3
        )


# ---------------------------------------------------------------- kinematics


def test_curvature_is_the_inverse_of_the_measured_circle():
    steer = VEHICLE.steering
    for bend in (-0.15, -0.02, 0.0, 0.05, 0.17):
        share = steer.linear_m * abs(bend) + steer.quadratic_m2 * bend * bend
        angle = math.copysign(share * steer.limit_rad, bend)
        assert curvature(angle, steer) == pytest.approx(bend, abs=1e-9)
    assert 1 / curvature(1.0, steer) == pytest.approx(5.8, abs=0.1)


def test_two_wheels_that_spin_do_not_matter():
    wheels = [2.0, 2.0, 2.0, 9.0, 2.0, 9.0]
    assert speed_of_wheels(wheels, 0.0, VEHICLE) == pytest.approx(2.0)


def test_a_tilted_gyro_still_gives_the_heading_rate():
    attitude = _attitude(Truth(roll=0.3, pitch=0.2))
    rate = 0.5
    body = (
        -rate * math.sin(0.2),
        rate * math.sin(0.3) * math.cos(0.2),
        rate * math.cos(0.3) * math.cos(0.2),
    )
    assert heading_rate(attitude._replace(rate_radps=body)) == pytest.approx(rate)


def test_the_antenna_of_a_leaning_vehicle_is_beside_it():
    forward, left = level((0.6, 0.0, 2.0), _attitude(Truth(roll=0.1)))
    assert left == pytest.approx(-2.0 * math.sin(0.1))  # left side up: leans to the right
    assert forward == pytest.approx(0.6)
    forward, _ = level((0.6, 0.0, 2.0), _attitude(Truth(pitch=0.1)))
    assert forward > 0.6  # nose down: leans forward
