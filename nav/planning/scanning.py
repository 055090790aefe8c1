"""Scanning distances to the real and the safe boundary (Fig. 6.6), over feasible curves.

A direction is scanned along the curve that the vehicle would drive: steering answers late, winds
up no faster than it can, unwinds, and then goes straight on. Straight rays from a mass point would
promise directions that six metres of turning radius and two seconds to the lock cannot keep. The
whole outline is moved along the curve, as discs on the vehicle's axis.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import cos, sin
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from nav.messages import Floats, frozen
from nav.parameters.planning import Footprint, Scanning
from nav.planning.boundaries import REAL, SAFE, TOUCH

Singles = NDArray[np.float32]
Reals = TypeVar("Reals", Floats, Singles)


@dataclass(frozen=True, eq=False)
class Boundaries:
    """The expanded obstacles on the map's lattice: level[iy, ix] of FREE, SAFE, REAL or TOUCH."""

    level: NDArray[np.uint8]
    origin_m: tuple[float, float]
    """Position of the lower left corner of cell [0, 0], route frame N."""
    cell_m: float

    def at(self, x_m: Floats, y_m: Floats) -> NDArray[np.uint8]:
        """Levels at positions of any shape; beyond the map all is free."""
        per_m = 1.0 / self.cell_m
        return self.of_cells((x_m - self.origin_m[0]) * per_m, (y_m - self.origin_m[1]) * per_m)

    def of_cells(self, column: Reals, row: Reals) -> NDArray[np.uint8]:
        """Levels at positions in cells from the lower left corner."""
        count = len(self.level)
        ix, iy = column.astype(np.int32), row.astype(np.int32)
        # as unsigned numbers, what is negative is large: one comparison for both ends
        inside = (ix.view(np.uint32) < count) & (iy.view(np.uint32) < count)
        return self.level.take(iy * count + ix, mode="clip") * inside


@dataclass(frozen=True)
class Turning:
    """How the vehicle can turn from here on, per metre of way."""

    curvature_per_m: float
    """Present curvature, left positive."""
    delay_m: float
    """Way before steering answers."""
    rate_per_m2: float
    """Change of curvature per metre."""
    limit_per_m: float
    """Largest curvature: of the steering, and of the lateral acceleration at this speed."""


@dataclass(frozen=True, eq=False)
class Fan:
    """Curves into all directions from a vehicle at the origin that heads along x.

    Places are in single precision, half the time for a hundredth of a millimetre.
    """

    theta_rad: Floats
    """Shape (n,), directions relative to the heading, left positive."""
    arc_m: Floats
    """Shape (m,), distances along a curve."""
    position_m: Singles
    """Shape (2, n, m), x and y of the reference point."""
    heading_rad: Floats
    """Shape (n, m)."""
    disc_m: Singles
    """Shape (2, discs, n, m), x and y of the centres of the footprint's discs."""


def fan(scanning: Scanning, footprint: Footprint, turning: Turning) -> Fan:
    """Curves that wind the steering up, hold it, and unwind it so that they end in a direction."""
    theta, arc = _samples(scanning)
    bend = _bend(theta, arc, turning)
    heading = np.zeros_like(bend)
    (0.5 * (bend[:, 1:] + bend[:, :-1]) * scanning.step_m).cumsum(axis=1, out=heading[:, 1:])
    middle = (0.5 * (heading[:, 1:] + heading[:, :-1])).astype(np.float32)
    position = np.zeros((2, *bend.shape), np.float32)
    (scanning.step_m * np.cos(middle)).cumsum(axis=1, out=position[0, :, 1:])
    (scanning.step_m * np.sin(middle)).cumsum(axis=1, out=position[1, :, 1:])
    centres = discs(position, heading.astype(np.float32), footprint)
    return Fan(theta, arc, position, heading, centres)


@lru_cache
def _samples(scanning: Scanning) -> tuple[Floats, Floats]:
    """Directions (n,) and distances (m,): the same in every fan, so nobody may change them."""
    theta = np.linspace(-scanning.half_angle_rad, scanning.half_angle_rad, scanning.directions)
    arc = np.arange(0.0, scanning.max_distance_m + 1e-9, scanning.step_m)
    return frozen(theta), frozen(arc)


