"""The local path of ten pathpoints (section 6.4): along the route, or in a decided direction."""

from dataclasses import dataclass
from math import cbrt, cos, sin

import numpy as np
from numpy.typing import NDArray

from nav.messages import Floats
from nav.parameters.planning import Footprint, LocalPathParameters
from nav.planning.boundaries import REAL, SAFE, TOUCH
from nav.planning.curve import Curve, resampled, sampled
from nav.planning.scanning import Boundaries, Fan, discs, free_distance
from nav.route.smooth_path import SmoothPath

PATHPOINTS = 10
FIFTH = 4
"""Index of the pathpoint at which a new local path is due (Fig. 6.4)."""


def path_length(speed_mps: float, p: LocalPathParameters) -> float:
    """Length of a local path at a speed, [m]."""
    return min(max(p.horizon_s * speed_mps, p.min_length_m), p.max_length_m)


def pathpoints(curve: Curve, length_m: float) -> Floats:
    """Ten points, shape (10, 2), evenly along the first `length_m` of a curve."""
    return resampled(curve, np.linspace(0.0, min(length_m, float(curve.arc_m[-1])), PATHPOINTS))


def route_ahead(
    route: SmoothPath,
    index: int,
    offset_m: float,
    turned_rad: float,
    join_m: float,
    look_ahead_m: float,
) -> Curve:
    """The smooth path from sample `index` on, joined from the vehicle's offset and heading.

    Args:
        route: the smooth path of the whole route.
        index: the sample beside the vehicle.
        offset_m: how far left of the path the vehicle is; taken back on a cubic ...
        turned_rad: ... that starts this far left of the path's heading ...
        join_m: ... and takes this way; 0 where the vehicle is on the path.
        look_ahead_m: how much of it.
    """
    first = min(index, len(route.arc_m) - 2)
    end = int(route.arc_m.searchsorted(float(route.arc_m[first]) + look_ahead_m)) + 1
    part = slice(first, max(end, first + 2))
    position, heading = route.position_m[part], route.heading_rad[part]
    arc = route.arc_m[part] - route.arc_m[first]
    if join_m <= 0.0:
        return Curve(position, heading, route.curvature_per_m[part], arc)
    e = _join(arc, offset_m, turned_rad, join_m)
    left: Floats = np.array([-np.sin(heading), np.cos(heading)]).T
    return sampled(position + e[:, None] * left)


def join_length(
    offset_m: float, speed_mps: float, rate_per_m_s: float, p: LocalPathParameters
) -> float:
    """Way over which a lateral offset is taken back, [m].

    Steering left, right and left again at a curvature rate j for a time T moves a vehicle by
    v^2 j T^3 / 32 sideways.
    """
    if abs(offset_m) < p.join_offset_m:
        return 0.0
    shortest = cbrt(32.0 * abs(offset_m) * max(speed_mps, 1.0) / rate_per_m_s)
    return max(p.join_stretch * shortest, p.join_min_m)


def _join(arc_m: Floats, offset_m: float, turned_rad: float, join_m: float) -> Floats:
    slope = min(max(turned_rad, -0.5), 0.5) * join_m
    u = np.minimum(arc_m / join_m, 1.0)
    return offset_m * (1 - 3 * u**2 + 2 * u**3) + slope * (u - 2 * u**2 + u**3)


def towards(curves: Fan, row: int, x_m: float, y_m: float, heading_rad: float) -> Curve:
    """The fan's curve of a direction, placed at a pose."""
    c, s = cos(heading_rad), sin(heading_rad)
    u, v = curves.position_m[:, row].astype(np.float64)
    return sampled(np.stack([x_m + c * u - s * v, y_m + s * u + c * v], axis=1))


@dataclass(frozen=True, eq=False)
class Clear:
    """Distances along a curve before the outline enters a boundary, [m]: few are asked for."""

    level: NDArray[np.uint8]
    """Shape (1, k), of the samples: the highest of the outline's."""
    highest: int
    """Of all."""
    arc_m: Floats
    """Shape (k,), of the samples."""
    footprint: Footprint

    @property
    def safe_m(self) -> float:
        """Before the safe boundary."""
        return self._before(SAFE)

    @property
    def real_m(self) -> float:
        """Before the real boundary."""
        return self._before(REAL)

    @property
    def touch_m(self) -> float:
        """Before the outline itself touches."""
        return self._before(TOUCH)

    def _before(self, boundary: int) -> float:
        if self.highest < boundary:  # mostly
            return float(self.arc_m[-1])
        return float(free_distance(self.level, self.arc_m, boundary, self.footprint)[0])


def clear_distances(curve: Curve, boundaries: Boundaries, footprint: Footprint) -> Clear:
    """How far a curve is free of each boundary."""
    x, y = discs(curve.position_m.T, curve.heading_rad, footprint)
    level = boundaries.at(x, y).max(axis=0)
    return Clear(level[None, :], int(level.max()), curve.arc_m, footprint)
