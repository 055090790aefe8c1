"""Where the vehicle is on the route, and whether its tires stay inside the corridor."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.route.corridor import depth
from nav.route.waypoints import Waypoints

Floats = NDArray[np.float64]
Point = tuple[float, float]

SEGMENTS_EACH_WAY = 2
"""The corridor here and now is that of the segments n-2 to n+2 (design: departure)."""
MERGE_NS = 1_000_000_000
"""Two departures less than this apart are one."""


@dataclass
class Progress:
    """Counts waypoints: one is passed when the reference point crosses the line that halves its
    corner; the first when the drive begins; the last, the finish, by the vehicle's nose."""

    waypoint_m: Floats
    """Shape (n, 2), world frame."""
    goal_m: float | None = None
    """The last is also reached when the reference point is this near."""
    segment: int = 0
    """Index of the segment that the vehicle is on; n - 1 behind the last waypoint."""

    def __post_init__(self) -> None:
        step = np.diff(self.waypoint_m, axis=0)
        unit = step / np.linalg.norm(step, axis=1, keepdims=True)
        self._along = (np.vstack([unit, unit[-1:]]) + np.vstack([unit[:1], unit])).tolist()
        self._waypoints: list[list[float]] = self.waypoint_m.tolist()

    def observe(self, reference_m: Point, nose_m: Point) -> None:
        """Take the positions of the reference point and of the middle of the bumper."""
        finish = len(self._waypoints) - 1
        if self.goal_m is not None and math.dist(reference_m, self._waypoints[-1]) < self.goal_m:
            self.segment = finish
        while not self.finished:
            x, y = nose_m if self.segment + 1 == finish else reference_m
            if not self._beyond(self.segment + 1, x, y) or self._awaits_goal():
                break
            self.segment += 1

    def _beyond(self, waypoint: int, x: float, y: float) -> bool:
        (wx, wy), (tx, ty) = self._waypoints[waypoint], self._along[waypoint]
        return (x - wx) * tx + (y - wy) * ty >= 0.0

    def _awaits_goal(self) -> bool:
        """Whether only nearness counts now."""
        return self.goal_m is not None and self.segment + 2 == len(self._waypoints)

    @property
    def passed(self) -> int:
        """How many waypoints lie behind."""
        return self.segment + 1

    @property
    def finished(self) -> bool:
        """True behind the last waypoint."""
        return self.segment == len(self._waypoints) - 1


class Segment(NamedTuple):
    """The rectangle of one segment."""

    x: float
    y: float
    cos: float
    sin: float
    length_m: float
    half_width_m: float

    def holds(self, points: list[Point]) -> bool:
        """Whether all points lie in it: nearly always so, and quickly told."""
        return all(
            0.0 <= self.cos * (x - self.x) + self.sin * (y - self.y) <= self.length_m
            and abs(self.cos * (y - self.y) - self.sin * (x - self.x)) <= self.half_width_m
            for x, y in points
        )


@dataclass
class Departures:
    """Counts the times that any tire's centre left the corridor."""

    waypoints: Waypoints
    """In the world frame."""
    count: int = 0
    _last_ns: int = -MERGE_NS - 1

    def __post_init__(self) -> None:
        self._segments = segments(self.waypoints)

    def observe(self, time_ns: int, segment: int, tire_m: Floats) -> None:
        """Take the tires' centres, shape (k, 2) [m], and the segment that the vehicle is on."""
        if segment < len(self._segments) and self._segments[segment].holds(tire_m.tolist()):
            return
        first, last = segment - SEGMENTS_EACH_WAY, segment + SEGMENTS_EACH_WAY
        if depth(tire_m, self.waypoints, first, last).min() < 0.0:
            self.count += time_ns - self._last_ns > MERGE_NS
            self._last_ns = time_ns


def segments(waypoints: Waypoints) -> list[Segment]:
    """The rectangles of a corridor, one a segment."""
    start, step = waypoints.position_m[:-1], np.diff(waypoints.position_m, axis=0)
    length = np.linalg.norm(step, axis=1)
    half_width = waypoints.half_width_m[: len(step)]
    rows = np.column_stack([start, step / length[:, None], length, half_width])
    return [Segment(*row) for row in rows.tolist()]
