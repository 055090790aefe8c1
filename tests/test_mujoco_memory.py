"""MuJoCo's structs are where we think, in any model; if not, that is said."""

import ctypes

import mujoco
import pytest

import models
from twin import mujoco_memory


def word(instance, index):
    return ctypes.c_int64.from_address(instance._address + index * mujoco_memory.WORD).value


def test_the_fields_are_there_in_another_model_too():
    model = mujoco.MjModel.from_xml_path(models.path())
    data = mujoco.MjData(model)
    at = mujoco_memory.words()
    assert word(model, at.nuser_geom) == model.nuser_geom
    for name in ("geom_user", "geom_size", "geom_dataid"):
        assert word(model, getattr(at, name)) == getattr(model, name).ctypes.data
    for name in ("geom_xpos", "geom_xmat"):
        assert word(data, getattr(at, name)) == getattr(data, name).ctypes.data


def test_another_layout_is_refused(monkeypatch):
    fields = mujoco_memory.STRUCTS["mjModel"].fields
    monkeypatch.setattr(mujoco_memory.STRUCTS["mjModel"], "fields", fields[1:])
    with pytest.raises(RuntimeError, match=r"mjModel\.nuser_geom is not where"):
        mujoco_memory.words()


def test_another_contact_is_refused(monkeypatch):
    fields = mujoco_memory.STRUCTS["mjPreContact"].fields
    monkeypatch.setattr(mujoco_memory.STRUCTS["mjPreContact"], "fields", fields[::-1])
    with pytest.raises(RuntimeError, match="mjPreContact"):
        mujoco_memory.words()


def test_the_table_is_the_one_in_use():
    table = mujoco_memory.collision_table()
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><geom type='plane' size='1 1 1'/>"
        "<body><freejoint/><geom size='1'/></body></worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.ncon == 1
    before, table[0][2] = table[0][2], None  # no function: MuJoCo leaves such pairs alone
    try:
        mujoco.mj_forward(model, data)
        assert data.ncon == 0
    finally:
        table[0][2] = before
