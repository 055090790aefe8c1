"""The route in frame N: where the waypoints are, how wide the corridor is, how fast one may go."""

from dataclasses import dataclass

from nav.route.geodesy import Floats, Frame
from nav.route.rddf import Route


@dataclass(frozen=True, eq=False)
class Waypoints:
    """Waypoints {P_i} in frame N. Segment i runs from P_i to P_(i+1) with width and speed of i."""

    position_m: Floats
    """Shape (n, 2)."""
    half_width_m: Floats
    """Shape (n,)."""
    speed_mps: Floats
    """Shape (n,)."""

    def __post_init__(self) -> None:
        for array in (self.position_m, self.half_width_m, self.speed_mps):
            array.setflags(write=False)

    @property
    def segments(self) -> int:
        """How many segments there are."""
        return len(self.position_m) - 1


def route_frame(route: Route) -> Frame:
    """Frame N: anchored at the route's first waypoint."""
    return Frame(*route.first_deg)


def waypoints_of(route: Route, frame: Frame) -> Waypoints:
    """The route's waypoints in `frame`."""
    position = frame.to_local(route.latitude_deg, route.longitude_deg)
    return Waypoints(position, route.half_width_m, route.speed_mps)
