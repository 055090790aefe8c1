"""Arcs of one curvature, forwards or back: what unit operations and Rollback drive."""

from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from nav.messages import Floats
from nav.parameters.planning import Footprint
from nav.planning.boundaries import TOUCH
from nav.planning.scanning import Boundaries, discs, free_distance

STEP_M = 0.25
"""Poses along an arc are looked at this close together."""

Pose = tuple[float, float, float]
"""x, y [m] and heading [rad], route frame N."""


def arc_poses(curvature_per_m: Floats, way_m: Floats) -> tuple[Floats, Floats]:
    """Poses along arcs from a vehicle at the origin that heads along x.

    Args:
        curvature_per_m: shape (n, 1), in the forward sense: left positive in both gears.
        way_m: shape (n, m), negative where it is driven back.

    Returns:
        Positions, shape (2, n, m), and headings, shape (n, m).
    """
    half = 0.5 * curvature_per_m * way_m
    chord = way_m * np.sinc(half / np.pi)
    return chord * np.array([np.cos(half), np.sin(half)]), 2.0 * half


def placed(pose: Pose, position_m: Floats, heading_rad: Floats) -> tuple[Floats, Floats]:
    """Positions (2, ...) and headings (...) of the vehicle frame in the frame N."""
    c, s = cos(pose[2]), sin(pose[2])
    u, v = position_m
    return np.array([pose[0] + c * u - s * v, pose[1] + s * u + c * v]), heading_rad + pose[2]


def levels(
    position_m: Floats, heading_rad: Floats, boundaries: Boundaries, footprint: Footprint
) -> NDArray[np.uint8]:
    """How many boundaries the vehicle is inside of at poses (2, ...) and (...): of its discs, the
    worst."""
    x, y = discs(position_m, heading_rad, footprint)
    return boundaries.at(x, y).max(axis=0)


def free_arc(
    pose: Pose, curvature_per_m: float, way_m: float, boundaries: Boundaries, footprint: Footprint
) -> float:
    """How far an arc is free before the outline would touch, [m]; `way_m` negative drives back."""
    count = max(round(abs(way_m) / STEP_M), 1)
    way = np.linspace(0.0, way_m, count + 1)[None]
    place, heading = placed(pose, *arc_poses(np.array([[curvature_per_m]]), way))
    level = levels(place, heading, boundaries, footprint)
    return float(free_distance(level, np.abs(way[0]), TOUCH, footprint)[0])


def curvature_back(forward_m: float, left_m: float, radius_m: float) -> float:
    """Curvature of the circle along the vehicle's axis through a place of the vehicle frame.

    Pure pursuit (Coulter 1992), which holds for places behind as well; limited to `radius_m`.
    """
    squared = forward_m * forward_m + left_m * left_m
    curvature = 2.0 * left_m / squared if squared > 0.0 else 0.0  # it is there already
    return min(max(curvature, -1.0 / radius_m), 1.0 / radius_m)
