"""One gate with the obstacle behind it: how it is drawn, and whether it leaves room.

Lengths are in the corridor's frame: x along it from the middle of the gate, y to the left of its
middle line, [m].
"""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

ROBOT_M = (0.508, 0.497)
"""Length and width (published)."""
MARGIN_M = 0.15
"""Room that must be left on either side of the robot: three tenths of its width. At the NQE's gates
ION has at least half of its own."""
RADIUS_M = 0.50
"""Of the arcs that a way around the third obstacle may have; the robot turns on 0.40 m."""
OPENING_M = (0.75, 1.15)
OFFSET_M = 0.6
"""The opening's middle lies within this of the corridor's."""
HALF_DEPTH_M = (0.08, 0.20)
"""Of the gate's obstacles, along the corridor."""
BEHIND_M = (1.0, 2.0)
"""From the gate's back to the front of the third obstacle."""
ASIDE_M = 0.35
"""The third obstacle stands within this of the way straight on."""
HALF_SIZE_M = (0.12, 0.25)
"""Of the third obstacle."""
HEIGHT_M = (0.5, 0.9)


class Placement(NamedTuple):
    """Where the three obstacles stand."""

    offset_m: float
    """y of the opening's middle."""
    opening_m: float
    half_depth_m: float
    behind_m: float
    """From the gate's back to the third obstacle."""
    third_y_m: float
    third_half_m: float
    third_round: bool
    """A cylinder, or a box that stands square."""
    height_m: tuple[float, float]
    """Of the gate and of the third obstacle."""

    @property
    def third_x_m(self) -> float:
        """x of its middle."""
        return self.half_depth_m + self.behind_m + self.third_half_m


def draw(rng: np.random.Generator, half_width_m: float) -> Placement:
    """The first of the drawn placements that leaves room in a corridor of this half-width."""
    while True:
        placement = _drawn(rng)
        if leaves_room(placement, half_width_m):
            return placement


def _drawn(rng: np.random.Generator) -> Placement:
    offset = float(rng.uniform(-OFFSET_M, OFFSET_M))
    return Placement(
        offset_m=offset,
        opening_m=float(rng.uniform(*OPENING_M)),
        half_depth_m=float(rng.uniform(*HALF_DEPTH_M)),
        behind_m=float(rng.uniform(*BEHIND_M)),
        third_y_m=offset + float(rng.uniform(-ASIDE_M, ASIDE_M)),
        third_half_m=float(rng.uniform(*HALF_SIZE_M)),
        third_round=bool(rng.integers(2)),
        height_m=(float(rng.uniform(*HEIGHT_M)), float(rng.uniform(*HEIGHT_M))),
    )


def leaves_room(p: Placement, half_width_m: float) -> bool:
    """Whether there is surely a way, `MARGIN_M` clear of everything.

    Straight through the middle of the gate; then, between the robot's tail leaving the gate and its
    nose reaching the third obstacle, sideways on two arcs of `RADIUS_M`; then straight past it. A
    placement that fails this may still be passable: the criterion is sufficient, not necessary.
    """
    length, width = ROBOT_M
    through = p.opening_m >= width + 2.0 * MARGIN_M
    return through and way_m(_shift_m(p, half_width_m)) <= p.behind_m - length


def way_m(shift_m: float) -> float:
    """Way ahead that two equal arcs of `RADIUS_M`, one to each side, take to move sideways, [m].

    With a turn by a: shift = 2 R (1 - cos a), way = 2 R sin a; beyond a quarter it is 2 R.
    """
    if not shift_m < 2.0 * RADIUS_M:
        return 2.0 * RADIUS_M if shift_m < inf else inf
    return sqrt(shift_m * (4.0 * RADIUS_M - shift_m))


def _shift_m(p: Placement, half_width_m: float) -> float:
    """The least way sideways from the gate's middle to past the third obstacle; inf: no way."""
    reach = p.third_half_m + MARGIN_M + 0.5 * ROBOT_M[1]
    sides = (p.third_y_m + reach, p.third_y_m - reach)
    room = half_width_m - MARGIN_M - 0.5 * ROBOT_M[1]
    return min((abs(y - p.offset_m) for y in sides if abs(y) <= room), default=inf)
