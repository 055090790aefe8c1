"""The MuJoCo model of one world: the vehicle, a window of ground, and what stands on it."""

from collections.abc import Mapping

import mujoco

import models
from twin import pool
from twin.terrain import Z_TOP_M, TerrainWindow
from twin.world import OPACITY, SOFT, Obstacle, World

HFIELD_BOTTOM_M = 2.0
"""Thickness of the ground below its lowest point."""
OBSTACLE_GROUP = 1
SHAPES = {"box": mujoco.mjtGeom.mjGEOM_BOX, "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER}


def compile(world: World, window: TerrainWindow, vehicle: str = models.RANGER) -> mujoco.MjModel:
    """Build the model of the vehicle on this world's ground.

    The tires' own friction is nearly nothing, so the larger value rules: the ground's.

    Args:
        world: each obstacle becomes one static geom of the same name.
        window: the ground around the vehicle; later call `window.write_hfield` when it scrolls.
        vehicle: one of `models`.

    Raises:
        ValueError: an obstacle of an unknown shape, or ground too steep for the height field.
    """
    spec = mujoco.MjSpec.from_file(models.path(vehicle))
    _add_ground(spec, window, world.friction)
    for obstacle in world.obstacles:
        _add_obstacle(spec, obstacle, world.friction)
    if world.scenery:
        _add_pool(spec, world.room, world.friction)
    model = spec.compile()
    window.write_heights(model)
    return model


def owners(world: World) -> dict[str, str]:
    """The owner of each obstacle's geom; empty for what a vehicle may touch."""
    return {o.name: "" if o.kind in SOFT else o.owner or o.name for o in world.obstacles}


def _add_ground(spec: mujoco.MjSpec, window: TerrainWindow, friction: float) -> None:
    reach = (window.contact_size - 1) * window.spacing / 2.0
    field = spec.add_hfield(name="terrain", nrow=window.contact_size, ncol=window.contact_size)
    field.size = [reach, reach, Z_TOP_M, HFIELD_BOTTOM_M]
    field.userdata = [0.0] * window.contact_size**2  # the compiler would scale true heights
    body = spec.worldbody.add_body(name="terrain_window", mocap=True, pos=window.contact_origin_m)
    body.add_geom(
        name="terrain", type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="terrain",
        friction=_sliding(friction), rgba=[0.76, 0.70, 0.55, 1.0],
    )  # fmt: skip


def _add_obstacle(spec: mujoco.MjSpec, obstacle: Obstacle, friction: float) -> None:
    if obstacle.shape not in SHAPES:
        known = ", ".join(SHAPES)
        raise ValueError(f"{obstacle.name}: shape {obstacle.shape!r}, expected one of {known}")
    radius, _, half_height = obstacle.half_size_m
    upright = obstacle.shape == "cylinder"
    touches = int(obstacle.kind not in OPACITY)
    spec.worldbody.add_geom(
        name=obstacle.name,
        type=SHAPES[obstacle.shape],
        pos=obstacle.center_m,
        quat=obstacle.quat,
        size=[radius, half_height, 0.0] if upright else obstacle.half_size_m,
        friction=_sliding(friction),
        group=OBSTACLE_GROUP,
        contype=touches,
        conaffinity=touches,
        rgba=COLORS.get(obstacle.kind, COLORS[""]),
    )


def _add_pool(spec: mujoco.MjSpec, room: Mapping[str, int], friction: float) -> None:
    """As tall as wide: then the axes of inertia, in which MuJoCo keeps bounds, are the geoms'."""
    for shape, count in room.items():
        for k in range(count):
            name = pool.name(shape, k)
            body = spec.worldbody.add_body(name=name, mocap=True, pos=[0.0, 0.0, pool.PARKED_M])
            body.add_geom(
                name=name, type=SHAPES[shape], size=[1.0, 1.0, 1.0],
                friction=_sliding(friction), group=OBSTACLE_GROUP, rgba=COLORS[""],
            )  # fmt: skip


def _sliding(friction: float) -> list[float]:
    """Sliding, and MuJoCo's defaults for torsion and rolling, which three dimensions leave out."""
    return [friction, 0.005, 0.0001]


COLORS = {
    "": [0.55, 0.50, 0.45, 1.0],
    "gate_post": [0.95, 0.55, 0.10, 1.0],
    "gate_flank": [0.80, 0.80, 0.78, 1.0],
    "tunnel": [0.45, 0.50, 0.55, 1.0],
    "car": [0.25, 0.35, 0.60, 1.0],
    "hay_bale": [0.85, 0.70, 0.30, 1.0],
    "tires": [0.15, 0.15, 0.15, 1.0],
    "tank_trap": [0.45, 0.25, 0.15, 1.0],
    "rumble_strip": [0.90, 0.80, 0.20, 1.0],
    "brush": [0.35, 0.50, 0.25, 1.0],
}
