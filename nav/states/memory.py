"""What is remembered from one decision to the next."""

from dataclasses import dataclass

from nav.messages import Floats
from nav.planning.curve import Curve, curve_through


@dataclass
class Memory:
    """The local path in force, the last direction, the tunnel's axis."""

    pathpoint_m: Floats | None = None
    """Shape (10, 2)."""
    curve: Curve | None = None
    """Through the pathpoints."""
    waypoint: int = 0
    """The waypoint that was ahead when the local path was made."""
    decision_rad: float | None = None
    """theta_D(k - 1)."""
    axis: tuple[float, float, float] | None = None
    """Of the tunnel: x, y of a point on it and its heading."""
    open_ns: int | None = None
    """Since when both sides are open, in Tunnel Mode."""

    def follow(self, pathpoint_m: Floats, waypoint: int) -> None:
        """Put a new local path into force."""
        self.pathpoint_m, self.waypoint = pathpoint_m, waypoint
        self.curve = curve_through(pathpoint_m)

    def forget(self) -> None:
        """A new state starts with a new local path."""
        self.pathpoint_m = self.curve = self.decision_rad = self.axis = self.open_ns = None
