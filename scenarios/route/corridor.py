"""The corridor of a whole route, by station: metres along its line."""

from math import atan2
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scenarios.course import Floats
from scenarios.geometry import Pose

CHUNK_M = 100.0
"""Of the route: what is drawn at once."""
THING_M = 8.0
"""No thing is larger, with half of the 5 m from one point of a chunk's circle to the next."""


class Corridor(NamedTuple):
    """Segments of the route, arrays of shape (n, 2) and (n,)."""

    start_m: Floats
    direction: Floats
    length_m: Floats
    half_width_m: Floats
    end_m: Floats
    """Station of each segment's end."""

    @classmethod
    def of(cls, waypoint_m: Floats, half_width_m: Floats) -> "Corridor":
        """That of waypoints, shapes (n, 2) and (n,)."""
        span = np.diff(waypoint_m, axis=0)
        length = np.hypot(*span.T)
        direction = span / length[:, None]
        return cls(waypoint_m[:-1], direction, length, half_width_m[:-1], np.cumsum(length))

    @property
    def way_m(self) -> float:
        """Length of the route."""
        return float(self.end_m[-1])

    def segment(self, station_m: Floats) -> NDArray[np.int64]:
        """On which segment stations lie, shape (k,)."""
        return np.minimum(np.searchsorted(self.end_m, station_m), len(self.end_m) - 1)

    def waypoint(self, number: int) -> float:
        """Station of the waypoint of a number, the first being 1."""
        return float(self.end_m[number - 2]) if number > 1 else 0.0

    def place(self, station_m: float) -> tuple[int, float]:
        """The segment of one station, and how far along that is, [m]."""
        k = min(int(np.searchsorted(self.end_m, station_m)), len(self.end_m) - 1)
        return k, station_m - float(self.end_m[k] - self.length_m[k])

    def pose(self, station_m: float) -> Pose:
        """On the route's line, along it."""
        k, along = self.place(station_m)
        (x, y), (cx, cy) = self.start_m[k].tolist(), self.direction[k].tolist()
        return Pose(x, y, atan2(cy, cx)).moved(along, 0.0)

    def at(self, station_m: Floats) -> Floats:
        """Points of the route's line, shape (k, 2)."""
        k = self.segment(station_m)
        along = np.minimum(station_m, self.way_m) - (self.end_m - self.length_m)[k]
        return self.start_m[k] + along[:, None] * self.direction[k]

    def outside(self, pose: Pose, radius_m: float, but: int = -1) -> bool:
        """Whether a circle touches no segment's corridor (except that of segment `but`)."""
        away = np.array((pose.x, pose.y)) - self.start_m
        along = np.clip((away * self.direction).sum(axis=1), 0.0, self.length_m)
        gap = np.hypot(*(away - along[:, None] * self.direction).T) - self.half_width_m - radius_m
        gap[but if but >= 0 else slice(0, 0)] = np.inf
        return bool((gap > 0.1).all())

    def chunk_circles(self, beside_m: float) -> tuple[Floats, Floats]:
        """Circles that hold the chunks and what stands up to so far beside the corridor: middles
        (n, 2) and radii (n,)."""
        count = max(int(np.ceil(self.way_m / CHUNK_M)), 1)
        station = np.linspace(0.0, 1.0, 21) * CHUNK_M + np.arange(count)[:, None] * CHUNK_M
        point = self.at(station.ravel()).reshape(count, -1, 2)
        middle = point.mean(axis=1)
        radius = np.hypot(*np.moveaxis(point - middle[:, None], -1, 0)).max(axis=1)
        k = self.segment(station.ravel()).reshape(count, -1)
        return middle, radius + self.half_width_m[k].max(axis=1) + beside_m + THING_M
