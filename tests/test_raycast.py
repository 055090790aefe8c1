"""The ray caster against MuJoCo's mj_ray, and its own promises."""

import pickle

import mujoco
import numpy as np
import pytest

from twin.raycast import GROUND, NO_HIT, Scene, cast, cast_hits, hide
from twin.world import Obstacle

MAX_RANGE_M = 81.92
SPACING_M = 0.5
POINTS = 65
HALF_M = 0.5 * (POINTS - 1) * SPACING_M
RAYS = 12_000


def heights_m(bump_m: float, points: int = POINTS) -> np.ndarray:
    """Shape (points, points): bumpy ground, values that float32 holds exactly."""
    rng = np.random.default_rng(3)
    x = np.arange(points) * SPACING_M
    z = np.sin(x[None, :] / 3.0) * np.cos(x[:, None] / 4.0) + rng.normal(0.0, 0.1, (points, points))
    z = (z - z.min()) / np.ptp(z)
    return bump_m * z.astype(np.float32).astype(np.float64)


def random_obstacles(count: int) -> list[Obstacle]:
    """Boxes and cylinders of all sizes in any orientation, on and above the ground."""
    rng = np.random.default_rng(4)
    shapes = ["box", "cylinder"]
    return [
        Obstacle(
            f"thing_{i}", "car", shapes[i % 2],
            tuple(rng.uniform((-14.0, -14.0, 0.0), (14.0, 14.0, 3.0))),
            tuple(rng.uniform(0.1, 1.5, 3)), tuple(rng.normal(size=4)),
        )
        for i in range(count)
    ]  # fmt: skip


def tunnel(length_m: float = 20.0) -> list[Obstacle]:
    """Two walls and a roof about the x axis, bent a little as the real one."""
    quat = (np.cos(0.03), 0.0, 0.0, np.sin(0.03))
    sides = [
        ((0.0, 1.7, 1.5), (length_m / 2, 0.05, 1.5)),
        ((0.0, -1.7, 1.5), (length_m / 2, 0.05, 1.5)),
    ]
    return [
        Obstacle(f"tunnel_{i}", "tunnel", "box", center, size, quat)
        for i, (center, size) in enumerate([*sides, ((0.0, 0.0, 3.05), (length_m / 2, 1.75, 0.05))])
    ]  # fmt: skip


def half_width_m(z: np.ndarray) -> float:
    return 0.5 * (len(z) - 1) * SPACING_M


