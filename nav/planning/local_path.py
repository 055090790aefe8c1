"""The local path of ten pathpoints (section 6.4): along the route, or in a decided direction."""

from math import cos, sin, sqrt

import numpy as np

from nav.messages import Floats
from nav.parameters.planning import Footprint, LocalPathParameters
from nav.planning.angles import wrapped
from nav.planning.curve import Curve, resampled, sampled
from nav.planning.scanning import REAL, SAFE, Boundaries, Fan, discs, free_distance
from nav.route.smooth_path import SmoothPath

PATHPOINTS = 10
FIFTH = 4
"""Index of the pathpoint at which a new local path is due (Fig. 6.4)."""
AHEAD_M = 30.0
"""The route is looked at this far ahead."""


def path_length(speed_mps: float, p: LocalPathParameters) -> float:
    """Length of a local path at a speed, [m]."""
    return min(max(p.horizon_s * speed_mps, p.min_length_m), p.max_length_m)


def pathpoints(curve: Curve, length_m: float) -> Floats:
    """Ten points, shape (10, 2), evenly along the first `length_m` of a curve."""
    return resampled(curve, np.linspace(0.0, min(length_m, float(curve.arc_m[-1])), PATHPOINTS))


def route_ahead(
    route: SmoothPath, index: int, offset_m: float, heading_rad: float, p: LocalPathParameters
) -> Curve:
    """The smooth path from sample `index` on, joined from the vehicle's offset and heading.

    The offset is taken back on a cubic whose length keeps it no tighter than `join_radius_m`.
    """
    first = min(index, len(route.arc_m) - 2)
    end = int(np.searchsorted(route.arc_m, route.arc_m[first] + AHEAD_M)) + 1
    part = slice(first, max(end, first + 2))
    position, heading = route.position_m[part], route.heading_rad[part]
    if abs(offset_m) > p.join_offset_m:
        turned = wrapped(heading_rad - float(heading[0]))
        e = _join(route.arc_m[part] - route.arc_m[first], offset_m, turned, p)
        left: Floats = np.stack([-np.sin(heading), np.cos(heading)], axis=1)
        position = position + e[:, None] * left
    return sampled(position)


def _join(arc_m: Floats, offset_m: float, turned_rad: float, p: LocalPathParameters) -> Floats:
    length = max(6.0, sqrt(6.0 * abs(offset_m) * p.join_radius_m))
    slope = min(max(turned_rad, -0.5), 0.5) * length
    u = np.minimum(arc_m / length, 1.0)
    return offset_m * (1 - 3 * u**2 + 2 * u**3) + slope * (u - 2 * u**2 + u**3)


def towards(curves: Fan, row: int, x_m: float, y_m: float, heading_rad: float) -> Curve:
    """The fan's curve of a direction, placed at a pose."""
    c, s = cos(heading_rad), sin(heading_rad)
    u, v = curves.position_m[row, :, 0], curves.position_m[row, :, 1]
    return sampled(np.stack([x_m + c * u - s * v, y_m + s * u + c * v], axis=1))


def clear_distances(
    curve: Curve, boundaries: Boundaries, footprint: Footprint
) -> tuple[float, float]:
    """Distance along a curve before the outline enters the real and the safe boundary, [m]."""
    centres = discs(curve.position_m, curve.heading_rad, footprint)
    level = boundaries.at(centres[..., 0], centres[..., 1]).max(axis=-1)[None, :]
    real = free_distance(level, curve.arc_m, REAL)
    safe = free_distance(level, curve.arc_m, SAFE)
    return float(real[0]), float(safe[0])
