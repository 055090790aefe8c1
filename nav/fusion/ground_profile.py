"""The ground's height around the vehicle, as far as it is known, and a bound where it is not.

A point is an obstacle when ground could not rise to it from the ground that is known nearby: the
slope-based filter of Vosselman (2000, "Slope based filtering of laser altimetry data"), on cells.

- Steep beams (the roof scanner's) that end near the bound teach a cell its height. Shallow beams
  never teach: their line across a rise looks just like a wall. They are only judged.
- In and beside known cells the bound is the lowest of a cell and its neighbours, plus `slope` for
  the way: a step within a metre is an obstacle, a bank steeper than about 0.25 too, however well known.
- Elsewhere the known ground is continued along its trend ahead (a plane through the reference
  point, which takes in the attitude's bias) and may bend up by `curvature_pm` / 2 * distance^2.
- Farther than `reach_m` from known ground the same holds from the vehicle itself, which says
  little: a rise cannot be told from a wall before the steep beams have swept its foot.
- Behind the vehicle only what is known is judged: the trend there is another.
- What was taken for ground in doubt (a wall before the first start) stays within `doubt_m` of the
  continued ground and so becomes an obstacle on approach.

Heights are relative to a datum. The vehicle's own height follows from the way driven and the
measured pitch, drawn to the known ground under the wheels; a constant pitch bias tilts the whole
apparent world and so changes no difference of heights. Ditches are not looked for.
"""

from math import cos, sin, tan

import numpy as np
from numpy.typing import NDArray

from nav.fusion.lattice import Ints, Lattice
from nav.fusion.scan_geometry import Pose
from nav.messages import Floats
from nav.parameters.obstacle_map import GroundParameters