def mujoco_model(z: np.ndarray, obstacles: list[Obstacle]) -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    top, half = float(z.max()), half_width_m(z)
    spec.add_hfield(
        name="ground", size=[half, half, top, 0.1], nrow=len(z), ncol=len(z),
        userdata=(z / top).astype(np.float32).ravel(),
    )  # fmt: skip
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="ground")
    kinds = {"box": mujoco.mjtGeom.mjGEOM_BOX, "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER}
    for o in obstacles:
        size = (o.half_size_m[0], o.half_size_m[2], 0.0) if o.shape == "cylinder" else o.half_size_m
        spec.worldbody.add_geom(
            name=o.name, type=kinds[o.shape], pos=o.center_m, size=size, quat=o.quat
        )
    return spec.compile()


def mj_ranges_m(model: mujoco.MjModel, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    geom = np.zeros(1, np.int32)
    found = np.array(
        [
            mujoco.mj_ray(model, data, o, d, None, 1, -1, geom)
            for o, d in zip(origins, directions, strict=True)
        ]
    )
    return np.where((found < 0.0) | (found > MAX_RANGE_M), MAX_RANGE_M, found)


def scene_of(z: np.ndarray, obstacles: list[Obstacle]) -> Scene:
    scene = Scene(obstacles)
    scene.set_ground(z, -half_width_m(z), -half_width_m(z), SPACING_M)
    return scene


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


SCENES = {
    "open terrain": (1.5, [], (-10.0, -10.0, 1.51), (10.0, 10.0, 2.5), 0.15),
    "field": (0.5, random_obstacles(40), (-12.0, -12.0, 0.6), (12.0, 12.0, 4.0), 0.3),
    "tunnel": (0.05, tunnel(), (-9.0, -1.0, 0.2), (9.0, 1.0, 2.8), 0.3),
}


@pytest.mark.parametrize("name", SCENES)
def test_agrees_with_mj_ray(name):
    bump_m, obstacles, low, high, steepness = SCENES[name]
    rng = np.random.default_rng(5)
    origins = rng.uniform(low, high, (RAYS, 3))
    directions = unit(rng.normal(size=(RAYS, 3)) * (1.0, 1.0, steepness))
    z = heights_m(bump_m)
    scene = scene_of(z, obstacles)
    ours = np.array(
        [cast(scene, o, d[None], MAX_RANGE_M)[0] for o, d in zip(origins, directions, strict=True)]
    )
    theirs = mj_ranges_m(mujoco_model(z, obstacles), origins, directions)
    assert (theirs < MAX_RANGE_M).mean() > 0.25
    np.testing.assert_array_equal(ours < MAX_RANGE_M, theirs < MAX_RANGE_M)
    np.testing.assert_allclose(ours, theirs, atol=0.01)


def test_agrees_with_mj_ray_over_the_whole_window():
    """As a level scan sees it: 90 m each way, long rays close above the ground."""
    rng = np.random.default_rng(9)
    z = heights_m(0.4, points=360)
    origins = rng.uniform((-20.0, -20.0, 0.45), (20.0, 20.0, 0.8), (1000, 3))
    directions = unit(rng.normal(size=(1000, 3)) * (1.0, 1.0, 0.01))
    scene = scene_of(z, [])
    ours = np.array(
        [cast(scene, o, d[None], MAX_RANGE_M)[0] for o, d in zip(origins, directions, strict=True)]
    )
    theirs = mj_ranges_m(mujoco_model(z, []), origins, directions)
    assert (theirs[theirs < MAX_RANGE_M] > 40.0).sum() > 50
    np.testing.assert_array_equal(ours < MAX_RANGE_M, theirs < MAX_RANGE_M)
    np.testing.assert_allclose(ours, theirs, atol=0.01)


@pytest.mark.parametrize("direction", [(1, 0, 0), (0, -1, 0), (0, 0, -1), (0, 0, 1), (1, 1, 0)])
def test_rays_along_axes_and_lattice_lines(direction):
    z = heights_m(0.5)
    obstacles = random_obstacles(40)
    origin, direction = np.array([[2.0, -3.0, 1.0]]), unit(np.array([direction], float))
    ours = cast(scene_of(z, obstacles), origin[0], direction, MAX_RANGE_M)
    theirs = mj_ranges_m(mujoco_model(z, obstacles), origin, direction)
    np.testing.assert_allclose(ours, theirs, atol=1e-6)


def test_says_what_was_hit():
    wall = Obstacle("wall", "car", "box", (5.0, 0.0, 1.0), (0.1, 1.0, 1.0))
    scene = scene_of(np.zeros((POINTS, POINTS)), [*tunnel(0.1), wall])
    directions = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]])
    origins = np.array([[2.0, 0.0, 1.0], [3.0, 0.0, 0.5]])
    rotations = np.array([np.eye(3), np.diag([-1.0, -1.0, 1.0])])
    range_m, what = cast_hits(scene, origins, directions, MAX_RANGE_M, rotations)
    np.testing.assert_array_equal(what, [[3, GROUND, NO_HIT], [NO_HIT, GROUND, NO_HIT]])
    np.testing.assert_allclose(range_m, [[2.9, 1.0, MAX_RANGE_M], [MAX_RANGE_M, 0.5, MAX_RANGE_M]])


def test_maximum_range_cuts():
    wall = Obstacle("wall", "car", "box", (5.0, 0.0, 1.0), (0.1, 1.0, 1.0))
    scene = scene_of(np.zeros((POINTS, POINTS)), [wall])
    assert cast(scene, np.array([0.0, 0.0, 1.0]), np.array([[1.0, 0.0, 0.0]]), 4.8)[0] == 4.8


