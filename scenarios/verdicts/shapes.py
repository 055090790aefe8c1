"""Plan-view geometry: the footprints of obstacles and their distance to the vehicle's outline."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from twin.world import Obstacle

Floats = NDArray[np.float64]

CORNERS = 8
"""Most corners of a box seen from above; hulls with fewer repeat their last one."""


Pose = tuple[float, float, float]
"""x, y [m] and heading [rad] of the reference point, world frame."""


class Outline(NamedTuple):
    """The vehicle's rectangle, 120 x 60 in, in the vehicle frame [m] (published)."""

    front_m: float = 2.10
    rear_m: float = -0.95
    half_width_m: float = 0.762
    radius_m: float = 0.0
    """All points this near to the rectangle belong to it too: a disc is a point with a radius."""

    @property
    def middle_m(self) -> float:
        """x of the rectangle's centre."""
        return 0.5 * (self.front_m + self.rear_m)

    def nose_m(self, pose: Pose) -> tuple[float, float]:
        """The middle of the bumper in the world."""
        x, y, heading = pose
        front = self.front_m + self.radius_m
        return x + front * math.cos(heading), y + front * math.sin(heading)

    def corners_m(self, pose: Pose) -> list[tuple[float, float]]:
        """The four corners of the rectangle in the world, in order around it."""
        x, y, heading = pose
        c, s, w = math.cos(heading), math.sin(heading), self.half_width_m
        local = ((self.front_m, -w), (self.front_m, w), (self.rear_m, w), (self.rear_m, -w))
        return [(x + c * u - s * v, y + s * u + c * v) for u, v in local]

    def border_m(self, pose: Pose) -> list[tuple[float, float]]:
        """The whole outline in the world, for pictures: its corners, rounded by the radius."""
        if self.radius_m == 0.0:
            return self.corners_m(pose)
        return [
            (x + self.radius_m * math.cos(angle), y + self.radius_m * math.sin(angle))
            for k, (x, y) in enumerate(self.corners_m(pose))
            for angle in (pose[2] + math.pi * (k - 1 + part / 8) / 2 for part in range(9))
        ]


class Footprints(NamedTuple):
    """Convex shapes on the ground, world frame: a hull, and a radius around it."""

    corner_m: Floats
    """Shape (n, 8, 2), counter-clockwise."""
    radius_m: Floats
    """Shape (n,): of a cylinder, whose hull is its axis; 0 for boxes."""


def footprints(obstacles: Sequence[Obstacle]) -> Footprints:
    """The shadows of obstacles under a sun in the zenith; boxes may be tilted."""
    corner_m = np.array([_hull(obstacle) for obstacle in obstacles])
    radius_m = [o.half_size_m[0] if o.shape == "cylinder" else 0.0 for o in obstacles]
    return Footprints(corner_m.reshape(-1, CORNERS, 2), np.array(radius_m, dtype=np.float64))


def bottom_m(obstacle: Obstacle) -> float:
    """Height of an obstacle's lowest point, [m]."""
    reach = np.abs(_rotation(obstacle.quat)[2]) @ np.array(obstacle.half_size_m)
    return obstacle.center_m[2] - float(reach)


def distances_m(outline: Outline, pose: Pose, shapes: Footprints) -> Floats:
    """Exact plan-view distance from the outline to each shape, 0 where they overlap.

    Args:
        outline: the vehicle.
        pose: of the vehicle.
        shapes: n footprints.

    Returns:
        Shape (n,), [m].
    """
    x, y, heading = pose
    c, s = math.cos(heading), math.sin(heading)
    middle, half_length_m = outline.middle_m, 0.5 * (outline.front_m - outline.rear_m)
    center = (x + c * middle, y + s * middle)
    size = (half_length_m, outline.half_width_m, outline.radius_m)
    return _distances(size, center, (c, s), *shapes)


