"""Robotic unit operations (section 6.3): arcs back and forth until a forward path is free.

A best-first search over arcs of both gears. It is advanced by a few poses a decision, while the
vehicle stands, so that no decision takes long; memory and order are fixed, so it repeats itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from heapq import heappop, heappush
from math import atan2
from typing import NamedTuple

import numpy as np

from nav.angles import wrapped
from nav.messages import Floats, Gear
from nav.parameters import Parameters
from nav.parameters.planning import Operations
from nav.parameters.planning import PlanningParameters as Planning
from nav.planning.arcs import STEP_M, Pose, arc_poses, levels, placed
from nav.planning.boundaries import REAL, TOUCH
from nav.planning.detour import target
from nav.planning.scanning import Boundaries, Fan, Turning, fan, free_distance, scan

CELL_M, CELL_RAD = 0.5, 0.26
"""Poses that fall into one cell, driven into in one gear, count as one."""


class Arc(NamedTuple):
    """One unit operation."""

    gear: Gear
    curvature_per_m: float
    """Of the vehicle's way in the forward sense: left positive in both gears."""
    length_m: float


class Arcs(NamedTuple):
    """All arcs from a vehicle at the origin that heads along x."""

    gear: tuple[Gear, ...]
    curvature_per_m: tuple[float, ...]
    arc_m: Floats
    """Shape (m,)."""
    position_m: Floats
    """Shape (2, n, m)."""
    heading_rad: Floats
    """Shape (n, m)."""


def arcs(p: Operations, radius_m: float) -> Arcs:
    """Left, straight and right in both gears, up to the longest operation."""
    bends = (1.0 / radius_m, 0.0, -1.0 / radius_m)
    gear = (Gear.REVERSE,) * len(bends) + (Gear.LOW,) * len(bends)
    arc = np.arange(0.0, p.longest_m + 0.5 * STEP_M, STEP_M)
    way = np.where(np.array(gear) == Gear.REVERSE, -1.0, 1.0)[:, None] * arc
    return Arcs(gear, bends * 2, arc, *arc_poses(np.array(bends * 2)[:, None], way))


@dataclass(order=True)
class _Node:
    """A pose that operations lead to; ordered by cost, then by age."""

    priority: float
    number: int
    cost_m: float = field(compare=False)
    pose: Pose = field(compare=False)
    way: tuple[Arc, ...] = field(compare=False)