UNKNOWN_M = 1e6
"""Height of a cell of which nothing is known; finite, so that sums stay numbers."""
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
        self._wheel_m = wheel_m
        self.lattice = Lattice(parameters.cell_m, round(size_m / parameters.cell_m))
        self.height_m = self._unknown()
        """Shape (count, count), above the datum; UNKNOWN_M where not known."""
        self.vehicle_m = 0.0
        """Height of the reference point above the datum."""
        self._bound = self._unknown()
        self._pose: Pose | None = None

    def _unknown(self) -> Floats:
        return np.full((self.lattice.count, self.lattice.count), UNKNOWN_M)

    def recentre(self, x_m: float, y_m: float) -> None:
        """Move the lattice so that (x_m, y_m) lies in its middle."""
        to = self.lattice.centred(x_m, y_m)
        self.height_m = self.lattice.moved(self.height_m, to, UNKNOWN_M)
        self.lattice = to

    def drive(self, pose: Pose) -> None:
        """Follow the vehicle to `pose`, then renew the bound from all that is known."""
        last = self._pose or pose
        ahead = np.array([cos(pose.heading_rad), sin(pose.heading_rad)])
        way = (pose.x_m - last.x_m) * ahead[0] + (pose.y_m - last.y_m) * ahead[1]
        self.vehicle_m -= way * tan(pose.pitch_rad)
        self._stand(pose, ahead)
        self._pose = pose
        self._bound = self._renewed_bound(pose, ahead)

    def _stand(self, pose: Pose, ahead: Floats) -> None:
        """What is under the wheels is ground; where it is known, it draws the vehicle to it."""
        left = np.array([-ahead[1], ahead[0]])
        place = self._wheel_m[:, :1] * ahead + self._wheel_m[:, 1:] * left
        index, inside = self.lattice.index(pose.x_m + place[:, 0], pose.y_m + place[:, 1])
        plane = self._plane(pose, ahead) @ place.T
        cells = self.height_m.ravel()
        index, plane = index[inside], plane[inside]
        known = cells[index] < UNKNOWN_M
        if known.any():
            offset = float(np.mean((cells[index] - plane)[known])) - self.vehicle_m
            self.vehicle_m += 0.2 * min(max(offset, -0.2), 0.2)
        cells[index[~known]] = self.vehicle_m + plane[~known]

    @staticmethod
    def _plane(pose: Pose, ahead: Floats) -> Floats:
        """Slope of the vehicle's own plane eastwards and northwards, shape (2,)."""
        left = np.array([-ahead[1], ahead[0]])
        return -tan(pose.pitch_rad) * ahead + tan(pose.roll_rad) * left

    # ------------------------------------------------------------------ bound

    def _renewed_bound(self, pose: Pose, ahead: Floats) -> Floats:
        far = self._far_bound(pose, ahead)
        near = self._near_bound()
        return np.where(
            near < 0.5 * UNKNOWN_M, np.minimum(near, far + self.parameters.doubt_m), far
        )

    def _near_bound(self) -> Floats:
        rise = self.parameters.slope * self.parameters.cell_m
        return _eroded(self.height_m, np.array([rise]))

    def _far_bound(self, pose: Pose, ahead: Floats) -> Floats:
        """The trend, bent up away from known ground: a parabola's erosion, which is separable."""
        pooled = _pooled(self.height_m)
        cell_m = 2 * self.parameters.cell_m
        centre = (np.arange(len(pooled), dtype=np.float64) + 0.5) * cell_m
        east = centre + (self.lattice.origin_m[0] - pose.x_m)
        north = centre + (self.lattice.origin_m[1] - pose.y_m)
        slope = self._trend(pooled, east, north, self._plane(pose, ahead), ahead)
        trend = slope[0] * east + slope[1] * north[:, None]
        steps = np.arange(cell_m, self.parameters.reach_m + 0.5 * cell_m, cell_m, dtype=np.float64)
        bend = 0.5 * self.parameters.curvature_pm
        bound = _eroded(pooled - trend, bend * steps**2)
        guess = self.vehicle_m + bend * (east**2 + north[:, None] ** 2)
        bound = np.where(bound < 0.5 * UNKNOWN_M, bound, guess) + trend
        bound[east * ahead[0] + north[:, None] * ahead[1] < -cell_m] = UNKNOWN_M
        return bound.repeat(2, axis=0).repeat(2, axis=1)

    def _trend(
        self, height: Floats, east: Floats, north: Floats, plane: Floats, ahead: Floats
    ) -> Floats:
        """Least-squares slope, shape (2,), of the known ground ahead, through the vehicle."""
        forward = east * ahead[0] + north[:, None] * ahead[1] > 0
        row, column = np.nonzero(forward & (height < UNKNOWN_M))
        place = np.stack([east[column], north[row]])
        normal = place @ place.T + _PRIOR_M2 * np.eye(2)
        right = place @ (height[row, column] - self.vehicle_m) + _PRIOR_M2 * plane
        return np.linalg.solve(normal, right)

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
        above = points[2] + self.vehicle_m - self._bound.ravel()[index]
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
        count = np.bincount(index[teaching], minlength=cells.size)
        total = np.bincount(index[teaching], height_m[teaching], minlength=cells.size)
        count[index[obstacle]] = 0
        taught = np.flatnonzero(count)
        mean = total[taught] / count[taught] + self.vehicle_m
        old = cells[taught]
        gain = np.where(old < UNKNOWN_M, self.parameters.gain, 1.0)
        cells[taught] = old + gain * (mean - old)


def _pooled(height: Floats) -> Floats:
    """Mean of the known cells in each block of two by two, UNKNOWN_M where there are none."""
    known = (height < UNKNOWN_M).astype(np.float64)
    count, total = _blocks(known), _blocks(known * height)
    return np.where(count > 0, total / np.maximum(count, 1.0), UNKNOWN_M)


def _blocks(cells: Floats) -> Floats:
    rows = cells[::2] + cells[1::2]
    return rows[:, ::2] + rows[:, 1::2]


def _eroded(height: Floats, rise: Floats) -> Floats:
    """Lowest of each cell and its neighbours k cells away, plus rise[k - 1], along both axes."""
    for axis in (0, 1):
        source = height if axis == 0 else height.T
        result = source.copy()
        for k, up in enumerate(rise, 1):
            lifted = source + up
            np.minimum(result[k:], lifted[:-k], out=result[k:])
            np.minimum(result[:-k], lifted[k:], out=result[:-k])
        height = result if axis == 0 else result.T
    return height
