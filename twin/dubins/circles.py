"""The circles of a field: which are touched, and what a fan of beams sees of them."""

from collections.abc import Sequence
from math import atan2, pi, sqrt

import numpy as np
from numba import njit
from numpy.typing import NDArray

from twin.world import Obstacle

Floats = NDArray[np.float64]


def circles_of(obstacles: Sequence[Obstacle]) -> Floats:
    """x, y, radius of upright cylinders, shape (n, 3), [m].

    Raises:
        ValueError: an obstacle that is none.
    """
    if other := [o.name for o in obstacles if o.shape != "cylinder"]:
        raise ValueError(f"{other[0]} is no cylinder; the point-mass simulator has circles only")
    rows = [(*o.center_m[:2], o.half_size_m[0]) for o in obstacles]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


@njit(cache=True)
def touched(circles: Floats, x: float, y: float, reach_m: float) -> NDArray[np.int64]:
    """Indices of the circles whose centres are nearer than their radius and `reach_m`."""
    hit = np.zeros(len(circles), np.bool_)
    for i in range(len(circles)):
        dx, dy, reach = circles[i, 0] - x, circles[i, 1] - y, circles[i, 2] + reach_m
        hit[i] = dx * dx + dy * dy < reach * reach
    return np.flatnonzero(hit)


@njit(cache=True)
def ranges_m(
    circles: Floats, pose: tuple[float, float, float], first: float, step: float, beams: int,
    max_range_m: float,
) -> Floats:  # fmt: skip
    """Range to the nearest circle along each beam, `max_range_m` where there is none.

    Args:
        circles: shape (n, 3).
        pose: x, y [m] and heading [rad] of the scanner.
        first, step: angle of the first beam to the heading and from beam to beam, [rad].
        beams: how many.
        max_range_m: how far a beam reaches.
    """
    found = np.full(beams, max_range_m)
    for i in range(len(circles)):
        dx, dy, radius = circles[i, 0] - pose[0], circles[i, 1] - pose[1], circles[i, 2]
        away = sqrt(dx * dx + dy * dy)
        if radius < away < max_range_m + radius:
            bearing = atan2(dy, dx) - pose[2] - first
            _shadow(
                found,
                bearing - 2.0 * pi * np.floor((bearing + pi) / (2.0 * pi)),
                away,
                radius,
                step,
            )
    return found


@njit(cache=True)
def _shadow(found: Floats, bearing: float, away: float, radius: float, step: float) -> None:
    """Shorten the beams that meet one circle; `bearing` counts from the first beam, and the fan
    may begin on either side of the cut at half a turn."""
    half = np.arcsin(radius / away)
    for turn in (-2.0 * pi, 0.0, 2.0 * pi):
        low = max(int(np.ceil((bearing + turn - half) / step)), 0)
        high = min(int(np.floor((bearing + turn + half) / step)), len(found) - 1)
        for k in range(low, high + 1):
            off = k * step - bearing - turn
            across = away * np.sin(off)
            near = away * np.cos(off) - sqrt(max(radius * radius - across * across, 0.0))
            found[k] = min(found[k], near)