def _bend(theta: Floats, arc: Floats, t: Turning) -> Floats:
    """Curvature (n, m) along each curve: now, up to a peak, held, back to zero.

    The area under it is theta. With k0 now, peak p and slope r, winding up and back turns by
    (2 p^2 - k0^2) / 2r; what the largest peak leaves is turned while it is held.
    """
    r, k = t.rate_per_m2, t.curvature_per_m
    left = theta - k * t.delay_m
    sign = np.where(left >= k * abs(k) / (2.0 * r), 1.0, -1.0)
    k0, turn = sign * k, sign * left
    peak = np.sqrt(np.maximum(r * turn + 0.5 * k0**2, 0.0))
    peak = np.maximum(np.minimum(peak, np.maximum(t.limit_per_m, k0)), np.maximum(k0, 0.0))
    rest = np.maximum(turn - (2.0 * peak**2 - k0**2) / (2.0 * r), 0.0)
    held = (peak - k0) / r + rest / np.maximum(peak, 1e-9)
    wound = r * (arc - t.delay_m)
    rising = np.minimum(k0[:, None] + np.maximum(wound, 0.0), peak[:, None])
    falling = np.maximum((peak + r * held)[:, None] - wound, 0.0)  # above the peak until then
    return sign[:, None] * np.minimum(rising, falling)


def discs(position_m: Reals, heading_rad: Reals, footprint: Footprint) -> Reals:
    """Centres of the footprint's discs, shape (2, discs, ...), for poses (2, ...) and (...)."""
    axis = np.array([np.cos(heading_rad), np.sin(heading_rad)])
    ahead = np.array(footprint.disc_x_m, heading_rad.dtype)
    ahead = ahead.reshape(-1, *(1 for _ in heading_rad.shape))
    return position_m[:, None] + axis[:, None] * ahead


class Distances(NamedTuple):
    """Scanning distances, shape (n,) each, [m]."""

    safe_m: Floats
    """D_S."""
    real_m: Floats
    """D_R."""
    touch_m: Floats
    """Before the outline itself touches: what the speed must respect."""


def scan(
    curves: Fan,
    boundaries: Boundaries,
    footprint: Footprint,
    x_m: float,
    y_m: float,
    heading_rad: float,
) -> Distances:
    """Distances to all boundaries from a pose in the frame N."""
    per_m = 1.0 / boundaries.cell_m
    column, row = (x_m - boundaries.origin_m[0]) * per_m, (y_m - boundaries.origin_m[1]) * per_m
    c, s = cos(heading_rad) * per_m, sin(heading_rad) * per_m
    u, v = curves.disc_m
    level = boundaries.of_cells(column + c * u - s * v, row + s * u + c * v).max(axis=0)
    safe, real, touch = (
        free_distance(level, curves.arc_m, boundary, footprint) for boundary in (SAFE, REAL, TOUCH)
    )
    real = np.minimum(real, touch)  # who leaves an outer boundary may meet an inner one meanwhile
    return Distances(np.minimum(safe, real), real, touch)


def free_distance(
    level: NDArray[np.uint8], arc_m: Floats, boundary: int, footprint: Footprint
) -> Floats:
    """Distance to the first sample at or above `boundary`, shape (n,) for levels (n, m).

    Rows that start inside the boundary are free where they leave it soon enough.
    """
    blocked = level >= boundary
    if blocked[:, 0].any():
        blocked &= ~_leaving(level, blocked, arc_m, boundary, footprint)
    first = blocked.argmax(axis=-1)
    met = blocked[np.arange(len(first)), first]
    return np.where(met, arc_m[first], arc_m[-1])


def _leaving(
    level: NDArray[np.uint8],
    blocked: NDArray[np.bool_],
    arc_m: Floats,
    boundary: int,
    foot: Footprint,
) -> NDArray[np.bool_]:
    """The samples (n, m) by which a row that starts inside a boundary leaves it in time."""
    inside = np.logical_and.accumulate(blocked, axis=-1)
    way = arc_m[np.minimum(inside.sum(axis=-1), len(arc_m) - 1)]
    scrapes = (inside & (level >= TOUCH) & (arc_m >= foot.escape_touch_m)).any(axis=-1)
    way = np.where(scrapes, np.inf, way)
    slack = {SAFE: foot.escape_m, REAL: foot.escape_slack_m, TOUCH: foot.escape_touch_m}
    in_time = way <= min(float(way.min()) + slack[boundary], foot.escape_m)
    return inside & in_time[:, None]
