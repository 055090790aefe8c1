"""A field as data: circles, and the way that is asked for."""

from math import cos, sin
from typing import NamedTuple

import numpy as np

from scenarios.course import Floats
from twin.dubins import dubins_parameters

SIDE_M = 200.0
"""The field is a square about the origin (published nowhere; ours, as all numbers here)."""
APART_M = 180.0
"""From start to goal."""
RADIUS_M = (0.5, 4.0)
DISC_M = dubins_parameters().drive.disc_radius_m
"""The vehicle is a point; circles are raw, and a centre nearer than radius and this is contact."""
CHECK_POINTS = 4
"""Between start and goal, evenly along the way ..."""
CHECK_OFFSET_M = 8.0
"""... and up to this far beside it ..."""
CHECK_CLEAR_M = 2.0
"""... this far from the circles, as somebody with a map would put them."""
CLEAR_START_M, CLEAR_GOAL_M = 8.0, 5.0
"""No circle reaches nearer to the start than to leave room for a turn, nor into the goal."""
TRIES, CHECK_TRIES = 200, 40


class Field(NamedTuple):
    """One field in the world frame, [m]."""

    circles: Floats
    """Shape (n, 3): x, y, radius."""
    way_m: Floats
    """Shape (k, 2): start, check points, goal."""


class Keep(NamedTuple):
    """A disc into which no circle that lies about may reach."""

    x_m: float
    y_m: float
    radius_m: float


def ends(turn_rad: float) -> tuple[Floats, Floats]:
    """Start and goal of a way through the middle of the field, each shape (2,)."""
    half = 0.5 * APART_M * np.array([cos(turn_rad), sin(turn_rad)])
    return -half, half


def placed(lane_m: Floats, turn_rad: float) -> Floats:
    """Points (n, 2) of the lane frame (x from start to goal) in the world frame."""
    c, s = cos(turn_rad), sin(turn_rad)
    return lane_m @ np.array([[c, s], [-s, c]])


def ends_kept(turn_rad: float) -> list[Keep]:
    """The discs about start and goal."""
    radii = (CLEAR_START_M, CLEAR_GOAL_M)
    places = zip(ends(turn_rad), radii, strict=True)
    return [Keep(float(x), float(y), radius) for (x, y), radius in places]


def scattered(rng: np.random.Generator, count: int, kept: list[Keep]) -> Floats:
    """Circles anywhere in the field, shape (count, 3); they may overlap, but reach into nothing
    that is kept free."""
    rows = [_circle(rng, kept) for _ in range(count)]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def _circle(rng: np.random.Generator, kept: list[Keep]) -> tuple[float, float, float]:
    for _ in range(TRIES):
        x, y = rng.uniform(-0.5 * SIDE_M, 0.5 * SIDE_M, 2).tolist()
        radius = float(rng.uniform(*RADIUS_M))
        if all(np.hypot(x - k.x_m, y - k.y_m) > radius + k.radius_m for k in kept):
            break
    else:
        raise ValueError("no room for a circle: expected a smaller part of the field kept free")
    return x, y, radius


def check_points(rng: np.random.Generator, circles: Floats, turn_rad: float) -> Floats:
    """Points between start and goal, off the circles, shape (k, 2), world frame."""
    along = APART_M * (np.arange(1, CHECK_POINTS + 1) / (CHECK_POINTS + 1) - 0.5)
    return np.array([_check_point(rng, circles, turn_rad, float(x)) for x in along])


def _check_point(
    rng: np.random.Generator, circles: Floats, turn_rad: float, along_m: float
) -> Floats:
    """The first that is drawn off the circles; in a thicket, the one with the most room."""
    across_m = rng.uniform(-CHECK_OFFSET_M, CHECK_OFFSET_M, CHECK_TRIES)
    points = placed(np.column_stack([np.full(CHECK_TRIES, along_m), across_m]), turn_rad)
    away = np.hypot(*(circles[:, None, :2] - points).T)
    gap_m = (away - circles[:, 2]).min(axis=1, initial=np.inf) - DISC_M
    return points[int(np.argmax(np.minimum(gap_m, CHECK_CLEAR_M)))]
