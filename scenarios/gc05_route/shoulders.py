"""What rises and falls beside the track: berms, the banks of a wash, the walls and drops of the
pass."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scenarios.course import Floats
from scenarios.gc05_route.plan import Plan, Range
from scenarios.route.corridor import Corridor
from scenarios.things import generator
from twin.landforms import ridge

Indices = NDArray[np.int64]

FOOT_M = 2.5
"""From the corridor's edge to where the ground begins to rise or fall (estimated). The navigator
takes the brink of a drop for an obstacle as wide as a cell of its ground; what stands on a narrow
track beside it leaves no way."""
SLOPE = 0.7
"""Loose ground lies no steeper: 35 degrees (estimated)."""
CREST_M = 1.0
"""Flat between one slope and the other (estimated)."""
LEAST_M = 0.12
"""What would be lower is left out."""
EVERY = 5
"""Waypoints from one drawn height to the next."""


@dataclass(frozen=True, eq=False)
class Shoulders:
    """A landform: one ridge or trough along each side of the corridor."""

    corridor: Corridor
    foot_m: Floats
    """Shape (n + 1,), at the waypoints: from the line to where it begins."""
    height_m: Floats
    """Shape (n + 1, 2), at the waypoints: on the left and on the right; negative falls."""

    def height(self, x: Floats, y: Floats) -> Floats:
        """See `Landform`. A place belongs to the nearest segment that reaches it."""
        x, y = np.broadcast_arrays(x, y)
        points = np.stack([x.ravel(), y.ravel()])
        added, nearest = np.zeros(x.size), np.full(x.size, np.inf)
        for k, reach in self._near(points):
            at, distance, height = self._beside(k, reach, points)
            closer = distance < nearest[at]
            nearest[at[closer]], added[at[closer]] = distance[closer], height[closer]
        return added.reshape(x.shape)

    def _beside(self, k: int, reach: float, points: Floats) -> tuple[Indices, Floats, Floats]:
        """Which of the points (2, n) segment k reaches; their distance and what it adds there."""
        corridor = self.corridor
        (cx, cy), length = corridor.direction[k].tolist(), float(corridor.length_m[k])
        x, y = points - corridor.start_m[k][:, None]
        along, left = cx * x + cy * y, cx * y - cy * x
        within = (along > -reach) & (along < length + reach) & (np.abs(left) < reach)
        at = np.flatnonzero(within)
        along, left = along[at], left[at]
        u = np.clip(along, 0.0, length)
        distance = np.hypot(along - u, left)
        return at, distance, self._profile(k, u / length, distance, left)

    def _near(self, points: Floats) -> Iterator[tuple[int, float]]:
        """The segments that may reach one of the points, and how far they reach, [m]."""
        low, high = self._bounds_m
        least, most = points.min(axis=1, initial=np.inf), points.max(axis=1, initial=-np.inf)
        meets = (low < most).all(axis=1) & (high > least).all(axis=1)
        for k in np.flatnonzero(meets).tolist():
            yield k, float(self._reach_m[k])

    @cached_property
    def _bounds_m(self) -> tuple[Floats, Floats]:
        """What each segment's sides lie within: lowest and highest x and y, (n, 2) each."""
        start, reach = self.corridor.start_m, self._reach_m[:, None]
        end = start + self.corridor.direction * self.corridor.length_m[:, None]
        return np.minimum(start, end) - reach, np.maximum(start, end) + reach

    @cached_property
    def _reach_m(self) -> Floats:
        """How far from its line each segment's sides reach, shape (n,)."""
        far = self.foot_m + 2.0 * np.abs(self.height_m).max(axis=1) / SLOPE + CREST_M
        return np.maximum(far[:-1], far[1:])

    def _profile(self, k: int, share: Floats, distance: Floats, left: Floats) -> Floats:
        """Heights at a share of the way along segment k, at a distance from it on one side."""
        foot = self.foot_m[k] + share * (self.foot_m[k + 1] - self.foot_m[k])
        side = np.where(left >= 0.0, 0, 1)
        before, after = self.height_m[k, side], self.height_m[k + 1, side]
        height = before + share * (after - before)
        return np.copysign(ridge(distance - foot, np.abs(height), SLOPE, CREST_M), height)


def shoulders(plan: Plan, seed: int, corridor: Corridor) -> Shoulders:
    """As `seed` draws them, for each stretch within what the plan says of its kind."""
    half = corridor.half_width_m
    widest = np.maximum(np.append(half, half[-1]), np.append(half[0], half))
    rng = generator(seed, "shoulders")
    height = np.concatenate([
        np.stack([_drawn(rng, s.waypoints, side) for side in plan.beside[s.kind]], axis=1)
        for s in plan.stretches
    ])  # fmt: skip
    first, last = plan.drop.waypoints
    height[first - 1 : last, 1] = -plan.drop.depth_m
    return Shoulders(corridor, widest + FOOT_M, height)


def _drawn(rng: np.random.Generator, count: int, within: Range) -> Floats:
    """Heights at waypoints, shape (count,), [m]; none at both ends."""
    knots = np.arange(0, count + EVERY, EVERY)
    drawn = rng.uniform(*within, len(knots))
    drawn[[0, -1]] = 0.0
    height = np.interp(np.arange(count), knots, drawn)
    return np.where(np.abs(height) < LEAST_M, 0.0, height)
