"""The true state of the vehicle: for judges and pictures, never for the navigator."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Truth:
    """The simulator's state at one instant, world frame."""

    time_ns: int
    position_m: Floats
    """Shape (3,), the reference point."""
    heading_rad: float
    roll_rad: float
    pitch_rad: float
    speed_mps: float
    """Along the vehicle's x axis, signed."""
    tire_center_m: Floats
    """Shape (n, 3), from front left and front right to rear left and rear right."""
    contacts: tuple[str, ...]
    """Owners of the obstacles that the vehicle touched in the last 20 ms, and `ground` where its
    chassis touched the ground."""


class Applied(NamedTuple):
    """What the actuators really do at this instant."""

    steering_rad: float
    throttle: float
    brake: float
    gear: int
    """Of the linkage: the position that it left last, or is at."""
    shifting: bool
    linkage: float
    """Where the linkage's potentiometer stands: 0 is R, 3 is H."""
