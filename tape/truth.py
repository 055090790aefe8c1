"""What really happened, beside the tape: for people's eyes. Never replayed, never digested."""

from dataclasses import dataclass

from nav.messages import Floats

TRUTH = "/truth/"
"""Only topics below it say what no sensor knows."""


@dataclass(frozen=True, eq=False)
class TrueState:
    """The vehicle in the simulator's world frame."""

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