def test_hides_what_a_look_at_the_veil_alone_would_hide():
    """All rays walked, and compared: to the bit what is quicker told of the few that matter."""
    rng = np.random.default_rng(11)
    veil, turns = scene_of(heights_m(1.5), random_obstacles(40)), np.eye(3)[None].repeat(50, axis=0)
    origins = rng.uniform((-12.0, -12.0, 0.6), (12.0, 12.0, 4.0), (50, 3))
    directions = unit(rng.normal(size=(60, 3)) * (1.0, 1.0, 0.3))
    range_m, drawn, opacity = rng.uniform(0.0, 90.0, (50, 60)), rng.random((50, 60)), rng.random(40)
    veiled_m, what = cast_hits(veil, origins, directions, MAX_RANGE_M, turns)
    held = (what >= 0) & (veiled_m < range_m) & (drawn < opacity[what])
    expected = np.where(held, veiled_m, range_m)
    assert held.mean() > 0.05
    hide(veil, origins, directions, MAX_RANGE_M, turns, opacity, drawn, range_m)
    np.testing.assert_array_equal(range_m, expected)


def test_rotation_turns_the_directions():
    scene = scene_of(heights_m(1.5), random_obstacles(20))
    rng = np.random.default_rng(6)
    directions = unit(rng.normal(size=(500, 3)))
    rotation = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    origin = np.array([0.0, 0.0, 4.0])
    turned = cast(scene, origin, directions, MAX_RANGE_M, rotation)
    np.testing.assert_allclose(turned, cast(scene, origin, directions @ rotation.T, MAX_RANGE_M))


def test_moving_the_ground_keeps_the_solids():
    z, obstacles = np.zeros((181, 181)), random_obstacles(30)
    directions = unit(np.random.default_rng(7).normal(size=(1000, 3)) * (1.0, 1.0, 0.05))
    origin = np.array([0.0, 0.0, 1.0])
    scene = Scene(obstacles)
    scene.set_ground(z, -45.0, -45.0, 0.5)
    first = cast(scene, origin, directions, 30.0)
    scene.set_ground(z, -51.5, -37.0, 0.5)
    np.testing.assert_allclose(cast(scene, origin, directions, 30.0), first, atol=1e-9)


def test_below_the_ground_is_range_zero():
    scene = scene_of(np.ones((POINTS, POINTS)), [])
    assert cast(scene, np.zeros(3), np.array([[1.0, 0.0, 0.0]]), MAX_RANGE_M)[0] == 0.0


def test_outside_the_ground_nothing_is_seen():
    wall = Obstacle("wall", "car", "box", (HALF_M + 5.0, 0.0, 1.0), (0.1, 1.0, 1.0))
    scene = scene_of(np.zeros((POINTS, POINTS)), [wall])
    for x in (0.0, HALF_M + 1.0):
        range_m = cast(scene, np.array([x, 0.0, 1.0]), np.array([[1.0, 0.0, 0.0]]), MAX_RANGE_M)
        assert range_m[0] == MAX_RANGE_M


def test_normal_of_the_ground():
    x = np.arange(POINTS) * SPACING_M
    scene = scene_of(0.3 * x[None, :] - 0.1 * x[:, None], [])
    expected = unit(np.array([[-0.3, 0.1, 1.0]]))[0]
    found = scene.ground_normals(np.array([0.1, 0.2]), np.array([0.2, 0.1]))
    np.testing.assert_allclose(found, [expected, expected])


def test_pickles_with_the_same_bits():
    scene = scene_of(heights_m(1.5), random_obstacles(20))
    directions = unit(np.random.default_rng(8).normal(size=(500, 3)))
    origin = np.array([0.0, 0.0, 4.0])
    again = pickle.loads(pickle.dumps(scene))
    np.testing.assert_array_equal(
        cast(again, origin, directions, MAX_RANGE_M), cast(scene, origin, directions, MAX_RANGE_M)
    )


def test_refuses_what_it_cannot_take():
    with pytest.raises(ValueError, match=r"ball: shape 'sphere', expected box or cylinder"):
        Scene([Obstacle("ball", "car", "sphere", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))])
    with pytest.raises(ValueError, match=r"shape \(3, 4\), expected \(n, n\)"):
        Scene([]).set_ground(np.zeros((3, 4)), 0.0, 0.0, 0.5)