@njit(cache=True)
def _distances(
    size: tuple[float, float, float], center: tuple[float, float], turn: tuple[float, float],
    corner_m: Floats, radius_m: Floats,
) -> Floats:  # fmt: skip
    """From a rectangle at `center`, whose x axis is along `turn`, to each shape; `size` has its
    half length, its half width, and the radius around it."""
    (c, s), local = turn, np.empty((CORNERS, 2))
    distance = np.empty(len(radius_m))
    for i in range(len(radius_m)):
        corners = CORNERS if radius_m[i] == 0.0 else 1
        for k in range(corners):
            dx, dy = corner_m[i, k, 0] - center[0], corner_m[i, k, 1] - center[1]
            local[k, 0], local[k, 1] = c * dx + s * dy, c * dy - s * dx
        if corners > 1:
            gap = _rectangle_to_polygon(size[0], size[1], local)
        else:  # an axis: quicker, and the same
            x, y = abs(local[0, 0]) - size[0], abs(local[0, 1]) - size[1]
            gap = math.sqrt(max(x, 0.0) ** 2 + max(y, 0.0) ** 2)
        distance[i] = max(gap - size[2] - radius_m[i], 0.0)
    return distance


@njit(cache=True)
def _rectangle_to_polygon(hx: float, hy: float, polygon: Floats) -> float:
    """Between convex shapes that do not overlap, the nearest pair of points has a corner of one
    of them; whether they overlap, the separating axes tell."""
    nearest2 = np.inf
    low_x, high_x, low_y, high_y = np.inf, -np.inf, np.inf, -np.inf
    separated = False
    for k in range(len(polygon)):
        x, y = polygon[k]
        ex, ey = polygon[(k + 1) % len(polygon)] - polygon[k]
        low_x, high_x = min(low_x, x), max(high_x, x)
        low_y, high_y = min(low_y, y), max(high_y, y)
        nearest2 = min(nearest2, max(abs(x) - hx, 0.0) ** 2 + max(abs(y) - hy, 0.0) ** 2)
        outside, edge2 = _corners_to_edge(hx, hy, (x, y), (ex, ey))
        nearest2 = min(nearest2, edge2)
        separated = separated or outside
    separated = separated or low_x > hx or high_x < -hx or low_y > hy or high_y < -hy
    return math.sqrt(nearest2) if separated else 0.0


@njit(cache=True)
def _corners_to_edge(
    hx: float, hy: float, start: tuple[float, float], edge: tuple[float, float]
) -> tuple[bool, float]:
    """Whether all corners of the rectangle lie right of an edge, and the nearest one's square."""
    (ex, ey), outside, nearest2 = edge, True, np.inf
    length2 = max(ex * ex + ey * ey, 1e-12)
    for cx, cy in ((hx, hy), (hx, -hy), (-hx, hy), (-hx, -hy)):
        px, py = cx - start[0], cy - start[1]
        along = min(max((px * ex + py * ey) / length2, 0.0), 1.0)
        nearest2 = min(nearest2, (px - along * ex) ** 2 + (py - along * ey) ** 2)
        outside = outside and ey * px - ex * py > 0.0
    return outside, nearest2


def _hull(obstacle: Obstacle) -> Floats:
    """Convex hull of an obstacle's shadow, shape (8, 2), counter-clockwise."""
    center = np.array(obstacle.center_m[:2])
    if obstacle.shape == "cylinder":
        return np.tile(center, (CORNERS, 1))
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    corner = (signs * obstacle.half_size_m) @ _rotation(obstacle.quat).T
    hull = convex_hull(corner[:, :2])
    repeated = np.vstack([hull, np.tile(hull[-1], (CORNERS - len(hull), 1))])
    return repeated + center


def convex_hull(point_m: Floats) -> Floats:
    """Andrew's monotone chain: the corners of the hull, counter-clockwise."""
    order = sorted({(round(x, 9), round(y, 9)) for x, y in point_m.tolist()})
    chains = [_chain(order), _chain(order[::-1])]
    return np.array(chains[0][:-1] + chains[1][:-1] or order)


def _chain(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    chain: list[tuple[float, float]] = []
    for point in points:
        while len(chain) > 1 and not _turns_left(chain[-2], chain[-1], point):
            chain.pop()
        chain.append(point)
    return chain


def _turns_left(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 1e-9


def _rotation(quat: tuple[float, float, float, float]) -> Floats:
    """Rotation matrix of a unit quaternion w x y z."""
    w, x, y, z = quat
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
