"""What a state sees when it plans, and what its plan is."""

from dataclasses import dataclass, field

from nav.fusion.health import Health
from nav.messages import RESET, STOP, Command, DirectCommand, EgoEstimate, Gear, RoadEstimate
from nav.planning.arcs import Pose
from nav.planning.curve import Curve
from nav.planning.local_path import Clear
from nav.planning.scanning import Boundaries
from nav.planning.speed import SpeedDecision

FAR_M = 1e3
"""Where nothing is."""


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
    arc_m: float = 0.0
    """Way along the route so far."""
    far_goal_m: tuple[float, float] = (0.0, 0.0)
    """In trouble: the farthest point of the smooth path on the wide grid that is free."""
    half_width_m: float = FAR_M
    """Of the corridor here ..."""
    narrowest_m: float = FAR_M
    """... and where it is narrowest, as far as haste must end before it."""
    turned_rad: float = 0.0
    """How far left of the smooth path's heading the vehicle's is."""
    gear: Gear = Gear.HIGH
    shifting: bool = False
    health: Health = field(default_factory=Health)
    road: RoadEstimate | None = None
    """What is said of the road, if it is fresh."""
    confirmed_m: float = FAR_M
    """Distance ahead that two sensors confirm to be occupied."""
    edges: Boundaries | None = None
    """Those of the corridor's edge alone."""
    wide: Boundaries | None = None
    """In trouble: the corridor and what is known in it, in larger cells, as far as 64 m away."""

    @property
    def pose(self) -> Pose:
        """Of the reference point."""
        x, y = self.ego.position_m.tolist()
        return x, y, self.ego.heading_rad


@dataclass(frozen=True, eq=False)
class Plan:
    """A command for the low-level controller and the numbers behind it."""

    command: Command
    speed_mps: float
    decision_rad: float
    D1_m: float = FAR_M
    D_m: float = FAR_M
    selected: str = ""
    """`safe` or `real`: which boundary Table 6.1 picked."""
    replanned: str = ""
    """Why the local path is new, or empty."""
    by_rules: SpeedDecision | None = None
    """How the set point came about, where the speed fuzzy controller gave it."""


def stand(s: Situation, reset: str = "") -> Plan:
    """The vehicle stands; a sensor may be reset meanwhile."""
    return Plan(DirectCommand(s.time_ns, RESET if reset else STOP, reset), 0.0, s.goal_rad)
