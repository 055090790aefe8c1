"""What a state sees when it plans, and what its plan is."""

from dataclasses import dataclass

from nav.messages import EgoEstimate, Floats
from nav.planning.curve import Curve
from nav.planning.local_path import Clear
from nav.planning.scanning import Boundaries


@dataclass(frozen=True, eq=False)
class Situation:
    """One moment of the high-level controller (10 Hz)."""

    time_ns: int
    ego: EgoEstimate
    boundaries: Boundaries
    route_ahead: Curve
    """The smooth path from here on, joined from the vehicle's pose."""
    route_clear: Clear
    """How far it is free."""
    goal_rad: float
    """phi(k)."""
    V0_mps: float
    cross_track_m: float
    waypoint: int
    """Index of the waypoint ahead."""
    curvature_per_m: float
    """Of the vehicle's way when steering targets of now take effect, left positive."""
    gps_lost_s: float
    sonar_m: dict[str, float]
    """Newest sonar ranges by name; empty where there is none."""


@dataclass(frozen=True, eq=False)
class Plan:
    """A local path and the numbers behind it."""

    pathpoint_m: Floats
    """Shape (10, 2)."""
    speed_mps: float
    D1_m: float
    D_m: float
    decision_rad: float
    selected: str = ""
    """`safe` or `real`: which boundary Table 6.1 picked."""
    replanned: str = ""
    """Why the local path is new, or empty."""
