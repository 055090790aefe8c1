"""The corridor: the union of the segments' rectangles and of the discs about their waypoints.

Each segment brings its own half-width to the discs at both its ends, so that a rectangle and its
two discs are the points nearer to the segment than its half-width.
"""

import numpy as np
from numpy.typing import NDArray

from nav.route.geodesy import Floats
from nav.route.waypoints import Waypoints


def foot(points: Floats, start: Floats, end: Floats) -> Floats:
    """The nearest point of a segment; shapes (..., 2) broadcast, [m]."""
    along = end - start
    length2 = np.maximum((along * along).sum(-1), 1e-12)
    t = ((points - start) * along).sum(-1) / length2
    return start + np.minimum(np.maximum(t, 0.0), 1.0)[..., None] * along


def depth(points: Floats, waypoints: Waypoints, first: int, last: int) -> Floats:
    """How deep inside the corridor points lie, negative outside.

    Args:
        points: shape (m, 2), frame N, [m].
        waypoints: the route.
        first: the first segment that counts; indexes beyond the route are clipped.
        last: the last one, included.

    Returns:
        Shape (m,), [m]: the largest of half-width less distance over the segments.
    """
    low, high = max(first, 0), min(last + 1, waypoints.segments)
    P = waypoints.position_m
    offset = points[:, None] - foot(points[:, None], P[low:high], P[low + 1 : high + 1])
    distance = np.sqrt((offset * offset).sum(-1))
    return (waypoints.half_width_m[low:high] - distance).max(axis=1)


def inside(
    points: Floats, waypoints: Waypoints, first: int, last: int, margin_m: float = 0.0
) -> NDArray[np.bool_]:
    """Which points (m, 2) lie in the corridor of segments first..last, shrunk by a margin."""
    return depth(points, waypoints, first, last) >= margin_m
