"""Our contacts of a tire with a height field are MuJoCo's, within tolerances."""

import multiprocessing
import pickle

import mujoco
import numpy as np
import pytest
from test_plant import bumpy, drive, flat

from twin import tire_collision
from twin.plant import Plant
from twin.tire_collision import stock

CELLS, HALF_M = 32, 8.0
TIRE_M = (0.3175, 0.142, 0.3175)
tire_collision.install()


class OneTire:
    """A tire that floats above random ground, rough by `rough_m` from vertex to vertex."""

    def __init__(self, rough_m, seed=0, tilt=(1.0, 0.0, 0.0, 0.0), user=tire_collision.TIRE):
        self.rng = np.random.default_rng(seed)
        spec = mujoco.MjSpec()
        n = CELLS + 1
        spec.add_hfield(name="f", nrow=n, ncol=n, size=[HALF_M, HALF_M, 1, 1], userdata=[0] * n**2)
        spec.worldbody.add_geom(
            type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="f", pos=[0.3, -0.2, 0.5], quat=tilt
        )
        body = spec.worldbody.add_body()
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_ELLIPSOID, size=TIRE_M, userdata=[user])
        self.model = spec.compile()
        self.model.hfield_data[:] = self.rng.uniform(0.0, rough_m, n**2)
        self.data = mujoco.MjData(self.model)

    def contacts(self, x, y, z, quat=(1.0, 0.0, 0.0, 0.0)):
        """Distances (n,) [m], positions (n, 3) [m] and normals (n, 3), as they are stored."""
        self.data.qpos[:] = (x, y, z, *quat)
        mujoco.mj_fwdPosition(self.model, self.data)
        found = self.data.contact
        return found.dist.copy(), found.pos.copy(), found.frame[:, :3].copy()

    def touching(self, depth_m):
        """A random pose in which the deepest contact is about `depth_m` deep."""
        x, y = self.rng.uniform(-6.0, 6.0, 2)
        quat = np.zeros(4)
        yaw, camber, spin = self.rng.normal(0.0, (2.0, 0.1, 2.0))
        mujoco.mju_euler2Quat(quat, (yaw, camber, spin), "zxy")
        high = next(z for z in np.arange(4.0, -4.0, -0.1) if len(self.contacts(x, y, z, quat)[0]))
        low, high = high, high + 0.1
        for _ in range(30):
            middle = 0.5 * (low + high)
            touches = len(self.contacts(x, y, middle, quat)[0]) > 0
            low, high = (middle, high) if touches else (low, middle)
        return x, y, high - depth_m, quat


TILTED = (np.cos(0.1), np.sin(0.1), 0.0, 0.0)


@pytest.mark.parametrize("tilt", [(1.0, 0.0, 0.0, 0.0), TILTED], ids=["level", "tilted"])
@pytest.mark.parametrize("rough_m", [0.0, 0.03, 0.3])
def test_contacts_are_those_of_mujoco(rough_m, tilt):
    tire = OneTire(rough_m, tilt=tilt)
    several = 0
    for k in range(200):
        pose = tire.touching((0.001, 0.003, 0.01)[k % 3])
        ours = tire.contacts(*pose)
        with stock():
            theirs = tire.contacts(*pose)
        several += len(ours[0]) > 1
        assert len(ours[0]) == len(theirs[0]) > 0
        for mine, other, tolerance in zip(ours, theirs, (3e-4, 8e-3, 0.1), strict=True):
            np.testing.assert_allclose(mine, other, rtol=0.0, atol=tolerance)
        if len(ours[0]) == 1 and abs(ours[2] @ theirs[2].T) > 1.0 - 1e-9:  # a face, no edge
            assert ours[0] == pytest.approx(theirs[0], abs=1e-5)
            np.testing.assert_allclose(ours[1], theirs[1], rtol=0.0, atol=1e-3)
    assert several > 50


