"""The ground is a pure function; its window scrolls, and MuJoCo sees the same heights."""

import pickle

import mujoco
import numpy as np
import pytest

from twin.terrain import GENTLE, HEIGHT_STEP_M, Banks, Octave, RollingGround, TerrainWindow

PASS = Banks(((0.0, 0.0), (40.0, 0.0), (60.0, 10.0)), 2.0, (0.5, 0.4), 2.5)


@pytest.fixture
def ground():
    return RollingGround(7)


def grid(width_m=200.0, step_m=0.5):
    x = np.arange(0.0, width_m, step_m)
    return np.meshgrid(x, x)


def test_the_same_place_has_the_same_height_however_it_is_asked(ground):
    x, y = grid(40.0)
    whole = ground.height(x, y)
    single = [ground.height(np.array(a), np.array(b)) for a, b in zip(x.flat, y.flat, strict=True)]
    assert (whole.ravel() == np.array(single)).all()
    assert (whole == RollingGround(7).height(x[0][None], y[:, :1])).all()


def test_another_seed_is_another_ground(ground):
    x, y = grid(40.0)
    assert (ground.height(x, y) != RollingGround(8).height(x, y)).mean() > 0.99


def test_the_ground_is_gentle(ground):
    x, y = grid(400.0)
    slope = np.hypot(*np.gradient(ground.height(x, y), 0.5))
    assert np.percentile(slope, 99) < 0.04
    assert slope.mean() > 0.003


def test_the_ground_has_no_steps(ground):
    x = np.arange(-30.0, 30.0, 0.001)
    assert np.abs(np.diff(ground.height(x, 0.3 * x))).max() < 1e-4


def test_banks_rise_on_both_sides_and_leave_the_track_flat():
    x, y = np.array([20.0] * 5), np.array([0.0, 1.9, 4.0, -4.0, 30.0])
    assert PASS.height(x, y) == pytest.approx([0.0, 0.0, 1.0, 0.8, 0.0])


def test_banks_begin_and_end_gently():
    x = np.array([-1.0, 0.0, 5.0, 10.0])
    assert PASS.height(x, np.full(4, 4.0)) == pytest.approx([0.0, 0.0, 0.5, 1.0])
    assert PASS.height(np.array([61.0, 58.0]), np.array([15.0, 14.0])).max() < 0.6


def test_banks_stand_on_the_rolling_ground():
    bare, banked = RollingGround(7), RollingGround(7, GENTLE, (PASS,))
    x, y = np.array([20.0, 20.0]), np.array([0.0, 4.0])
    assert banked.height(x, y) - bare.height(x, y) == pytest.approx([0.0, 1.0], abs=1e-5)


def test_heights_are_exact_in_a_height_field(ground):
    x, y = grid()
    z = ground.height(x, y)
    assert (z == np.round(z / HEIGHT_STEP_M) * HEIGHT_STEP_M).all()


def test_a_window_that_scrolled_equals_a_new_one(ground):
    window = TerrainWindow(ground, 3.0, -2.0)
    for x, y in (
        (12.0, -2.0),
        (12.0, 9.0),
        (1.0, 0.0),
        (-9.0, -12.0),
        (500.0, 300.0),
        (491.0, 310.0),
    ):
        assert window.recenter(x, y)
        fresh = TerrainWindow(ground, x, y)
        assert (window.z == fresh.z).all()
        assert (window.x0, window.y0) == (fresh.x0, fresh.y0)


def test_a_window_stays_while_the_vehicle_is_near_its_centre(ground):
    window = TerrainWindow(ground, 0.0, 0.0)
    before = window.z.copy()
    assert not window.recenter(8.0, -8.0)
    assert (window.z == before).all()


def test_a_window_computes_only_what_is_new(ground):
    class Counting:
        asked = 0

        def height(self, x, y):
            Counting.asked += np.broadcast(x, y).size
            return ground.height(x, y)

    window = TerrainWindow(Counting(), 0.0, 0.0)
    Counting.asked = 0
    window.recenter(10.0, 0.0)
    assert Counting.asked == 20 * window.size


def test_the_window_says_where_its_heights_are(ground):
    window = TerrainWindow(ground, 33.3, -71.9)
    row, column = 17, 300
    x, y = window.x0 + column * window.spacing, window.y0 + row * window.spacing
    assert window.z[row, column] == ground.height(np.array(x), np.array(y))
    assert window.z.shape == (window.size, window.size)
    assert window.x0 % window.spacing == 0.0


def test_a_window_pickles(ground):
    window = TerrainWindow(ground, 5.0, 5.0)
    window.recenter(20.0, 5.0)
    again = pickle.loads(pickle.dumps(window))
    assert again.recenter(40.0, 5.0) == window.recenter(40.0, 5.0)
    assert (again.z == window.z).all()


FIELD = """<mujoco>
  <asset><hfield name="terrain" nrow="65" ncol="65" size="16 16 32 1"/></asset>
  <worldbody><body name="terrain_window" mocap="true">
    <geom name="terrain" type="hfield" hfield="terrain"/></body></worldbody>
</mujoco>"""


def seen_by_mujoco(model, data, x, y):
    """Height of the field's vertex at (x, y), computed as MuJoCo does."""
    origin = data.mocap_pos[0]
    radius_x, radius_y, top, _ = model.hfield_size[0]
    column = round((x - origin[0] + radius_x) / (2 * radius_x) * 64)
    row = round((y - origin[1] + radius_y) / (2 * radius_y) * 64)
    return origin[2] + model.hfield_data[row * 65 + column] * top


def test_mujoco_sees_the_very_same_heights(ground):
    model = mujoco.MjModel.from_xml_string(FIELD)
    data = mujoco.MjData(model)
    window = TerrainWindow(ground, 0.0, 0.0)
    for x, y in ((0.0, 0.0), (400.0, -250.0)):
        window.recenter(x, y)
        window.write_hfield(model, data)
        for px, py in ((x - 16.0, y - 16.0), (x + 16.0, y + 3.5), (x + 0.5, y + 16.0)):
            height = ground.height(np.array(px), np.array(py))
            assert float(seen_by_mujoco(model, data, px, py)) == height


def test_mujocos_ray_meets_the_same_ground(ground):
    model = mujoco.MjModel.from_xml_string(FIELD)
    data = mujoco.MjData(model)
    window = TerrainWindow(ground, 120.0, 60.0)
    window.write_hfield(model, data)
    mujoco.mj_forward(model, data)
    up = np.array([119.5 + 1e-6, 63.0 + 1e-6, 50.0])
    hit = np.zeros(1, np.int32)
    distance = mujoco.mj_ray(model, data, up, np.array([0.0, 0, -1]), None, 1, -1, hit)
    assert 50.0 - distance == pytest.approx(ground.height(*up[:2]), abs=1e-5)


def test_too_steep_a_ground_is_refused():
    window = TerrainWindow(RollingGround(1, (Octave(16.0, 400.0),)), 0.0, 0.0)
    with pytest.raises(ValueError, match="relief"):
        window.write_heights(mujoco.MjModel.from_xml_string(FIELD))
