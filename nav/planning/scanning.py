"""Scanning distances to the real and the safe boundary (Fig. 6.6), over feasible curves.

A direction is scanned along the curve that the vehicle would drive: a turn of the given radius
until it heads there, then straight on. Straight rays from a mass point would promise directions
that six metres of turning radius cannot keep. The whole outline is moved along the curve, as
discs on the vehicle's axis.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nav.messages import Floats
from nav.parameters.planning import Footprint, Scanning

REAL, SAFE = 2, 1
"""Levels of the boundary grid: inside the real boundary, inside the safe boundary."""
ESCAPE_M = {REAL: 0.8, SAFE: 4.0}
"""Where the vehicle already stands inside a boundary, it may take this far to leave it."""


@dataclass(frozen=True, eq=False)
class Boundaries:
    """The expanded obstacles on the map's lattice: level[iy, ix] of 0, SAFE or REAL."""

    level: NDArray[np.uint8]
    origin_m: tuple[float, float]
    """Position of the lower left corner of cell [0, 0], route frame N."""
    cell_m: float

    def at(self, x_m: Floats, y_m: Floats) -> NDArray[np.uint8]:
        """Levels at positions of any shape; beyond the map all is free."""
        rows, columns = self.level.shape
        ix = ((x_m - self.origin_m[0]) * (1.0 / self.cell_m)).astype(np.int32)
        iy = ((y_m - self.origin_m[1]) * (1.0 / self.cell_m)).astype(np.int32)
        outside = (ix < 0) | (iy < 0) | (ix >= columns) | (iy >= rows)
        flat = np.where(outside, 0, iy * columns + ix)
        return np.where(outside, 0, self.level.ravel()[flat]).astype(np.uint8)


@dataclass(frozen=True, eq=False)
class Fan:
    """Curves into all directions from a vehicle at the origin that heads along x."""

    theta_rad: Floats
    """Shape (n,), directions relative to the heading, left positive."""
    arc_m: Floats
    """Shape (m,), distances along a curve."""
    position_m: Floats
    """Shape (n, m, 2), the reference point."""
    heading_rad: Floats
    """Shape (n, m)."""
    disc_m: Floats
    """Shape (n, m, discs, 2), centres of the footprint's discs."""


def fan(scanning: Scanning, footprint: Footprint, radius_m: float) -> Fan:
    """Curves that turn with `radius_m`, then go straight."""
    half = scanning.half_angle_rad
    theta = np.linspace(-half, half, scanning.directions)
    arc = np.arange(0.0, scanning.max_distance_m + 1e-9, scanning.step_m)
    turned = np.minimum(np.abs(theta)[:, None], arc[None, :] / radius_m)
    straight = arc[None, :] - turned * radius_m
    forward = radius_m * np.sin(turned) + straight * np.cos(turned)
    sideward = radius_m * (1.0 - np.cos(turned)) + straight * np.sin(turned)
    sign = np.sign(theta)[:, None]
    position = np.stack([forward, sign * sideward], axis=-1)
    heading = sign * turned
    return Fan(theta, arc, position, heading, discs(position, heading, footprint))


def discs(position_m: Floats, heading_rad: Floats, footprint: Footprint) -> Floats:
    """Centres of the footprint's discs, shape (..., discs, 2), for poses (..., 2) and (...)."""
    axis = np.stack([np.cos(heading_rad), np.sin(heading_rad)], axis=-1)
    return position_m[..., None, :] + axis[..., None, :] * np.array(footprint.disc_x_m)[:, None]


def scan(
    curves: Fan, boundaries: Boundaries, x_m: float, y_m: float, heading_rad: float
) -> tuple[Floats, Floats]:
    """Distances D_R and D_S, shape (n,) each, [m], from a pose in the frame N."""
    c, s = np.cos(heading_rad), np.sin(heading_rad)
    u, v = curves.disc_m[..., 0], curves.disc_m[..., 1]
    level = boundaries.at(x_m + c * u - s * v, y_m + s * u + c * v).max(axis=-1)
    return free_distance(level, curves.arc_m, REAL), free_distance(level, curves.arc_m, SAFE)


def free_distance(level: NDArray[np.uint8], arc_m: Floats, boundary: int) -> Floats:
    """Distance to the first sample at or above `boundary`, shape (n,) for levels (n, m)."""
    blocked = level >= boundary
    leaving = np.logical_and.accumulate(blocked, axis=-1) & (arc_m < ESCAPE_M[boundary])
    blocked &= ~leaving
    first = blocked.argmax(axis=-1)
    return np.where(blocked.any(axis=-1), arc_m[first], arc_m[-1])
