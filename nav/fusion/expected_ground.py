"""Where ground should be that has not been seen yet: a plane, and a floor below it.

The ground that is known is continued into what is not: along the plane of its last metres ahead,
bent down by at most `curvature_pm` / 2 * distance^2. That is the mirror image of the bound by which
`ground_profile` tells obstacles from ground.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.fusion.ground_profile import UNKNOWN_M, GroundProfile, pooled
from nav.fusion.lattice import Kind
from nav.messages import Floats
from nav.parameters.obstacle_map import NegativeParameters

Bools = NDArray[np.bool_]

LEAST_TOGETHER = 4
"""Known blocks among a block and its eight neighbours, itself included."""
LEAST_BLOCKS, LEAST_FAR, SPREAD = 12, 4, 1e-3
"""So much of the ground ahead must be known for a plane, and of its far part to tell drops by: not
where the beams have been thrown far ahead. And what keeps the equations regular."""


class Plane(NamedTuple):
    """Through the known ground ahead; origin at the reference point, level axes."""

    height_m: float
    """At the vehicle."""
    east: float
    north: float
    """Slopes."""
    far: bool
    """Whether it rests on ground far ahead, too."""

    def rise(self, east: Floats, north: Floats) -> Floats:
        """What the slopes make of a way."""
        return self.east * east + self.north * north

    def over(self, point_m: Floats) -> Floats:
        """How far points (3, n), from the vehicle, lie above it, (n,)."""
        return point_m[2] - self.height_m - self.rise(point_m[0], point_m[1])


def _plane_of(ground: GroundProfile, p: NegativeParameters) -> Plane | None:
    """The plane by least squares, if enough of the ground ahead is known."""
    height = ground.height_m[::2, ::2]  # one of four cells
    east, north = (place - 0.5 * ground.lattice.cell_m for place in ground.block_centres())
    forward = ground.ahead[0] * east + ground.ahead[1] * north
    near, far = p.frontier_m
    cells = np.flatnonzero((height < 0.5 * UNKNOWN_M) & (forward > near))
    far_out = int(np.count_nonzero(forward.ravel()[cells] > far))
    if cells.size < LEAST_BLOCKS:
        return None
    row, column = np.divmod(cells, len(height))
    A = np.ones((3, cells.size))
    A[1], A[2] = east[column], north[row, 0]
    normal = A @ A.T + SPREAD * np.eye(3)
    lifted = height.ravel()[cells] - ground.vehicle_m
    return Plane(*np.linalg.solve(normal, A @ lifted).tolist(), far=far_out >= LEAST_FAR)


class Floor(NamedTuple):
    """How low ground may lie, above the plane, in blocks of two by two cells of the profile."""

    over_m: Floats
    """Shape (m, m); -UNKNOWN_M far from known ground."""
    corner_m: tuple[float, float]
    """South-west corner of the first block, from the vehicle."""
    block_m: float

    def at(self, east: Floats, north: Floats) -> Floats:
        """The floor at places, from the vehicle, [m]."""
        scale, count = 1.0 / self.block_m, len(self.over_m)
        column = np.floor((east - self.corner_m[0]) * scale).astype(np.int64)
        row = np.floor((north - self.corner_m[1]) * scale).astype(np.int64)
        inside = (np.minimum(column, row) >= 0) & (np.maximum(column, row) < count)
        index = np.where(inside, row * count + column, 0)
        return np.where(inside, self.over_m.ravel().take(index), -UNKNOWN_M)


@dataclass
class Expected:
    """Where the ground should be that is not known yet, at one tick."""

    ground: GroundProfile
    plane: Plane
    parameters: NegativeParameters
    _floor: Floor | None = None

    @property
    def floor(self) -> Floor:
        """Made when it is asked for: where all is flat it never is."""
        self._floor = self._floor or _floor_of(self.ground, self.plane, self.parameters)
        return self._floor

    def continues(self, point_m: Floats, near: Bools) -> Bools:
        """Whether points (3, n), from the vehicle, go on from the known ground, (n,); of `near`
        ones less is asked.

        Ground may rise as it may fall. In a bend the beams sweep to where little is known: what
        stands up there is a wall as likely as ground, and can wait until it is seen from nearer.
        """
        p, over = self.parameters, self.plane.over(point_m)
        off = np.flatnonzero(np.abs(over) > p.doubt_m)
        goes_on = np.ones(len(over), bool)
        if off.size:
            floor = self.floor.at(point_m[0, off], point_m[1, off])
            known = floor > -UNKNOWN_M
            nowhere = np.where(near[off], p.doubt_m - p.low_m, UNKNOWN_M)
            least = np.where(known, floor, nowhere)
            most = np.where(known, np.abs(floor), p.low_m)
            goes_on[off] = (over[off] > least - p.doubt_m) & (over[off] < most + p.doubt_m)
        return goes_on


def expected(ground: GroundProfile, p: NegativeParameters) -> Expected | None:
    """None where too little is known."""
    plane = _plane_of(ground, p)
    return plane and Expected(ground, plane, p)


def _floor_of(ground: GroundProfile, plane: Plane, p: NegativeParameters) -> Floor:
    """The floor around the vehicle."""
    east, north = ground.block_centres()
    block_m = 2 * ground.lattice.cell_m
    level = (ground.vehicle_m + plane.height_m) + plane.rise(east, north)
    over = _continued(pooled(ground.height_m) - level, block_m, p)
    corner = float(east[0]) - 0.5 * block_m, float(north[0, 0]) - 0.5 * block_m
    return Floor(over, corner, block_m)


def _continued(over_m: Floats, block_m: float, p: NegativeParameters) -> Floats:
    """Known blocks as low as their lowest neighbour, and block by block what lies beside them, bent
    down. One that is known almost alone is none: far away, in a bend, it may be a wall's foot."""
    known = over_m < 0.5 * UNKNOWN_M
    known &= _beside(np.add, known.astype(np.int8)) >= LEAST_TOGETHER
    lowest = -_beside(np.maximum, np.where(known, -over_m, -UNKNOWN_M))
    floor, bent = np.where(known, lowest, -UNKNOWN_M), 0.0
    for k in range(1, round(p.near_m / block_m) + 1):
        bend = 0.5 * p.curvature_pm * (k * block_m) ** 2
        beside = _beside(np.maximum, floor) - (bend - bent)
        floor, bent = np.where(floor > -0.5 * UNKNOWN_M, floor, beside), bend
    return np.where(floor > -0.5 * UNKNOWN_M, floor, -UNKNOWN_M)


def _beside(join: np.ufunc, cells: NDArray[Kind]) -> NDArray[Kind]:
    """Each cell and its eight neighbours joined: their maximum, or their sum."""
    rows = cells.copy()
    join(rows[1:], cells[:-1], out=rows[1:])
    join(rows[:-1], cells[1:], out=rows[:-1])
    joined = rows.copy()
    join(joined[:, 1:], rows[:, :-1], out=joined[:, 1:])
    join(joined[:, :-1], rows[:, 1:], out=joined[:, :-1])
    return joined
