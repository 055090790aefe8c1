"""Footprints of obstacles, and how much of the corridor they leave free (helper of tests)."""

import numpy as np

from scenarios.course import Course
from twin.world import SOFT, Obstacle

OVERHEAD_M = 2.5


def corners_m(obstacle: Obstacle) -> np.ndarray:
    """Corners of the obstacle in space, shape (n, 3), world frame; a cylinder has 16 sides."""
    half = np.array(obstacle.half_size_m)
    if obstacle.shape == "cylinder":
        angle = np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False)
        ring = half[0] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return np.column_stack([ring, np.zeros(16)]) + obstacle.center_m
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return signs * half @ rotation(obstacle.quat).T + obstacle.center_m


def rotation(quat: tuple[float, ...]) -> np.ndarray:
    """Rotation matrix of a quaternion w x y z."""
    w, x, y, z = quat
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip


def stands_in_the_way(obstacle: Obstacle, course: Course) -> bool:
    """Whether a vehicle could hit it: neither soft nor overhead."""
    ground = course.world.terrain.height(*(np.array(v) for v in obstacle.center_m[:2]))
    bottom = corners_m(obstacle)[:, 2].min()
    tall = obstacle.shape == "cylinder"
    return obstacle.kind not in SOFT and (tall or bottom - ground < OVERHEAD_M)


def samples(course: Course, step_m: float = 0.5) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (n, 2), unit directions (n, 2) and half-widths (n,) along the route line."""
    points, directions, widths = [], [], []
    for a, b, width in zip(
        course.waypoint_m, course.waypoint_m[1:], course.half_width_m, strict=False
    ):
        length = np.hypot(*(b - a))
        s = np.arange(0.0, length, step_m)[:, None]
        points.append(a + s * (b - a) / length)
        directions.append(np.repeat((b - a)[None] / length, len(s), axis=0))
        widths.append(np.full(len(s), width))
    return np.concatenate(points), np.concatenate(directions), np.concatenate(widths)


def lateral_m(points: np.ndarray, course: Course) -> np.ndarray:
    """Signed offset of points (n, 2) from the route line, left positive, shape (n,)."""
    a, b = course.waypoint_m[:-1], course.waypoint_m[1:]
    span = b - a
    away = points[:, None] - a
    along = np.clip((away * span).sum(-1) / np.square(span).sum(-1), 0.0, 1.0)
    gap = away - along[..., None] * span
    nearest = np.hypot(gap[..., 0], gap[..., 1]).argmin(axis=1)
    rows = np.arange(len(points))
    unit = span[nearest] / np.hypot(*span[nearest].T)[:, None]
    g = away[rows, nearest]
    return unit[:, 0] * g[:, 1] - unit[:, 1] * g[:, 0]


def free_width_m(course: Course) -> np.ndarray:
    """The widest free interval across the corridor at each sample of the route line, shape (n,)."""
    point, direction, width = samples(course)
    taken: list[list[tuple[float, float]]] = [[] for _ in point]
    for obstacle in course.world.everything():
        if stands_in_the_way(obstacle, course):
            for k, low, high in _crossings(corners_m(obstacle)[:, :2], point, direction, width):
                taken[k].append((low, high))
    return np.array([_widest(t, w) for t, w in zip(taken, width, strict=True)])


def _crossings(corners, point, direction, width):
    """Samples whose cross line meets the hull of `corners`, with the interval it takes there."""
    radius = np.hypot(*(corners - corners.mean(axis=0)).T).max()
    near = np.flatnonzero(np.hypot(*(point - corners.mean(axis=0)).T) < radius + width + 1.0)
    for k in near:
        away = corners - point[k]
        u = away @ direction[k]
        v = direction[k, 0] * away[:, 1] - direction[k, 1] * away[:, 0]
        if u.min() < 0.0 < u.max():
            yield k, *_hull_at_zero(u, v)


def _hull_at_zero(u, v):
    """Range of v on u = 0 in the convex hull: extremes over all pairs across the line."""
    i, j = np.flatnonzero(u < 0.0)[:, None], np.flatnonzero(u >= 0.0)[None]
    crossing = v[i] + (v[j] - v[i]) * (-u[i] / (u[j] - u[i]))
    return crossing.min(), crossing.max()


def _widest(taken, width):
    edge, best = -width, 0.0
    for low, high in sorted(taken):
        best, edge = max(best, min(low, width) - edge), max(edge, high)
    return max(best, width - edge)
