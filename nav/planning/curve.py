"""A sampled plane curve, and the Catmull-Rom cubic (6.1), (6.4) through points."""

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np

from nav.messages import Floats
from nav.route.rounding import arc_of
from nav.route.smooth_path import catmull_rom

SAMPLES = 6
"""Per piece between two points."""


@dataclass(frozen=True, eq=False)
class Curve:
    """Samples of a curve in the route frame N."""

    position_m: Floats
    """Shape (k, 2)."""
    heading_rad: Floats
    """Shape (k,), of the tangent."""
    curvature_per_m: Floats
    """Shape (k,), left positive."""
    arc_m: Floats
    """Shape (k,), from the first sample."""


def curve_through(points_m: Floats) -> Curve:
    """The curve (6.1) with coefficients (6.4) through evenly spaced `points_m`, shape (n, 2).

    Its ends are bent like their neighbourhood: a path that is made anew at every decision is
    followed by its first metre only.
    """
    return _through(points_m.tobytes())


@lru_cache(maxsize=1)
def _through(points: bytes) -> Curve:
    """Both controllers ask for it: the high-level one looks along it, the low-level one follows."""
    points_m = np.frombuffer(points).reshape(-1, 2)
    position, tangent, second = catmull_rom(points_m, SAMPLES, bent=True)
    speed = np.maximum(np.hypot(tangent[:, 0], tangent[:, 1]), 1e-6)
    bend = (tangent[:, 0] * second[:, 1] - tangent[:, 1] * second[:, 0]) / speed**3
    heading = _directions(tangent)
    return Curve(position, heading, bend, arc_of(position))


def sampled(position_m: Floats) -> Curve:
    """Heading, curvature and arc of a dense polyline, shape (k, 2), by differences."""
    step = position_m[1:] - position_m[:-1]
    length = np.hypot(step[:, 0], step[:, 1])
    direction = _directions(step)
    middle = 0.5 * (direction[:-1] + direction[1:])
    heading = np.concatenate([[direction[0]], middle, [direction[-1]]])
    bend = (direction[1:] - direction[:-1]) / np.maximum(0.5 * (length[:-1] + length[1:]), 1e-6)
    inner = bend if len(bend) else np.zeros(1)
    curvature = np.concatenate([[inner[0]], bend, [inner[-1]]])
    arc = np.concatenate([[0.0], length.cumsum()])
    return Curve(position_m, heading, curvature, arc)


def _directions(vectors: Floats) -> Floats:
    """Of vectors (k, 2) along a curve, continuous; np.unwrap is slow, and jumps are rare."""
    direction = np.arctan2(vectors[:, 1], vectors[:, 0])
    return np.unwrap(direction) if direction.max() - direction.min() > pi else direction


def nearest_index(curve: Curve, x_m: float, y_m: float) -> int:
    """The sample nearest to a place."""
    dx, dy = curve.position_m[:, 0] - x_m, curve.position_m[:, 1] - y_m
    return int((dx * dx + dy * dy).argmin())


def resampled(curve: Curve, arc_m: Floats) -> Floats:
    """Positions (n, 2) at arcs (n,) by linear interpolation."""
    x = np.interp(arc_m, curve.arc_m, curve.position_m[:, 0])
    y = np.interp(arc_m, curve.arc_m, curve.position_m[:, 1])
    return np.stack([x, y], axis=1)