@dataclass
class Search:
    """Looks for operations from a pose to one from which the goal direction is free."""

    start: Pose
    way: tuple[tuple[float, float], ...]
    """Where the vehicle shall go from here, points in frame N."""
    boundaries: Boundaries
    planning: Planning
    arcs: Arcs
    exits: Fan
    """Directions that are tried from each pose."""
    back_first: bool = False
    """Whether the first operation has to lead back: forward has been tried in vain from here."""
    found: tuple[Arc, ...] | None = None
    """The operations, once they are known; empty where forward is free already."""
    exhausted: bool = False
    _open: list[_Node] = field(default_factory=list[_Node])
    _seen: set[tuple[int, int, int, int]] = field(default_factory=set[tuple[int, int, int, int]])
    _count: int = 0

    @property
    def parameters(self) -> Operations:
        """Of the operations alone."""
        return self.planning.operations

    def __post_init__(self) -> None:
        self._push(0.0, self.start, ())

    def advance(self) -> None:
        """Look at the next few poses."""
        for _ in range(self.parameters.poses_a_decision):
            if not self._open or self._count > self.parameters.most_poses:
                self.exhausted = True
            if self.exhausted or self.found is not None:
                return
            node = heappop(self._open)
            if self._leads_out(node):
                self.found = node.way
                return
            self._expand(node)

    def _leads_out(self, node: _Node) -> bool:
        if self.back_first and not node.way:
            return False
        goal = target(self.way, node.pose[:2], self.parameters.exit_m)
        return exit_is_free(self.exits, node.pose, goal, self.boundaries, self.planning)

    def _expand(self, node: _Node) -> None:
        place, turned = placed(node.pose, self.arcs.position_m, self.arcs.heading_rad)
        level = levels(place, turned, self.boundaries, self.planning.footprint)
        free = free_distance(level, self.arcs.arc_m, TOUCH, self.planning.footprint)
        tight = np.cumsum(level >= REAL, axis=1) * STEP_M
        for row, gear in enumerate(self.arcs.gear):
            if self.back_first and not node.way and gear != Gear.REVERSE:
                continue
            for length in self.parameters.lengths_m:
                if length + self.parameters.margin_m > free[row]:
                    break
                k = round(length / STEP_M)
                arc = Arc(gear, self.arcs.curvature_per_m[row], length)
                to = (float(place[0, row, k]), float(place[1, row, k]), float(turned[row, k]))
                self._push(node.cost_m + self._cost(node, arc, float(tight[row, k])), to,
                           (*node.way, arc))  # fmt: skip

    def _cost(self, node: _Node, arc: Arc, tight_m: float) -> float:
        """Way, more where it is tight, and much more where the gear changes."""
        p = self.parameters
        before = node.way[-1].gear if node.way else Gear.HIGH
        shifts = (before == Gear.REVERSE) != (arc.gear == Gear.REVERSE)
        return arc.length_m + p.tight_cost * tight_m + (p.shift_cost_m if shifts else 0.0)

    def _push(self, cost_m: float, pose: Pose, way: tuple[Arc, ...]) -> None:
        x, y, heading = pose
        reverse = bool(way) and way[-1].gear == Gear.REVERSE
        turn = round(wrapped(heading) / CELL_RAD)
        cell = (round(x / CELL_M), round(y / CELL_M), turn, int(reverse))
        if cell in self._seen or _length_m(way) > self.parameters.most_way_m:
            return
        self._seen.add(cell)
        goal = target(self.way, (x, y), self.parameters.exit_m)
        off = abs(wrapped(atan2(goal[1] - y, goal[0] - x) - heading))
        self._count += 1
        node = _Node(cost_m + self.parameters.turn_cost_m * off, self._count, cost_m, pose, way)
        heappush(self._open, node)


def exits(p: Parameters) -> Fan:
    """Directions from a stand, with the wheels turned before the vehicle starts."""
    o, bend = p.planning.operations, 1.0 / radius_m(p)
    few = replace(p.planning.scanning, directions=o.exit_directions, max_distance_m=o.exit_m)
    return fan(few, p.planning.footprint, Turning(0.0, 0.0, 10.0 * bend, bend))


def radius_m(p: Parameters) -> float:
    """Of the arcs that are driven, [m]."""
    return p.planning.operations.radius_margin * p.vehicle.steering.minimum_radius_m


def search(
    p: Parameters,
    start: Pose,
    way: Sequence[tuple[float, float]],
    boundaries: Boundaries,
    back_first: bool = False,
) -> "Search":
    """A search that has not begun yet."""
    curves = arcs(p.planning.operations, radius_m(p))
    return Search(start, tuple(way), boundaries, p.planning, curves, exits(p), back_first)


def _length_m(way: tuple[Arc, ...]) -> float:
    total = 0.0
    for arc in way:
        total += arc.length_m
    return total


def exit_is_free(
    exits: Fan, pose: Pose, goal_m: tuple[float, float], boundaries: Boundaries, p: Planning
) -> bool:
    """Whether a direction near the goal's is free far enough from a pose."""
    x, y, heading = pose
    goal = wrapped(atan2(goal_m[1] - y, goal_m[0] - x) - heading)
    toward = np.abs(exits.theta_rad - goal) < p.operations.exit_rad
    if not toward.any():
        return False
    free = scan(exits, boundaries, p.footprint, x, y, heading).real_m
    return bool(free[toward].max() >= exits.arc_m[-1])


def merged(way: tuple[Arc, ...]) -> tuple[Arc, ...]:
    """Pieces in one gear on one curvature are one operation."""
    result: list[Arc] = []
    for arc in way:
        if result and result[-1][:2] == arc[:2]:
            result[-1] = arc._replace(length_m=result[-1].length_m + arc.length_m)
        else:
            result.append(arc)
    return tuple(result)
