"""What is remembered from one decision to the next."""

from dataclasses import dataclass, field

from nav.messages import Floats
from nav.planning.arcs import Pose
from nav.planning.curve import Curve, curve_through
from nav.states.manoeuvre import Manoeuvre
from nav.states.trail import Trail
from nav.states.trouble import Trouble


@dataclass
class Memory:
    """The local path in force, the last direction, and what belongs to single states."""

    pathpoint_m: Floats | None = None
    """Shape (10, 2)."""
    curve: Curve | None = None
    """Through the pathpoints."""
    waypoint: int = 0
    """The waypoint that was ahead when the local path was made."""
    decision_rad: float | None = None
    """theta_D(k - 1)."""
    former_rad: float | None = None
    """What that was when Obstacle Avoidance decided last: for who asks why."""
    axis: tuple[float, float, float] | None = None
    """Of the tunnel: x, y of a point on it and its heading."""
    open_ns: int | None = None
    """Since when both sides are open, in Tunnel Mode."""
    reset_ns: int | None = None
    """When a sensor was reset last, in Alarm."""
    manoeuvre: Manoeuvre | None = None
    """Of Robotic Operations."""
    entered: Pose = (0.0, 0.0, 0.0)
    """Where the state began."""
    entered_ns: int = 0
    trail: Trail = field(default_factory=Trail)
    """Outlives the states, as does ..."""
    trouble: Trouble = field(default_factory=Trouble)

    def follow(self, pathpoint_m: Floats, waypoint: int) -> None:
        """Put a new local path into force."""
        self.pathpoint_m, self.waypoint = pathpoint_m, waypoint
        self.curve = curve_through(pathpoint_m)

    def enter(self, pose: Pose, time_ns: int) -> None:
        """A new state starts with a new local path."""
        self.pathpoint_m = self.curve = self.decision_rad = self.axis = self.open_ns = None
        self.reset_ns = self.manoeuvre = None
        self.entered, self.entered_ns = pose, time_ns
