"""The ground's height around the vehicle, as far as it is known, and a bound where it is not.

A point is an obstacle when ground could not rise to it from the ground that is known nearby: the
slope-based filter of Vosselman (2000, "Slope based filtering of laser altimetry data"), on cells.

- Steep beams (the roof scanner's) that end near the bound teach a cell its height. Shallow beams
  never teach: their line across a rise looks just like a wall. They are only judged.
- In and beside known cells the bound is the lowest of a cell and its neighbours, plus `slope` for
  the way: a step within a metre is an obstacle, and so is a bank steeper than about 0.25.
- Elsewhere the known ground is continued along its trend ahead (a plane through the reference
  point, which takes in the attitude's bias) and may bend up by `curvature_pm` / 2 * distance^2.
- Farther than `reach_m` from known ground the same holds from the vehicle itself, which says
  little: a rise cannot be told from a wall before the steep beams have swept its foot.
- Behind the vehicle only what is known is judged: the trend there is another.
- What was taken for ground in doubt (a wall before the first start) stays within `doubt_m` of the
  continued ground and so becomes an obstacle on approach.

Heights are relative to a datum. The vehicle's own height follows from the way driven and the
measured pitch, drawn to the known ground under the wheels; a constant pitch bias tilts the whole
apparent world and so changes no difference of heights. Drops are looked
for in `negative_obstacles`.
"""

from math import cos, fsum, sin, tan

import numpy as np
from numpy.typing import NDArray

from nav.angles import wrapped
from nav.fusion.lattice import Ints, Lattice
from nav.fusion.scan_geometry import Pose
from nav.messages import Floats
from nav.parameters.obstacle_map import GroundParameters

UNKNOWN_M = 1e6
"""Height of a cell of which nothing is known; finite, so that sums stay numbers."""
_DUE_EACH_M = 0.1
"""The bound is renewed after a cell of way; a tick counts as this much, for what was learned."""
_PULL = 0.2
"""Share of the offset to known ground that the vehicle's height follows, a tick."""
_TILT_WAY_M, _TILT_MAX_RAD, _STANDS_M = 40.0, 0.03, 0.02
"""The tilt is learned over some 40 m: longer than the 15 m that the scanner looks ahead."""
_LEAN_MOST = 0.05
"""A wheel on one side that meets more than this, a metre of track, has met a bump."""
_STRAIGHT_RAD, _STRAIGHT_M = 0.1, 20.0
"""The lean is learned where the vehicle has long gone straight: in a bend the vertical gyro follows
the apparent vertical, and the ground was taught under another roll than it is driven over."""
_NOWHERE = Pose(0.0, 0.0, 0.0, 0.0, 0.0)
_PRIOR_M2 = 50.0
"""Weight of the vehicle's own plane in the trend, as one cell seen at 7 m."""


