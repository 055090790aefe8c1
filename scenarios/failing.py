"""A course on which devices of the vehicle fail."""

from collections.abc import Sequence
from dataclasses import replace

from scenarios.course import Course
from scenarios.vehicles import VEHICLES
from twin.faults import parse


def failing(course: Course, lines: Sequence[str]) -> Course:
    """The course with more faults, one a line; see `twin.faults.parse`.

    Raises:
        ValueError: a line that is no fault, or of a device that the vehicle does not have.
    """
    if not lines:
        return course
    known = VEHICLES[course.vehicle].devices
    faults = tuple(parse(line, known) for line in lines)
    return replace(course, world=replace(course.world, faults=course.world.faults + faults))
