"""A stretch of a course, driven for itself: from one waypoint to another."""

from dataclasses import replace
from math import atan2

import numpy as np

from scenarios.course import Course, Floats

START_M = 2.0
"""The reference point starts so far past the first waypoint."""


def stretch(course: Course, first: int, last: int) -> Course:
    """The course from waypoint index `first` to `last`; its world stays whole.

    Gates and the tunnel are left out of what is judged: most lie outside.
    """
    rows = slice(first, last + 1)
    lines = [line for line in course.route_text.splitlines() if line.strip()]
    return replace(
        course,
        world=replace(course.world, start=_start(course.waypoint_m[rows])),
        route_text="".join(f"{line}\n" for line in lines[rows]),
        waypoint_m=course.waypoint_m[rows],
        half_width_m=course.half_width_m[rows],
        speed_mps=course.speed_mps[rows],
        gates=(),
        tunnel_center_line_m=None,
    )


def around(course: Course, point_m: Floats, before_m: float, behind_m: float) -> Course:
    """The stretch around the place of the route that is nearest to a point (2,), world frame."""
    steps = np.hypot(*np.diff(course.waypoint_m, axis=0).T)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    here = arc[np.argmin(np.hypot(*(course.waypoint_m - point_m).T))]
    first, last = np.searchsorted(arc, [here - before_m, here + behind_m])
    return stretch(course, int(first), int(min(last, len(arc) - 1)))


def _start(waypoint_m: Floats) -> tuple[float, float, float]:
    east, north = (waypoint_m[1] - waypoint_m[0]).tolist()
    heading = atan2(north, east)
    x, y = (waypoint_m[0] + START_M * np.array([np.cos(heading), np.sin(heading)])).tolist()
    return x, y, heading
