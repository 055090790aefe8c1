"""Where things are in the picture, which is drawn in the simulator's world frame."""

from typing import NamedTuple

import numpy as np

from ion.view.timeline import Moment
from nav.fusion.scan_geometry import rotation
from nav.messages import EgoEstimate, Floats
from scenarios.course import Course
from scenarios.verdicts.tracking import frames
from tape.truth import TrueState


class Pose(NamedTuple):
    """Of the vehicle frame in the world."""

    position_m: Floats
    """Shape (3,)."""
    axes: Floats
    """Shape (3, 3): columns are forward, left, up."""

    def to_world(self, local_m: Floats) -> Floats:
        """Points (n, 3) of the vehicle frame in the world."""
        return self.position_m + local_m @ self.axes.T

    def to_vehicle(self, world_m: Floats) -> Floats:
        """Points (n, 3) of the world in the vehicle frame."""
        return (world_m - self.position_m) @ self.axes


class Places:
    """Frames and ground of one course."""

    def __init__(self, course: Course) -> None:
        self._frames = frames(course)
        self._terrain = course.world.terrain

    def on_ground(self, world_m: Floats, above_m: float = 0.0) -> Floats:
        """Points (n, 2) of the world frame on the ground or above it, shape (n, 3)."""
        x, y = np.ascontiguousarray(world_m[:, 0]), np.ascontiguousarray(world_m[:, 1])
        return np.stack([x, y, self._terrain.height(x, y) + above_m], axis=1)

    def of_route(self, route_m: Floats, above_m: float = 0.0) -> Floats:
        """Points (n, 2) of route frame N on the ground or above it, shape (n, 3)."""
        if not len(route_m):
            return np.zeros((0, 3))
        return self.on_ground(self._frames.to_world(route_m), above_m)

    def estimated(self, ego: EgoEstimate) -> Pose:
        """Where the navigator believes the vehicle to be, put on the ground."""
        place = self.of_route(ego.position_m[None, :])[0]
        return Pose(place, rotation(ego.roll_rad, ego.pitch_rad, ego.heading_rad))

    def vehicle(self, moment: Moment) -> Pose | None:
        """The true pose, or without it on the tape the estimated one; None before the first."""
        if moment.truth:
            return true_pose(moment.truth)
        return self.estimated(moment.ego) if moment.ego else None


def true_pose(state: TrueState) -> Pose:
    """Where the vehicle really is."""
    axes = rotation(state.roll_rad, state.pitch_rad, state.heading_rad)
    return Pose(state.position_m, axes)


def quaternion(axes: Floats) -> Floats:
    """Of a rotation matrix (3, 3); w x y z."""
    from viser.transforms import SO3

    return SO3.from_matrix(axes).wxyz.astype(np.float64)
