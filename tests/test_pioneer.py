"""The Pioneer: its model against its table, its drive-by-wire unit, and the whole in motion."""

import pickle
from math import inf, nan

import mujoco
import numpy as np
import pytest

import models
from nav.messages import ActuatorTargets, Gear, LidarScan, VehicleState
from nav.parameters import parameters_from
from nav.steering_circle import curvature
from scenarios.parameter_files import parameter_texts
from scenarios.vehicles import VEHICLES
from tape.codec import encode
from twin import pioneer
from twin.skid_steer import SkidSteer, SkidSteerParameters
from twin.terrain import RollingGround
from twin.world import Obstacle, World

TABLE = parameters_from(parameter_texts("pioneer"), "pioneer").vehicle
UNIT = SkidSteerParameters()
SENSORS = pioneer.sensors()
POST = Obstacle(
    "post_left", "gate_post", "cylinder", (2.0, 0.0, 0.3), (0.1, 0.1, 0.4), owner="post"
)
SKY = np.radians([(k * 60.0, 40.0) for k in range(6)])


@pytest.fixture(scope="module")
def model():
    return mujoco.MjModel.from_xml_path(models.path(models.PIONEER))


def world(*obstacles, friction=0.7):
    floor = RollingGround(0, octaves=())
    return World(floor, obstacles, friction, (40.0, -83.0), (0.0, 0.0, 0.0), SKY)


def targets(now, steering_rad=0.0, throttle=0.0, brake=0.0, gear=Gear.HIGH):
    return ActuatorTargets(now, steering_rad, throttle, brake, gear)


def drive(simulator, seconds, **asked):
    """All messages of a drive under constant targets."""
    heard = []
    for _ in range(round(seconds * 50)):
        heard += simulator.advance(targets(simulator.time_ns, **asked))
    return heard


# ---------------------------------------------------------------- model and table


def test_everything_has_a_name(model):
    for kind in ("body", "geom", "joint", "site", "actuator", "sensor", "key", "equality"):
        count = getattr(model, {"joint": "njnt", "equality": "neq"}.get(kind, f"n{kind}"))
        assert all(getattr(model, kind)(i).name for i in range(count)), kind


def test_wheels_stand_where_the_table_has_them(model):
    wheels = np.array([model.body(f"{w}_wheel").pos for w in pioneer.WHEELS])
    assert wheels[:2, 0] == pytest.approx([TABLE.wheelbase_m] * 2)
    assert wheels[0, 0] - wheels[2, 0] == pytest.approx(0.268)
    assert wheels[0::2, 1] - wheels[1::2, 1] == pytest.approx([TABLE.track_m] * 2)
    for name in pioneer.WHEELS:
        assert model.geom(f"{name}_tire").size[0] == TABLE.wheel_radius_m
    assert UNIT.wheel_radius_m == SENSORS.odometry.wheel_radius_m == TABLE.wheel_radius_m


def test_outline_covers_the_collision_geoms(model):
    solid = [model.geom(name) for name in ("body", "sick")]
    low = np.min([g.pos - g.size for g in solid], axis=0)
    high = np.max([g.pos + g.size for g in solid], axis=0)
    outline, judged = TABLE.outline, VEHICLES["pioneer"]
    assert low[:2] == pytest.approx([outline.rear_m, -outline.half_width_m])
    assert high == pytest.approx([outline.front_m, outline.half_width_m, 0.462])
    assert low[2] == pytest.approx(0.08)
    assert tuple(judged.outline)[:3] == (outline.front_m, outline.rear_m, outline.half_width_m)
    assert judged.height_m == pytest.approx(high[2], abs=0.005)


def test_mass(model):
    assert model.body("pioneer").subtreemass[0] == pytest.approx(12.0 + 4.5)


def test_sites_are_where_the_navigator_thinks(model):
    mounts = {f"sonar_{n}": (m.position_m, m.yaw_rad) for n, m in TABLE.sonar_mounts.items()}
    mounts |= {n: (m.position_m, m.yaw_rad) for n, m in TABLE.lidar_mounts.items()}
    mounts |= {"gps": (TABLE.gps_position_m, 0.0), "imu": (TABLE.imu_position_m, 0.0)}
    for name, (position, yaw) in mounts.items():
        site, rotation = model.site(name), np.zeros(9)
        mujoco.mju_quat2Mat(rotation, site.quat)
        assert site.pos == pytest.approx(position), name
        assert rotation[:4] == pytest.approx([np.cos(yaw), -np.sin(yaw), 0, np.sin(yaw)]), name


def test_twin_and_navigator_say_the_same_of_steering_and_sensors():
    steering = TABLE.steering
    assert UNIT.steering_limit_rad == steering.limit_rad
    assert UNIT.steering_rate_radps == steering.rate_radps
    assert UNIT.delay_s == steering.delay_s
    assert curvature(0.3, steering) == pytest.approx(0.3 / (0.6 * UNIT.radius_m))
    assert curvature(9.9, steering) == pytest.approx(1.0 / UNIT.radius_m)
    assert SENSORS.lidar.units == tuple(TABLE.lidar_mounts) == VEHICLES["pioneer"].lidars
    assert SENSORS.sonar.units == tuple(TABLE.sonar_mounts)
    assert SENSORS.sonar.max_range_m == TABLE.sonar.max_range_m


