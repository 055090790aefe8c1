"""The smooth path through the waypoints, equations (6.1) to (6.4).

(6.4) is the Catmull-Rom cubic: position and unit tangent are continuous, (6.3). The curvature is
not, although the text says so: it jumps a little at each point. On waypoints as they come, whose
distances differ up to 70 times, the curve forms loops; so points are put in evenly, and corners
rounded inside the corridor (`rounding`), before it interpolates.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.route.geodesy import Floats
from nav.route.rounding import Rounding, arc_of, even_arcs, interpolate, rounded
from nav.route.waypoints import Waypoints

SAMPLE_M = 0.5
"""Largest distance between samples of the path."""
STRETCH = 1.2
"""The curve between two even points is at most this much longer than their distance."""


@dataclass(frozen=True, eq=False)
class SmoothPath:
    """The path, sampled at most 0.5 m apart; arrays of k samples, read-only."""

    position_m: Floats
    """Shape (k, 2), frame N."""
    heading_rad: Floats
    """Shape (k,), of the tangent (6.2), continuous: not wrapped to (-pi, pi]."""
    curvature_per_m: Floats
    """Shape (k,), left positive."""
    arc_m: Floats
    """Shape (k,), length of the path up to here."""
    segment: NDArray[np.int64]
    """Shape (k,), the waypoint segment that each sample belongs to."""
    speed_limit_mps: Floats
    """Shape (k,), of that segment."""

    def __post_init__(self) -> None:
        for array in vars(self).values():
            array.setflags(write=False)


class Projection(NamedTuple):
    """Where a point stands beside the path."""

    index: int  # pyright: ignore[reportIncompatibleMethodOverride]  (tuple has one, unused)
    """The nearest sample."""
    cross_track_m: float
    """Signed offset from the path, left positive."""
    arc_m: float


def smooth_path(waypoints: Waypoints, rounding: Rounding | None = None) -> SmoothPath:
    """The smooth path over all waypoints, from the first to the last."""
    rounding = rounding or Rounding()
    points, route_arc = rounded(waypoints, rounding)
    arc = arc_of(points)
    even = even_arcs(arc[-1], rounding.spacing_m)
    knots = interpolate(even, arc, points)
    steps = int(np.ceil(STRETCH * even[1] / SAMPLE_M))
    position, tangent, second = catmull_rom(knots, steps)
    samples = np.interp(np.arange(len(position)) / steps, np.arange(len(even)), even)
    segment = _segments(np.interp(samples, arc, route_arc), waypoints)
    speed = np.hypot(tangent[:, 0], tangent[:, 1])
    bend = (tangent[:, 0] * second[:, 1] - tangent[:, 1] * second[:, 0]) / speed**3
    heading = np.unwrap(np.arctan2(tangent[:, 1], tangent[:, 0]))
    limit = waypoints.speed_mps[segment]
    return SmoothPath(position, heading, bend, arc_of(position), segment, limit)


def catmull_rom(points: Floats, steps: int, bent: bool = False) -> tuple[Floats, Floats, Floats]:
    """Equations (6.1), (6.2), (6.4) over all points, `steps` samples between neighbours.

    Args:
        points: shape (n, 2); one more point is extrapolated before the first, after the last.
        steps: samples a piece, at s = 0, 1 / steps, ...; the very last point is added.
        bent: extrapolate with the bend that the outermost three points have, not straight on. For
            points that are evenly spaced, at least three.

    Returns:
        P(s), its first and its second derivative in s, each of shape ((n - 1) steps + 1, 2).
    """
    first, last = (_beyond(end, bent) for end in (points[:3], points[:-4:-1]))
    P = np.concatenate([[first], points, [last]])
    window = np.stack([P[:-3], P[1:-2], P[2:-1], P[3:]])  # (4, n - 1, 2)
    curves: list[Floats] = []
    for row, end in _weights(steps):
        inner = np.einsum("as,aic->isc", row, window).reshape(-1, 2)
        curves.append(np.concatenate([inner, np.einsum("as,ac->sc", end, window[:, -1])]))
    return curves[0], curves[1], curves[2]


def _beyond(end: Floats, bent: bool) -> Floats:
    """The point before the first of `end`."""
    return 3 * end[0] - 3 * end[1] + end[2] if bent else 2 * end[0] - end[1]


@lru_cache(maxsize=8)
def _weights(steps: int) -> tuple[tuple[Floats, Floats], ...]:
    """P, P' and P'' each: its coefficients at the samples of a piece, and at the very end."""
    samples, end = _coefficients(np.arange(steps) / steps), _coefficients(np.ones(1))
    return tuple(zip(samples, end, strict=True))


def _coefficients(s: Floats) -> tuple[Floats, Floats, Floats]:
    """A_0 to A_3 of (6.4) and their first two derivatives, each of shape (4, len(s))."""
    s2, s3 = s * s, s * s * s
    A = np.stack([-s + 2 * s2 - s3, 2 - 5 * s2 + 3 * s3, s + 4 * s2 - 3 * s3, -s2 + s3]) / 2
    dA = np.stack([-1 + 4 * s - 3 * s2, -10 * s + 9 * s2, 1 + 8 * s - 9 * s2, -2 * s + 3 * s2]) / 2
    ddA = np.stack([4 - 6 * s, -10 + 18 * s, 8 - 18 * s, -2 + 6 * s]) / 2
    return A, dA, ddA


def _segments(route_arc: Floats, waypoints: Waypoints) -> NDArray[np.int64]:
    corner = arc_of(waypoints.position_m)
    at = np.searchsorted(corner, route_arc, side="right") - 1
    return np.clip(at, 0, waypoints.segments - 1)


def project(path: SmoothPath, point: Floats, near_index: int, window: int = 40) -> Projection:
    """The nearest place on the path, searched `window` samples to either side of `near_index`.

    Args:
        path: the smooth path.
        point: shape (2,), frame N, [m].
        near_index: where it was last time; any integer, clipped to the path.
        window: samples; 40 are at most 20 m.
    """
    near = min(max(near_index, 0), len(path.arc_m) - 1)
    low = max(near - window, 0)
    offset = point - path.position_m[low : near + window + 1]
    x, y = offset.T
    k = int((x * x + y * y).argmin())
    index = low + k
    dx, dy = float(offset[k, 0]), float(offset[k, 1])
    heading = float(path.heading_rad[index])
    c, s = math.cos(heading), math.sin(heading)
    return Projection(index, c * dy - s * dx, float(path.arc_m[index]) + c * dx + s * dy)
