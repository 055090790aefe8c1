"""How the ego state starts: from sensors alone, the heading from the compass first.

At rest nothing but a compass knows the heading. If none has spoken for a while, the heading that
the crew states is taken, with a large standard deviation; without that either, the ego state
waits until the vehicle has been moved and the course is known.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

from nav.messages import CompassHeading, Gear, GpsFix, GpsQuality, SensorMessage, VehicleState
from nav.parameters.ego_state import EgoParameters

FRESH_NS = 500_000_000
"""A compass heading older than this does not start anything."""
COURSE_MPS = 1.0
"""Slower than this, a course does not start anything."""


class FirstHeading(NamedTuple):
    """A heading, [rad], and the variance of its noise, [rad^2]."""

    heading_rad: float
    variance: float
    compass: bool
    """Whether it is the compass's word and has the compass's bias."""


@dataclass
class Start:
    """Remembers what there was before the filter could run."""

    parameters: EgoParameters
    crew_heading_rad: float | None = None
    first_fix_ns: int | None = None
    compass: CompassHeading | None = None
    reverse: bool = False

    def take(self, message: SensorMessage) -> FirstHeading | None:
        """The heading to start with, if the message is a fix to start at and there is one."""
        if isinstance(message, CompassHeading):
            self.compass = message
        elif isinstance(message, VehicleState):
            self.reverse = message.gear is Gear.REVERSE
        elif isinstance(message, GpsFix) and message.quality is not GpsQuality.NONE:
            return self._heading(message)
        return None

    def _heading(self, fix: GpsFix) -> FirstHeading | None:
        p = self.parameters
        if self.first_fix_ns is None:
            self.first_fix_ns = fix.time_ns
        if self.compass and fix.time_ns - self.compass.time_ns < FRESH_NS:
            return FirstHeading(self.compass.heading_rad, p.compass.sd_rad**2, True)
        if fix.time_ns - self.first_fix_ns < p.start.compass_wait_s * 1e9:
            return None
        east, north, _ = fix.velocity_mps.tolist()
        if math.hypot(east, north) > COURSE_MPS:
            course = math.atan2(north, east) + (math.pi if self.reverse else 0.0)
            return FirstHeading(course, p.start.course_sd_rad**2, False)
        if self.crew_heading_rad is not None:
            return FirstHeading(self.crew_heading_rad, p.start.crew_sd_rad**2, False)
        return None
