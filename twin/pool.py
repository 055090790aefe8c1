"""Geoms that stand for whatever is near: MuJoCo's share of a world that streams past."""

from collections.abc import Sequence
from itertools import count, takewhile
from math import hypot

import mujoco
import numpy as np

from twin.world import OPACITY, ROOM, Obstacle

REACH_M = 16.0
"""What is farther from the vehicle than this when the pool is placed does not stand in it: the
vehicle moves 8 m before it is placed anew, and is 2 m long on each side of its middle."""
PARKED_M = -1000.0
"""Height of those that stand for nothing."""


def is_in(model: mujoco.MjModel) -> bool:
    """Whether a model has one."""
    return any(_bodies(model, shape) for shape in ROOM)


def name(shape: str, k: int) -> str:
    """Of the body and geom number k of a shape."""
    return f"pool_{shape}_{k:02d}"


class Pool:
    """The geoms of the pool in one compiled model. Picklable."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._bodies = {shape: _bodies(model, shape) for shape in ROOM}

    def place(
        self, model: mujoco.MjModel, data: mujoco.MjData, near: Sequence[Obstacle]
    ) -> dict[int, Obstacle | None]:
        """Let things stand in the model, but what holds nothing back.

        Returns:
            What each geom of the pool stands for now, by its id.

        Raises:
            ValueError: more stand near than there are geoms.
        """
        stands: dict[int, Obstacle | None] = {}
        hard = [o for o in near if o.kind not in OPACITY]
        for shape, bodies in self._bodies.items():
            due = [o for o in hard if o.shape == shape]
            if len(due) > len(bodies):
                x, y, _ = due[0].center_m
                at = f"{due[0].name} at ({x:.0f}, {y:.0f}) m"
                raise ValueError(f"{len(due)} of shape {shape} near {at}, at most {len(bodies)}")
            for body, thing in zip(bodies, [*due, *[None] * len(bodies)], strict=False):
                geom = int(model.body_geomadr[body])
                _put(model, data, body, geom, thing)
                stands[geom] = thing
        return stands


def within_reach(things: Sequence[Obstacle], at_m: tuple[float, float]) -> list[Obstacle]:
    """What is near enough to stand in the pool."""
    return [o for o in things if _gap_m(o, at_m) < REACH_M]


def _bodies(model: mujoco.MjModel, shape: str) -> list[int]:
    """Of one shape, by number."""
    numbered = (mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name(shape, k)) for k in count())
    return list(takewhile(lambda body: body >= 0, numbered))


def _gap_m(thing: Obstacle, at_m: tuple[float, float]) -> float:
    x, y, _ = thing.center_m
    return hypot(x - at_m[0], y - at_m[1]) - hypot(*thing.half_size_m)


def _put(
    model: mujoco.MjModel, data: mujoco.MjData, body: int, geom: int, thing: Obstacle | None
) -> None:
    """One geom: where it is, and how large, for the narrow phase as well as for the broad one."""
    mocap = model.body_mocapid[body]
    # What is parked is left out of the broad phase, which would compare each of them with each.
    model.body_contype[body] = model.body_conaffinity[body] = int(thing is not None)
    if thing is None:
        data.mocap_pos[mocap] = 0.0, 0.0, PARKED_M
        return
    a, b, c = thing.half_size_m
    upright = thing.shape == "cylinder"
    data.mocap_pos[mocap], data.mocap_quat[mocap] = thing.center_m, thing.quat
    model.geom_size[geom] = (a, c, 0.0) if upright else (a, b, c)
    model.geom_rbound[geom] = hypot(a, c) if upright else hypot(a, b, c)
    box = np.array([0.0, 0.0, 0.0, a, a if upright else b, c])
    model.geom_aabb[geom] = model.bvh_aabb[model.body_bvhadr[body]] = box
