"""A vehicle that stands somewhere, for sensors that are looked at alone."""

import numpy as np

from scenarios.truth.check import Floats
from twin.truth import Applied


class Standing:
    """A `View` of a level vehicle at rest whose every site is at one place."""

    def __init__(self, place_m: tuple[float, float, float]) -> None:
        self.k = 0
        self.place_m = np.array(place_m)
        self.wheel_speed_radps = np.zeros(6)
        self.applied = Applied(0.0, 0.0, 1.0, 3, False, 3.0)

    def site_pose(self, name: str) -> tuple[Floats, Floats]:
        """Looking along x, whichever it is."""
        del name  # Unused.
        return self.place_m.copy(), np.eye(3)

    def site_velocity(self, name: str) -> tuple[Floats, Floats]:
        """None."""
        del name  # Unused.
        return np.zeros(3), np.zeros(3)

    def imu(self) -> tuple[Floats, Floats]:
        """No rates, and gravity."""
        return np.zeros(3), np.array([0.0, 0.0, 9.81])