def test_no_contact_where_there_is_a_gap():
    tire = OneTire(0.0)
    ground_m = 0.5 + TIRE_M[2]
    assert len(tire.contacts(0.1, 0.2, ground_m + 1e-9)[0]) == 0
    distance, position, normal = tire.contacts(0.1, 0.2, ground_m - 1e-6)
    assert distance == pytest.approx([-1e-6], abs=1e-12)
    assert position == pytest.approx(np.array([[0.1, 0.2, 0.5 - 0.5e-6]]), abs=1e-12)
    assert normal == pytest.approx(np.array([[0.0, 0.0, 1.0]]), abs=1e-12)
    assert len(tire.contacts(0.3 + HALF_M + 0.33, 0.0, ground_m - 0.1)[0]) == 0
    assert len(tire.contacts(50.0, -50.0, ground_m - 0.1)[0]) == 0


def test_what_is_not_a_number_touches_nothing():
    tire = OneTire(0.1)
    assert len(tire.contacts(np.nan, 0.0, 0.8)[0]) == 0
    assert len(tire.contacts(1e300, -1e300, 0.8)[0]) == 0


def test_the_depth_does_not_jump_while_a_tire_is_moved():
    tire = OneTire(0.3)
    depths = [-min(tire.contacts(x, 0.1, 0.85)[0], default=0.0) for x in np.arange(-5, 5, 0.001)]
    assert max(depths) > 0.05
    assert np.abs(np.diff(depths)).max() < 1e-3


def same_bits(a, b):
    return all(x.tobytes() == y.tobytes() for x, y in zip(a, b, strict=True))


def test_an_ellipsoid_that_is_no_tire_is_left_to_mujoco():
    tire = OneTire(0.1, user=1.0)
    for _ in range(20):
        pose = tire.touching(0.003)
        here = tire.contacts(*pose)
        with stock():
            assert same_bits(here, tire.contacts(*pose))


def test_a_tire_deep_in_the_ground_is_left_to_mujoco():
    tire = OneTire(0.1)
    here = tire.contacts(1.1, 0.7, 0.45)
    assert here[0].min() < -0.2
    with stock():
        assert same_bits(here, tire.contacts(1.1, 0.7, 0.45))


def test_same_pose_same_bits():
    tire, again = OneTire(0.1), OneTire(0.1)
    for _ in range(20):
        pose = tire.touching(0.003)
        assert same_bits(tire.contacts(*pose), again.contacts(*pose))


def driven(pickled):
    """The state after two more seconds."""
    p = pickle.loads(pickled)
    drive(p, 2.0, steering_rad=-0.2, throttle=0.4)
    return p.data.qpos.tobytes() + p.data.qvel.tobytes()


def test_a_pickled_plant_goes_on_with_the_same_bits_in_another_process():
    p = Plant(bumpy(), (-8.0, 0.0, 0.2, 0.1), 3)
    drive(p, 1.0, throttle=0.6)
    pickled = pickle.dumps(p)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply(driven, (pickled,)) == driven(pickled)


def test_the_vehicle_rides_as_on_mujocos_contacts():
    def ride(user):
        model = bumpy()
        model.geom_user[:] = user
        p = Plant(model, (-10.0, 0.0, 0.8, 0.0), 0)
        states = []
        for _ in range(250):
            drive(p, 0.02, steering_rad=0.1, throttle=0.4)
            states.append(p.data.qpos[:7].copy())
        return np.array(states)

    ours, theirs = ride(tire_collision.TIRE), ride(0.0)
    assert np.ptp(ours[:, 2]) > 0.1
    assert np.abs(ours[:, 2] - theirs[:, 2]).max() < 1e-3
    assert np.abs(ours - theirs).max() < 0.05


def test_on_a_height_field_it_turns_as_on_a_plane():
    def circle(model):
        p = Plant(model, (0.0, 0.0, 0.0, 0.0), 0)
        drive(p, 3.0, steering_rad=0.3, throttle=0.3)
        return p.data.qpos[:2].copy()

    level = bumpy()
    level.hfield_data[:] = 0.0
    assert circle(level) == pytest.approx(circle(flat()), abs=0.02)
