import pickle
from math import tan
from pathlib import Path

import mujoco
import numpy as np
import pytest

import models
from nav.messages import ActuatorTargets, Gear
from twin import clock
from twin.linkage import GearboxParameters
from twin.plant import Plant
from twin.vehicle import PIVOT_M, SIDES, STEERING_LIMIT_RAD, linkage

CIRCLE = (
    Path(__file__).parents[2] / "shared" / "data" / "polaris6x6_turning_circle_overbot_20050414.csv"
)
CIRCLE_MPS = 2.0
"""A walk: 0.7 m/s^2 sideways on the tightest circle, a tenth of what the ground gives."""


def flat(friction=0.7, things=(), tilt_rad=0.0):
    """The vehicle on a plane, with boxes `(name, center, half size)` on it."""
    spec = mujoco.MjSpec.from_file(models.path())
    spec.worldbody.add_geom(
        name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], friction=[friction, 0, 0]
    )
    for name, center, half in things:
        spec.worldbody.add_geom(
            name=name, type=mujoco.mjtGeom.mjGEOM_BOX, pos=center, size=half, group=1
        )
    model = spec.compile()
    model.opt.gravity[:] = (-9.81 * np.sin(tilt_rad), 0.0, -9.81 * np.cos(tilt_rad))
    return model


def bumpy():
    n = 65
    x = np.linspace(0.0, 32.0, n)
    z = 0.1 * (2.0 + np.sin(0.5 * x[:, None]) + np.cos(0.4 * x[None, :]))
    spec = mujoco.MjSpec.from_file(models.path())
    spec.add_hfield(name="t", nrow=n, ncol=n, size=[16, 16, 1, 0.5], userdata=z.ravel().tolist())
    spec.worldbody.add_geom(
        name="terrain", type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="t", friction=[0.7, 0, 0]
    )
    return spec.compile()


def plant(model=None, heading=0.0, **options):
    return Plant(model or flat(), (0.0, 0.0, 0.0, heading), 0, **options)


def drive(plant, seconds, steering_rad=0.0, throttle=0.0, brake=0.0, gear=Gear.HIGH):
    for _ in range(round(seconds * 50)):
        now = clock.time_ns(plant.k)
        plant.apply(now, ActuatorTargets(now, steering_rad, throttle, brake, gear))
        for _ in range(6):
            plant.step()


def cruise(plant, seconds, speed_mps, steering_rad=0.0):
    """A plain speed controller; mean curvature of the last second."""
    integral, curvature = 0.0, []
    for tick in range(round(seconds * 50)):
        error = speed_mps - plant.speed_mps
        integral = float(np.clip(integral + 0.02 * error, -2.0, 2.0))
        throttle = float(np.clip(0.5 * error + 0.2 * integral, 0.0, 1.0))
        drive(plant, 0.02, steering_rad, throttle)
        if tick >= seconds * 50 - 50:
            curvature.append(plant.imu()[0][2] / plant.speed_mps)
    return float(np.mean(curvature))


def measured_curvature(steering_rad):
    """Curvature [1/m] of the measured vehicle: steer fraction = 8.174 k - 13.82 k^2."""
    fraction = steering_rad / 0.576
    return (8.174 - np.sqrt(8.174**2 - 4 * 13.82 * fraction)) / (2 * 13.82)


def test_starts_where_it_is_told_and_stays():
    p = Plant(flat(), (3.0, -2.0, 0.0, 0.7), 0)
    drive(p, 2.0, brake=1.0)
    truth = p.truth()
    assert truth.time_ns == 2 * 10**9
    assert truth.position_m == pytest.approx([3.0, -2.0, 0.0], abs=0.005)
    assert truth.heading_rad == pytest.approx(0.7, abs=1e-3)
    assert truth.contacts == ()
    assert truth.tire_center_m.shape == (6, 3)


def test_imu_at_rest_feels_gravity_upwards():
    p = plant()
    drive(p, 1.0)
    rate, force = p.imu()
    assert rate == pytest.approx(np.zeros(3), abs=1e-3)
    assert force == pytest.approx([0.0, 0.0, 9.81], abs=0.02)