# ---------------------------------------------------------------- drive-by-wire


def unit(seconds, **asked):
    """A unit after some time under constant targets, and its sides' speeds [m/s]."""
    shim, sides = SkidSteer(UNIT, 0.01), (0.0, 0.0)
    for k in range(round(seconds * 100)):
        shim.apply(k * 10**7, targets(k * 10**7, **asked))
        sides = shim.step(k * 10**7)
    return shim, np.array(sides) * UNIT.wheel_radius_m


def test_nothing_happens_before_the_delay():
    assert (unit(UNIT.delay_s, throttle=1.0)[1] == 0.0).all()
    assert (unit(UNIT.delay_s + 0.05, throttle=1.0)[1] > 0.0).all()


def test_speed_rises_no_faster_than_it_may_and_ends_at_the_top():
    assert unit(0.6, throttle=1.0)[1] == pytest.approx([0.25] * 2, abs=0.01)
    assert unit(3.0, throttle=2.0)[1] == pytest.approx([UNIT.top_speed_mps] * 2)


def test_gears():
    assert unit(3.0, throttle=0.5, gear=Gear.REVERSE)[1] == pytest.approx([-0.35] * 2)
    assert (unit(3.0, throttle=0.5, gear=Gear.NEUTRAL)[1] == 0.0).all()
    assert (unit(3.0, throttle=0.5, brake=0.1)[1] == 0.0).all()


@pytest.mark.parametrize("throttle", [0.2, 0.5, 1.0])
def test_sides_turn_the_robot_and_stay_within_their_limit(throttle):
    left, right = unit(3.0, steering_rad=-9.9, throttle=throttle)[1]
    assert left > right
    assert left <= UNIT.side_mps + 1e-9
    curvature = (right - left) / UNIT.track_m / (0.5 * (left + right))
    assert curvature == pytest.approx(-1.0 / UNIT.radius_m)


def test_it_stops_when_targets_stop():
    shim, sides = unit(3.0, throttle=1.0)
    assert sides == pytest.approx([0.7] * 2)
    for k in range(300, 500):
        sides = shim.step(k * 10**7)
        if k * 0.01 < 2.99 + UNIT.timeout_s:
            assert shim.speed_mps == pytest.approx(0.7)
    assert sides == (0.0, 0.0)
    assert shim.applied.brake == 1.0


@pytest.mark.parametrize("bad", [nan, inf])
def test_what_is_no_number_counts_as_not_arrived(bad):
    shim, _ = unit(1.0, steering_rad=bad, throttle=0.5)
    assert shim.speed_mps == 0.0


# ---------------------------------------------------------------- in motion


def test_it_stands_still():
    simulator = pioneer.simulator(world(), 0)
    drive(simulator, 2.0, brake=1.0)
    truth = simulator.truth()
    assert truth.position_m == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)
    assert truth.contacts == ()
    assert truth.tire_center_m.shape == (4, 3)


@pytest.mark.parametrize("friction", [0.6, 0.9])
@pytest.mark.parametrize("steering_rad", [0.0, 0.2, -0.5])
def test_it_drives_the_curvature_that_the_navigator_expects(friction, steering_rad):
    simulator = pioneer.simulator(world(friction=friction), 0, frozenset({"lidar_deck"}))
    drive(simulator, 4.0, steering_rad=steering_rad, throttle=0.5)
    rate, speed = simulator.plant.imu()[0][2], simulator.plant.speed_mps
    assert speed == pytest.approx(0.35, rel=0.04)
    expected = curvature(steering_rad, TABLE.steering)
    assert rate / speed == pytest.approx(expected, rel=0.06, abs=0.01)


def test_a_touch_is_told_by_its_owner():
    simulator = pioneer.simulator(world(POST), 0)
    touched = set()
    for _ in range(300):
        simulator.advance(targets(simulator.time_ns, throttle=1.0))
        touched.update(simulator.truth().contacts)
    assert touched == {"post"}


def test_it_says_what_it_measures():
    heard = drive(pioneer.simulator(world(POST), 0), 3.0, throttle=0.5)
    scan = [m for m in heard if isinstance(m, LidarScan)][-1]
    assert scan.sensor == "lidar_deck"
    assert scan.range_m.min() < 2.0
    wheels = [m for m in heard if isinstance(m, VehicleState)][-1].wheel_speed_mps
    assert wheels == pytest.approx([0.35] * 6, abs=0.03)


def test_deterministic_and_picklable_in_the_middle():
    one, other = pioneer.simulator(world(POST), 3), pioneer.simulator(world(POST), 3)
    drive(one, 1.0, steering_rad=0.2, throttle=0.5)
    drive(other, 1.0, steering_rad=0.2, throttle=0.5)
    other = pickle.loads(pickle.dumps(other))
    for a, b in zip(drive(one, 1.0, throttle=0.4), drive(other, 1.0, throttle=0.4), strict=True):
        assert encode(a) == encode(b)
    assert (one.plant.data.qpos == other.plant.data.qpos).all()
