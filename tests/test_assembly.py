"""The assembled model: ground, obstacles and the vehicle together."""

import mujoco
import numpy as np
import pytest

from twin.assembly import compile as assemble
from twin.assembly import owners
from twin.terrain import RollingGround, TerrainWindow
from twin.world import Obstacle, World

GROUND = RollingGround(2)
BALE = Obstacle("bale_left", "hay_bale", "box", (12.0, 3.0, 0.3), (0.5, 0.25, 0.4), owner="bale")
POST = Obstacle("post", "gate_post", "cylinder", (8.0, -3.0, 0.5), (0.1, 0.1, 0.7))
BRUSH = Obstacle("brush", "brush", "cylinder", (0.6, 0.0, 0.5), (0.5, 0.5, 0.6))
STRIP = Obstacle("strip", "rumble_strip", "box", (20.0, 0.0, 0.0), (0.05, 2.0, 0.03))


def world(*obstacles, friction=0.7):
    return World(GROUND, obstacles, friction, (34.0, -117.0), (0.0, 0.0, 0.0))


def assembled(*obstacles, friction=0.7):
    model = assemble(world(*obstacles, friction=friction), TerrainWindow(GROUND, 0.0, 0.0))
    return model, mujoco.MjData(model)


def settle(model, data, steps=300):
    data.qpos[2] = GROUND.height(np.array(0.0), np.array(0.0)) + 0.03
    mujoco.mj_step(model, data, steps)


def test_obstacles_become_static_geoms_of_the_same_name():
    model, data = assembled(BALE, POST)
    mujoco.mj_forward(model, data)
    for obstacle in (BALE, POST):
        geom = model.geom(obstacle.name)
        assert geom.bodyid[0] == 0
        assert geom.group[0] == 1
        assert data.geom(obstacle.name).xpos == pytest.approx(obstacle.center_m)
    assert model.geom("bale_left").size == pytest.approx(BALE.half_size_m)
    assert model.geom("post").size[:2] == pytest.approx((0.1, 0.7))


def test_the_vehicle_stands_on_the_ground_with_six_wheels():
    model, data = assembled()
    settle(model, data)
    touching = {model.geom(g).name for c in data.contact for g in c.geom}
    assert sum(name.endswith("_tire") for name in touching) == 6
    assert "terrain" in touching
    height = GROUND.height(*data.qpos[:2])
    assert data.qpos[2] - height == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize("friction", [0.5, 0.9])
def test_the_grounds_friction_rules(friction):
    model, data = assembled(friction=friction)
    settle(model, data)
    tires = [c for c in data.contact if "_tire" in model.geom(c.geom[1]).name]
    assert len(tires) >= 6
    assert all(c.friction[0] == pytest.approx(friction) for c in tires)


def test_the_vehicle_meets_an_obstacle_and_not_the_brush():
    wall = Obstacle("wall", "gate_flank", "box", (0.6, 0.0, 0.5), (0.2, 0.2, 0.6))
    for thing, meets in ((wall, True), (BRUSH, False)):
        model, data = assembled(thing)
        data.qpos[2] = 0.1
        mujoco.mj_forward(model, data)
        touching = {model.geom(g).name for c in data.contact for g in c.geom}
        assert (thing.name in touching) == meets


def test_owners_leave_out_what_may_be_touched():
    assert owners(world(BALE, POST, BRUSH, STRIP)) == {
        "bale_left": "bale", "post": "post", "brush": "", "strip": "",
    }  # fmt: skip


def test_an_unknown_shape_is_refused():
    cone = Obstacle("cone_1", "cone", "cone", (5.0, 0.0, 0.0), (0.1, 0.1, 0.1))
    with pytest.raises(ValueError, match="cone_1: shape 'cone', expected one of box, cylinder"):
        assembled(cone)


def test_what_stands_still_is_where_it_should_be_after_the_window_has_scrolled():
    window = TerrainWindow(GROUND, 0.0, 0.0)
    model = assemble(world(BALE, POST), window)
    data = mujoco.MjData(model)
    settle(model, data)
    assert window.recenter(10.0, 5.0)
    window.write_hfield(model, data)
    mujoco.mj_step(model, data, 2)
    assert data.geom("terrain").xpos == pytest.approx(window.contact_origin_m, abs=1e-12)
    assert data.geom("post").xpos == pytest.approx(POST.center_m)
    assert sum("_tire" in model.geom(c.geom[1]).name for c in data.contact) >= 6
