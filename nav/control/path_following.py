"""Steering along ten pathpoints: feedback on the pose at which steering will answer."""

from dataclasses import dataclass
from math import atan2, cos, hypot, sin

import numpy as np

from nav.parameters.control import PathFollowing
from nav.planning.curve import Curve, nearest_index


@dataclass(frozen=True)
class PathError:
    """Where a pose lies relative to a curve."""

    arc_m: float
    offset_m: float
    """Left of the curve is positive."""
    heading_rad: float


def path_error(curve: Curve, x_m: float, y_m: float, heading_rad: float) -> PathError:
    """Project a pose onto the curve, which goes on straight beyond its ends."""
    i = nearest_index(curve, x_m, y_m)
    heading, bend = float(curve.heading_rad[i]), float(curve.curvature_per_m[i])
    dx, dy = x_m - float(curve.position_m[i, 0]), y_m - float(curve.position_m[i, 1])
    c, s = cos(heading), sin(heading)
    along, offset = c * dx + s * dy, c * dy - s * dx
    turned = heading_rad - heading - bend * along
    return PathError(float(curve.arc_m[i]) + along, offset, atan2(sin(turned), cos(turned)))


def bend_ahead(curve: Curve, arc_m: float, way_m: float) -> float:
    """Mean curvature of the curve from `arc_m` over the next `way_m`, [1/m]."""
    ends = np.interp((arc_m, arc_m + max(way_m, 0.2)), curve.arc_m, curve.heading_rad)
    return float(ends[1] - ends[0]) / max(way_m, 0.2)


def curvature_command(
    error: PathError, bend_per_m: float, speed_mps: float, p: PathFollowing
) -> float:
    """Curvature [1/m] that takes offset and heading error back, damped over a length.

    Args:
        error: where the vehicle is relative to the curve.
        bend_per_m: curvature of the path itself, ahead.
        speed_mps: forward.
        p: gains.
    """
    length = hypot(p.length_m, p.length_s * max(speed_mps, 0.0))
    approach = -error.offset_m / (2.0 * p.damping * length)
    approach = min(max(approach, -p.heading_limit_rad), p.heading_limit_rad)
    return bend_per_m + 2.0 * p.damping / length * (approach - error.heading_rad)