def test_top_speed_and_acceleration():
    p = plant(flat(0.8))
    while p.speed_mps < 11.18 and p.k < 20 * 300:
        drive(p, 0.1, throttle=1.0)
    assert p.k / 300 < 12.0
    drive(p, 30.0, throttle=1.0)
    assert p.speed_mps == pytest.approx(17.9, rel=0.15)
    assert p.truth().position_m[1] == pytest.approx(0.0, abs=0.05)


def test_full_brake():
    p = plant(flat(0.8))
    while p.speed_mps < 10.0:
        drive(p, 0.02, throttle=1.0)
    drive(p, 0.5, brake=1.0)
    first, k = p.speed_mps, p.k
    while p.speed_mps > 1.0:
        drive(p, 0.02, brake=1.0)
    assert 4.0 < (first - p.speed_mps) * 300 / (p.k - k) < 6.0
    drive(p, 2.0, brake=1.0)
    assert abs(p.speed_mps) < 1e-3


@pytest.mark.parametrize(
    ("steering_rad", "speed_mps"), [(0.06, 3.0), (0.288, 3.0), (-0.43, 3.0), (0.5, 4.0)]
)
def test_turns_like_the_measured_vehicle(steering_rad, speed_mps):
    wanted = np.sign(steering_rad) * measured_curvature(abs(steering_rad))
    assert cruise(plant(), 5.0, speed_mps, steering_rad) == pytest.approx(wanted, rel=0.05)


@pytest.mark.skipif(
    not CIRCLE.is_file(), reason=f"{CIRCLE} is not here: real data is not committed"
)
def test_drives_the_measured_circles():
    points = np.genfromtxt(CIRCLE, delimiter=",", names=True)
    assert len(points) == 10
    for fraction, radius_m, _ in points.tolist():
        driven = 1.0 / cruise(plant(), 5.0, CIRCLE_MPS, fraction * STEERING_LIMIT_RAD)
        assert driven == pytest.approx(radius_m, rel=0.03), fraction


def without_grip(axle):
    """The flat world; the tires of one axle only bear load."""
    model = flat()
    model.geom("ground").condim = 1  # the larger one of ground and tire rules
    for side in SIDES:
        model.geom(f"{axle}_{side}_tire").condim = 1
    return model


def test_the_circle_comes_from_three_axles():
    """Where the steering points, two axles go; three scrub, and go round a wider circle."""
    three, front_rear, front_middle = (
        cruise(plant(m), 5.0, CIRCLE_MPS, 0.4)
        for m in (flat(), without_grip("middle"), without_grip("rear"))
    )
    assert tan(linkage(0.4)) / front_rear == pytest.approx(PIVOT_M, rel=0.03)
    assert front_rear > 1.01 * three
    assert front_middle > 2.0 * three


def test_full_lock_circle():
    assert 1.0 / cruise(plant(), 7.0, 2.0, 0.576) == pytest.approx(5.8, rel=0.1)


def test_turns_alike_in_any_direction():
    one, other = (cruise(plant(heading=h), 5.0, 3.0, 0.3) for h in (0.0, 0.8))
    assert one == pytest.approx(other, rel=0.02)


def test_holds_on_a_slope_with_the_brake_and_rolls_without():
    p = plant(flat(0.8, tilt_rad=np.radians(10.0)))
    drive(p, 2.0, brake=1.0)
    held = p.truth().position_m[0]
    drive(p, 3.0, brake=1.0)
    assert p.truth().position_m[0] == pytest.approx(held, abs=0.01)
    drive(p, 3.0, gear=Gear.NEUTRAL)
    assert p.speed_mps < -1.0


def test_stands_in_gear_with_the_throttle_closed():
    p = plant()
    drive(p, 5.0)
    assert abs(p.speed_mps) < 1e-3


def test_reverse_after_the_shift():
    p = plant(gearbox=GearboxParameters(shift_s_per_position=0.7, shift_sigma=0.0, try_again=0.0))
    drive(p, 1.2, gear=Gear.REVERSE, brake=0.5)
    assert p.applied.shifting
    drive(p, 1.2, gear=Gear.REVERSE, brake=0.5)
    assert (p.applied.gear, p.applied.shifting) == (Gear.REVERSE, False)
    drive(p, 3.0, gear=Gear.REVERSE, throttle=0.4)
    assert p.speed_mps < -1.0
    assert (p.wheel_speed_radps < -2.0).all()


