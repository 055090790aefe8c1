"""What the paper's simulator got stuck in: concave traps, and forks whose wrong way is a dead end.

All is drawn in the lane frame: x from the start to the goal, y to the left, the origin half way.
Walls are rows of circles that overlap.
"""

from math import cos, sin

import numpy as np

from scenarios.course import Floats
from scenarios.random_field.field import Keep

POST_M = (0.8, 1.2)
"""Radius of the circles of a wall ..."""
STEP_M = 1.4
"""... and the distance between them: even the smallest overlap."""
TRAP_AT_M = (-36.0, 36.0)
"""Where traps stand along the lane, more or less."""
TRAP_WIDTH_M, TRAP_DEPTH_M = (14.0, 24.0), (8.0, 18.0)
"""Inside; the vehicle turns on a circle of 12 m."""
WALL_HALF_M = 45.0
"""A fork's wall reaches this far to each side."""
OPENING_M = 8.0
"""Of a fork, between the circles' centres."""
OPENINGS_AT_M = (9.0, 16.0)
"""Left and right of the lane."""
POCKET_M = (14.0, 24.0)
"""How deep the dead end behind the wrong opening is."""


def trap(rng: np.random.Generator, at_m: float) -> Floats:
    """A U that opens towards the start, across the lane, shape (n, 3)."""
    half = 0.5 * float(rng.uniform(*TRAP_WIDTH_M))
    depth = float(rng.uniform(*TRAP_DEPTH_M))
    corners = np.array([[-depth, half], [0.0, half], [0.0, -half], [-depth, -half]])
    turn, across = float(rng.uniform(-0.3, 0.3)), float(rng.uniform(-4.0, 4.0))
    c, s = cos(turn), sin(turn)
    at = np.array([at_m + float(rng.uniform(-6.0, 6.0)), across])
    return wall(rng, corners @ np.array([[c, s], [-s, c]]) + at)


def fork(rng: np.random.Generator) -> tuple[Floats, Floats, Keep]:
    """A wall with two openings, of which one leads into a dead end.

    Returns:
        The circles, shape (n, 3); two check points that mislead, shape (2, 2): in the wrong
        opening and behind the dead end; and the free opening.
    """
    side, at = float(rng.choice((-1.0, 1.0))), rng.uniform(*OPENINGS_AT_M, 2)
    wrong, right = (float(v) * s for v, s in zip(at, (side, -side), strict=True))
    half, deep = 0.5 * OPENING_M, float(rng.uniform(*POCKET_M))
    low, high = sorted((wrong, right))
    walls = [
        [(0.0, -WALL_HALF_M), (0.0, low - half)],
        [(0.0, low + half), (0.0, high - half)],
        [(0.0, high + half), (0.0, WALL_HALF_M)],
        [(0.0, wrong - half), (deep, wrong - half), (deep, wrong + half), (0.0, wrong + half)],
    ]
    circles = np.vstack([wall(rng, np.array(corners)) for corners in walls])
    misleading = np.array([[0.0, wrong], [deep + 12.0, wrong]])
    return circles, misleading, Keep(0.0, right, half + 2.0)


def wall(rng: np.random.Generator, corners: Floats) -> Floats:
    """Circles along a line of corners (k, 2), shape (n, 3)."""
    step = np.diff(corners, axis=0)
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(step[:, 0], step[:, 1]))])
    count = int(np.ceil(arc[-1] / STEP_M)) + 1
    at = np.linspace(0.0, arc[-1], count)
    x, y = np.interp(at, arc, corners[:, 0]), np.interp(at, arc, corners[:, 1])
    return np.column_stack([x, y, rng.uniform(*POST_M, count)])
