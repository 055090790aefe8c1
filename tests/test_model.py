from pathlib import Path

import mujoco
import numpy as np
import pytest

import models
from nav.parameters.loader import from_toml
from nav.parameters.vehicle import VehicleParameters
from twin import vehicle

TOML = Path(__file__).parents[1] / "nav" / "parameters" / "vehicle.toml"
TABLE = from_toml(VehicleParameters, TOML.read_text(), "vehicle.toml")


@pytest.fixture
def model():
    return mujoco.MjModel.from_xml_path(str(Path(models.path()).parent / "scene.xml"))


@pytest.fixture
def parked(model):
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("parked").id)
    mujoco.mj_forward(model, data)
    return data


def axes(yaw, pitch, roll):
    """Rotation Rz(yaw) Ry(pitch) Rx(roll): x looks along the sensor, pitch positive nose down."""
    cy, sy, cp, sp, cr, sr = (f(a) for a in (yaw, pitch, roll) for f in (np.cos, np.sin))
    return (
        np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
        @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
        @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    )


def mounts():
    for name, m in TABLE.lidar_mounts.items():
        yield name, m.position_m, (m.yaw_rad, m.pitch_rad, m.roll_rad)
    for name, m in TABLE.sonar_mounts.items():
        yield f"sonar_{name}", m.position_m, (m.yaw_rad, 0.0, 0.0)
    for name, m in TABLE.radars.items():
        yield name, m.position_m, (m.yaw_rad, 0.0, 0.0)
    yield "gps", TABLE.gps_position_m, (0.0, 0.0, 0.0)
    yield "imu", TABLE.imu_position_m, (0.0, 0.0, 0.0)
    yield "reference", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


def test_everything_has_a_name():
    model = mujoco.MjModel.from_xml_path(models.path())
    for kind in ("body", "geom", "jnt", "site", "actuator", "sensor", "key"):
        names = [getattr(model, {"jnt": "joint"}.get(kind, kind))(i).name
                 for i in range(getattr(model, f"n{kind}"))]  # fmt: skip
        assert all(names), kind


def test_solver_is_the_measured_one(model):
    assert model.opt.timestep == 1 / 300
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    assert model.opt.solver == mujoco.mjtSolver.mjSOL_NEWTON
    assert model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
    assert model.opt.impratio == 0.2
    assert (model.opt.iterations, model.opt.tolerance) == (20, 1e-6)


def test_the_vehicle_never_sleeps(model, parked):
    assert model.tree_sleep_policy.tolist() == [mujoco.mjtSleepPolicy.mjSLEEP_NEVER]
    for _ in range(900):
        mujoco.mj_step(model, parked)
    assert parked.tree_awake.all()


def test_mass_and_centre(model, parked):
    assert model.body("ranger").subtreemass[0] == pytest.approx(862 + 178)
    x, y, z = parked.body("ranger").subtree_com
    assert (x, y, z) == pytest.approx((0.683, 0.0, 0.62), abs=0.01)


def test_axles_track_and_wheels(model, parked):
    wheels = np.array([parked.body(f"{w}_wheel").xpos for w in vehicle.WHEELS])
    assert wheels[:, 0] == pytest.approx([1.70, 1.70, 0.59, 0.59, -0.59, -0.59])
    assert wheels[0, 0] == pytest.approx(TABLE.wheelbase_m)
    assert wheels[0::2, 1] - wheels[1::2, 1] == pytest.approx([TABLE.track_m] * 3)
    for name in vehicle.WHEELS:
        assert model.geom(f"{name}_tire").size[0] == TABLE.wheel_radius_m
    assert (TABLE.wheel_radius_m, TABLE.track_m) == (vehicle.WHEEL_RADIUS_M, vehicle.TRACK_M)


def test_steering_limit(model):
    assert TABLE.steering.limit_rad == vehicle.STEERING_LIMIT_RAD
    sharpest = max(vehicle.ackermann(vehicle.linkage(TABLE.steering.limit_rad)))
    for side in vehicle.SIDES:
        assert model.joint(f"front_{side}_steer").range[1] > sharpest


def test_collision_geoms_cover_the_outline(model):
    body = model.body("ranger").id
    chassis = [g for g in range(model.ngeom)
               if model.geom_bodyid[g] == body and model.geom_group[g] == 3]  # fmt: skip
    low = np.min(model.geom_pos[chassis] - model.geom_size[chassis], axis=0)
    high = np.max(model.geom_pos[chassis] + model.geom_size[chassis], axis=0)
    outline = TABLE.outline
    assert low == pytest.approx([outline.rear_m, -outline.half_width_m, 0.19])
    assert high == pytest.approx([outline.front_m, outline.half_width_m, 1.98])
    tire = model.geom("front_left_tire")
    assert 0.62 + tire.size[1] <= outline.half_width_m


@pytest.mark.parametrize(("name", "position", "angles"), list(mounts()))
def test_sites_are_where_the_navigator_thinks(model, name, position, angles):
    site = model.site(name)
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, site.quat)
    assert site.pos == pytest.approx(position)
    np.testing.assert_allclose(rotation.reshape(3, 3), axes(*angles), atol=1e-12)


def test_parked_is_at_rest(model, parked):
    before = parked.qpos.copy()
    assert abs(parked.body("ranger").xpos[2]) < 0.01
    for _ in range(600):
        mujoco.mj_step(model, parked)
    assert np.abs(parked.qpos - before).max() < 1e-3
    assert np.abs(parked.qvel).max() < 1e-3


def halton(index, base):
    value, fraction = 0.0, 1.0
    while index > 0:
        index, digit = divmod(index, base)
        fraction /= base
        value += fraction * digit
    return value


def test_random_controls_raise_no_warning(model, parked):
    bases = (2, 3, 5, 7, 11, 13, 17, 19)
    low, high = model.actuator_ctrlrange.T
    for k in range(600):
        if k % 10 == 0:
            parked.ctrl[:] = low + (high - low) * [halton(1 + k // 10, b) for b in bases]
        mujoco.mj_step(model, parked)
    assert np.isfinite(parked.qpos).all()
    assert not any(w.number for w in parked.warning)


def test_linkage_and_ackermann_are_odd_and_ordered():
    assert vehicle.linkage(-0.3) == -vehicle.linkage(0.3)
    left, right = vehicle.ackermann(0.3)
    assert left > 0.3 > right
    assert vehicle.ackermann(-0.3) == pytest.approx((-right, -left))
