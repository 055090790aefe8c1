"""How near the vehicle keeps to a line: the route's smooth path, and the middle of a tunnel."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.route.geodesy import Frame
from nav.route.rddf import parse
from nav.route.smooth_path import SmoothPath, project, smooth_path
from nav.route.waypoints import route_frame, waypoints_of
from scenarios.course import Course

Floats = NDArray[np.float64]


@dataclass
class Deviation:
    """Root mean square and maximum of what it is shown."""

    count: int = 0
    sum2: float = 0.0
    greatest_m: float = 0.0

    def add(self, offset_m: float) -> None:
        """Take one offset, of either sign."""
        self.count += 1
        self.sum2 += offset_m * offset_m
        self.greatest_m = max(self.greatest_m, abs(offset_m))

    @property
    def rms_m(self) -> float | None:
        """None before the first offset."""
        return math.sqrt(self.sum2 / self.count) if self.count else None


class RouteFrames(NamedTuple):
    """The world frame and the route frame N of one course."""

    world: Frame
    route: Frame

    def to_route(self, world_m: Floats) -> Floats:
        """Points of the world frame, shape (n, 2) [m], in route frame N."""
        return self.route.to_local(*self.world.to_geodetic(world_m))

    def to_world(self, route_m: Floats) -> Floats:
        """Points of route frame N, shape (n, 2) [m], in the world frame."""
        return self.world.to_local(*self.route.to_geodetic(route_m))


def frames(course: Course) -> RouteFrames:
    """Both frames of a course."""
    route = parse(course.route_text, course.route_name)
    return RouteFrames(Frame(*course.world.anchor), route_frame(route))


def route_path(course: Course) -> SmoothPath:
    """The smooth path of the course's route in route frame N."""
    route = parse(course.route_text, course.route_name)
    return smooth_path(waypoints_of(route, route_frame(route)))


@dataclass
class CrossTrack:
    """Offsets of one pose from the smooth path of the route."""

    path: SmoothPath
    deviation: Deviation = field(default_factory=Deviation)
    index: int = 0
    """Of the path's sample nearest to the last point."""

    def observe(self, route_m: Floats, counts: bool, near: int | None = None) -> None:
        """Take a point (2,) in frame N, and whether its offset counts. All points are asked for,
        because each is searched near the last; unless one says which sample is `near`."""
        near = self.index if near is None else near
        self.index, cross_track_m, _ = project(self.path, route_m, near)
        if counts:
            self.deviation.add(cross_track_m)


def line_offset_m(line_m: Floats, point_m: Floats) -> float | None:
    """Distance of a point (2,) from a polyline (k, 2), [m]; None before its start and behind its
    end."""
    start, step = line_m[:-1], np.diff(line_m, axis=0)
    along = np.sum((point_m - start) * step, axis=1) / np.sum(step**2, axis=1)
    if along[0] < 0.0 or along[-1] > 1.0:
        return None
    gap = point_m - start - np.clip(along, 0.0, 1.0)[:, None] * step
    return float(np.hypot(gap[:, 0], gap[:, 1]).min())