def test_stops_when_commands_stop():
    p = plant()
    drive(p, 4.0, throttle=0.6)
    assert p.speed_mps > 3.0
    for _ in range(900):
        p.step()
    assert abs(p.speed_mps) < 0.01


def test_wheels_turn_with_the_ground():
    p = plant()
    cruise(p, 5.0, 4.0)
    assert 0.3175 * p.wheel_speed_radps == pytest.approx(np.full(6, p.speed_mps), rel=0.03)


def test_sites_move_with_the_vehicle():
    p = plant(heading=0.5)
    position, rotation = p.site_pose("lidar_bumper")
    ahead = np.array([np.cos(0.5), np.sin(0.5), 0.0])
    assert position == pytest.approx(2.05 * ahead + [0, 0, 0.55], abs=1e-3)
    assert rotation[:, 0] == pytest.approx(ahead, abs=1e-3)
    drive(p, 2.0, throttle=0.5)
    before = p.site_pose("gps")[0]
    p.step()
    linear, angular = p.site_velocity("gps")
    assert (p.site_pose("gps")[0] - before) * 300 == pytest.approx(linear, abs=0.03)
    assert angular == pytest.approx(np.zeros(3), abs=0.05)


def test_contacts_are_told_by_owner_once():
    things = [
        ("car_body", (6.0, 0.0, 0.7), (0.5, 1.0, 0.5)),
        ("strip", (4.0, 0.0, 0.02), (0.1, 2.0, 0.02)),
    ]
    p = plant(flat(0.7, things), owners={"car_body": "car", "strip": ""})
    drive(p, 1.5, throttle=0.4)
    assert p.truth().contacts == ()
    drive(p, 4.0, throttle=0.4)
    assert p.truth().contacts == ("car",)
    drive(p, 2.0, brake=1.0)
    p.truth()
    drive(p, 8.0, gear=Gear.REVERSE, brake=1.0)
    drive(p, 2.0, gear=Gear.REVERSE, throttle=0.5)
    p.truth()
    p.step()
    assert p.truth().contacts == ()


def test_chassis_on_the_ground_is_told():
    p = plant()
    p.data.qpos[2] = 0.1
    p.data.qpos[3:7] = (np.cos(np.pi / 4), np.sin(np.pi / 4), 0.0, 0.0)  # on its side
    drive(p, 1.0)
    assert p.truth().contacts == ("ground",)


def test_rides_over_a_heightfield():
    p = Plant(bumpy(), (-10.0, 0.0, 0.2, 0.0), 0)
    drive(p, 1.0, brake=1.0)
    assert abs(p.truth().roll_rad) < 0.2
    drive(p, 4.0, throttle=0.5)
    assert p.truth().position_m[0] > -5.0
    assert p.truth().contacts == ()
    assert not any(w.number for w in p.data.warning)


@pytest.mark.parametrize("world", [flat, bumpy])
def test_goes_on_with_the_same_bits_after_a_pickle(world):
    p = Plant(world(), (-8.0, 0.0, 0.2, 0.1), 3)
    drive(p, 1.5, steering_rad=0.2, throttle=0.6)
    q = pickle.loads(pickle.dumps(p))
    for each in (p, q):
        drive(each, 2.0, steering_rad=-0.3, brake=0.3, gear=Gear.LOW)
    assert p.data.qpos.tobytes() == q.data.qpos.tobytes()
    assert p.data.qvel.tobytes() == q.data.qvel.tobytes()
    assert p.applied == q.applied
    assert p.truth().tire_center_m.tobytes() == q.truth().tire_center_m.tobytes()


def test_a_world_without_the_vehicle_is_refused():
    empty = mujoco.MjSpec().compile()
    with pytest.raises(KeyError, match="ranger_free"):
        Plant(empty, (0.0, 0.0, 0.0, 0.0), 0)