class GroundProfile:
    """Known ground heights on a coarse lattice, and the bound that tells obstacles from ground.

    Args:
        parameters: `[ground]` of `obstacle_map.toml`.
        size_m: edge of the lattice.
        wheel_m: shape (n, 2), where wheels touch the ground, vehicle frame.
    """

    def __init__(self, parameters: GroundParameters, size_m: float, wheel_m: Floats) -> None:
        self.parameters = parameters
        self._wheel_m = [(float(x), float(y)) for x, y in wheel_m]
        self.lattice = Lattice(parameters.cell_m, round(size_m / parameters.cell_m))
        self.height_m = self._unknown()
        """Shape (count, count), above the datum; UNKNOWN_M where not known."""
        self.vehicle_m = 0.0
        """Height of the reference point above the datum."""
        self._bound = self._unknown()
        self._due = parameters.cell_m  # way since the bound was renewed
        self.tilt_rad = 0.0
        """How much deeper the teaching scanner looks than it is believed to: learned by driving
        over what it taught. Its heights are too high by this times the distance."""
        self.lean_rad = 0.0
        """How much more its left side looks up than it is believed to: learned in the same way.
        Its heights are too low by this times the distance to the left."""
        self._straight_m, self._straight_rad = 0.0, 0.0
        """How far the vehicle has gone straight, and where to."""
        self._pose: Pose | None = None
        self.ahead = (1.0, 0.0)
        """Where the vehicle looks: east and north."""
        self._plane = (0.0, 0.0)

    def _unknown(self) -> Floats:
        return np.full((self.lattice.count, self.lattice.count), UNKNOWN_M)

    def recentre(self, x_m: float, y_m: float) -> None:
        """Move the lattice so that (x_m, y_m) lies in its middle."""
        to = self.lattice.centred(x_m, y_m)
        self.height_m = self.lattice.moved(self.height_m, to, UNKNOWN_M)
        self._bound = self.lattice.moved(self._bound, to, UNKNOWN_M)
        self.lattice = to

    def drive(self, pose: Pose) -> None:
        """Follow the vehicle to `pose`; renew the bound when that is worth it."""
        c, s = cos(pose.heading_rad), sin(pose.heading_rad)
        last = self._pose or pose
        way = (pose.x_m - last.x_m) * c + (pose.y_m - last.y_m) * s
        self.vehicle_m -= way * tan(pose.pitch_rad)
        fore, left = -tan(pose.pitch_rad), tan(pose.roll_rad)
        self._plane = (fore * c - left * s, fore * s + left * c)
        self.ahead = (c, s)
        self._pose = pose
        self._go_straight(pose, abs(way))
        self._stand(pose, abs(way))
        self._due += abs(way) + _DUE_EACH_M
        if self._due >= self.parameters.cell_m:
            self._bound = self._renewed_bound(pose)
            self._due = 0.0

    def _go_straight(self, pose: Pose, way_m: float) -> None:
        if abs(wrapped(pose.heading_rad - self._straight_rad)) > _STRAIGHT_RAD:
            self._straight_rad, self._straight_m = pose.heading_rad, 0.0
        self._straight_m += way_m

    def _stand(self, pose: Pose, way_m: float) -> None:
        """What is under the wheels is ground; where it is known, it draws the vehicle to it."""
        under = [self._under(pose, wheel) for wheel in self._wheel_m]
        heights = [float(self.height_m[cell]) for cell, _ in under]
        offset_m = [
            height - plane - self.vehicle_m if height < UNKNOWN_M else None
            for height, (_, plane) in zip(heights, under, strict=True)
        ]
        known = [offset for offset in offset_m if offset is not None]
        if known:
            self._lean(offset_m, way_m)
            self._draw(fsum(known) / len(known), way_m)
        for (cell, plane), offset in zip(under, offset_m, strict=True):
            if offset is None:
                self.height_m[cell] = self.vehicle_m + plane

    def _under(self, pose: Pose, wheel_m: tuple[float, float]) -> tuple[tuple[int, int], float]:
        """The cell under a wheel, and how high the vehicle's plane lies in its middle: cells are
        coarse, and slopes would drag."""
        (c, s), (x, y) = self.ahead, wheel_m
        cell = self.lattice.cell(pose.x_m + (c * x - s * y), pose.y_m + (s * x + c * y))
        east, north = self.lattice.middle_m(cell)
        plane = self._plane[0] * (east - pose.x_m) + self._plane[1] * (north - pose.y_m)
        return cell, plane

    def _draw(self, offset_m: float, way_m: float) -> None:
        """Draw the vehicle's height to ground that is known to lie higher by the offset."""
        pull = _PULL * min(max(offset_m, -0.2), 0.2)
        self.vehicle_m += pull
        if way_m > _STANDS_M:  # a scanner that looks too deep by b pulls by b a metre of way
            tilt = self.tilt_rad + pull / _TILT_WAY_M
            self.tilt_rad = min(max(tilt, -_TILT_MAX_RAD), _TILT_MAX_RAD)

    def _lean(self, offset_m: list[float | None], way_m: float) -> None:
        """Of an axle whose both wheels stand on known ground: does it rise to one side?"""
        if way_m <= _STANDS_M or self._straight_m < _STRAIGHT_M:
            return
        for (_, right), (_, left), low, high in zip(
            self._wheel_m[::2], self._wheel_m[1::2], offset_m[::2], offset_m[1::2], strict=True
        ):
            if low is not None and high is not None and left > right:  # a point has no sides
                rise = min(max((high - low) / (left - right), -_LEAN_MOST), _LEAN_MOST)
                lean = self.lean_rad - 0.5 * min(way_m / _TILT_WAY_M, 1.0) * rise
                self.lean_rad = min(max(lean, -_TILT_MAX_RAD), _TILT_MAX_RAD)

    def too_high(self, east: Floats, north: Floats, distance_m: Floats | float) -> Floats:
        """By how much the teaching scanner's heights are, at places from the vehicle."""
        c, s = self.ahead
        return self.tilt_rad * distance_m - self.lean_rad * (c * north - s * east)

    # ------------------------------------------------------------------ bound

    def _renewed_bound(self, pose: Pose) -> Floats:
        far = self._far_bound(pose)
        near = self._near_bound()
        return np.where(
            near < 0.5 * UNKNOWN_M, np.minimum(near, far + self.parameters.doubt_m), far
        )

    def _near_bound(self) -> Floats:
        rise = self.parameters.slope * self.parameters.cell_m
        return _eroded(self.height_m, (rise,))

    def _far_bound(self, pose: Pose) -> Floats:
        """The trend, bent up away from known ground: a parabola's erosion, which is separable."""
        p = self.parameters
        blocks, (east, north) = pooled(self.height_m), self.block_centres()
        cell_m, bend = 2 * p.cell_m, 0.5 * p.curvature_pm
        forward = east * self.ahead[0] + north * self.ahead[1]
        slope = self._trend(blocks - self.vehicle_m, (east, north), forward > 0)
        trend = slope[0] * east + slope[1] * north
        steps = range(1, round(p.reach_m / cell_m) + 1)
        bound = _eroded(blocks - trend, tuple(bend * (k * cell_m) ** 2 for k in steps))
        guess = self.vehicle_m + bend * (east * east + north * north)
        bound = np.where(bound < 0.5 * UNKNOWN_M, bound, guess) + trend
        bound[forward < -cell_m] = UNKNOWN_M
        return bound.repeat(2, axis=1).repeat(2, axis=0)

    def block_centres(self) -> tuple[Floats, Floats]:
        """East (m,) and north (m, 1) of the blocks of two by two cells, from the vehicle, [m]."""
        cell_m, pose = 2 * self.parameters.cell_m, self._pose or _NOWHERE
        centre = (np.arange(self.lattice.count // 2, dtype=np.float64) + 0.5) * cell_m
        east = centre + (self.lattice.origin_m[0] - pose.x_m)
        return east, (centre + (self.lattice.origin_m[1] - pose.y_m))[:, None]

    def _trend(
        self, height: Floats, place: tuple[Floats, Floats], ahead: NDArray[np.bool_]
    ) -> tuple[float, float]:
        """Least-squares slope of the known ground ahead, through the vehicle; normal equations."""
        weight = (ahead & (height < 0.5 * UNKNOWN_M)).astype(np.float64)
        east, north = place[0], place[1][:, 0]
        columns, rows = weight.sum(axis=0), weight.sum(axis=1)
        weighted = weight * height
        ee = float(columns @ (east * east)) + _PRIOR_M2
        nn = float(rows @ (north * north)) + _PRIOR_M2
        en = float(north @ weight @ east)
        e = float(weighted.sum(axis=0) @ east) + _PRIOR_M2 * self._plane[0]
        n = float(weighted.sum(axis=1) @ north) + _PRIOR_M2 * self._plane[1]
        scale = ee * nn - en * en
        return (nn * e - en * n) / scale, (ee * n - en * e) / scale

    # ------------------------------------------------------------------ points

    def classify(
        self, points: Floats, distance_m: Floats
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_], Ints]:
        """Tell obstacles from ground.

        Args:
            points: shape (3, n), level frame: east, north, height above the reference point.
            distance_m: shape (n,), from the vehicle.

        Returns:
            obstacle, ground: shape (n,), bool; never both. index: flat cell of each point.
        """
        p = self.parameters
        index, inside = self.lattice.index(points[0], points[1])
        above = points[2] + self.vehicle_m - self._bound.ravel().take(index)
        high = above > p.step_m + p.tilt_rad * distance_m
        return high & inside & (above < p.clearance_m), ~high & inside, index

    def learn(
        self,
        index: Ints,
        height_m: Floats,
        teaching: NDArray[np.bool_],
        obstacle: NDArray[np.bool_],
    ) -> None:
        """Take in ground points.

        Args:
            index: shape (n,), as from `classify`.
            height_m: shape (n,), above the reference point.
            teaching: shape (n,), ground points of steep beams.
            obstacle: shape (n,); cells with an obstacle learn nothing.
        """
        cells = self.height_m.ravel()
        lesson = index[teaching]
        count = np.bincount(lesson, minlength=cells.size)
        total = np.bincount(lesson, height_m[teaching], minlength=cells.size)
        count[index[obstacle]] = 0
        taught = np.flatnonzero(count > 0)  # of bools: twice as fast
        mean = total[taught] / count[taught] + self.vehicle_m
        old = cells[taught]
        gain = np.where(old < UNKNOWN_M, self.parameters.gain, 1.0)
        cells[taught] = old + gain * (mean - old)


def pooled(height: Floats) -> Floats:
    """Mean of the known cells in each block of two by two, UNKNOWN_M where there are none."""
    known = (height < UNKNOWN_M).astype(np.float64)
    count, total = _blocks(known), _blocks(known * height)
    return np.where(count > 0, total / np.maximum(count, 1.0), UNKNOWN_M)


def _blocks(cells: Floats) -> Floats:
    rows = cells[::2] + cells[1::2]
    return rows[:, ::2] + rows[:, 1::2]


def _eroded(height: Floats, rise: tuple[float, ...]) -> Floats:
    """Lowest of each cell and its neighbours k cells away, plus rise[k - 1], along both axes."""
    for _ in range(2):  # whole rows are lowered at a time: twice as quick as columns
        result = height.copy()
        for k, up in enumerate(rise, 1):
            lifted = height + up
            np.minimum(result[k:], lifted[:-k], out=result[k:])
            np.minimum(result[:-k], lifted[k:], out=result[:-k])
        height = np.ascontiguousarray(result.T)
    return height
