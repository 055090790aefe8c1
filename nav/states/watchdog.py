"""The watchdog of section 6.3: a vehicle is not stuck forever.

When the position does not change, or another state than the two main ones lasts too long, the
machine is reset to Path-Point Keeping and stays there, with a high throttle, regardless of
obstacles, until the vehicle has come a certain distance. That is `override = "paper"`. `"guarded"`
ignores the map as well, but stands still before what two sensors confirm within D_safe, and before
the edge of the corridor.
"""

from dataclasses import dataclass
from math import hypot

from nav.messages import FollowPath
from nav.parameters import Parameters
from nav.parameters.states import WatchdogParameters
from nav.planning.arcs import Pose, free_arc
from nav.planning.local_path import path_length, pathpoints
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation, stand

MAIN_STATES = ("path_point_keeping", "obstacle_avoidance")
EDGE_M = 0.5
"""It stands so far before the corridor's edge."""
PATIENT_STATES = ("alarm",)
"""Where the vehicle stands on purpose, and for a limited time."""


@dataclass
class Watchdog:
    """Its timers, and whether it drives."""

    still_s: float = 0.0
    outside_s: float = 0.0
    drives_s: float | None = None
    """For how long it has been driving; None when it does not."""
    _place: Pose | None = None

    def observe(self, s: Situation, state: str, elapsed_s: float, p: WatchdogParameters) -> None:
        """Let the timers run."""
        if self._place is None or _apart(self._place, s.pose) >= p.still_m:
            self._place, self.still_s = s.pose, 0.0
        counts = p.counts_shift_time or not s.shifting
        if counts and state not in PATIENT_STATES:
            self.still_s += elapsed_s
        if state in MAIN_STATES:
            self.outside_s = 0.0
        elif counts:
            self.outside_s += elapsed_s
        if self.drives_s is not None:
            self.drives_s += elapsed_s

    def bites(self, p: WatchdogParameters) -> str:
        """Why the machine must be reset, or empty."""
        if self.still_s > p.still_s:
            return f"watchdog: no change of position in {p.still_s:.0f} s"
        if self.outside_s > p.outside_s:
            return f"watchdog: {p.outside_s:.0f} s outside the two main states"
        return ""

    def seize(self) -> None:
        """From now on it drives."""
        self.still_s = self.outside_s = self.drives_s = 0.0

    def lets_go(self, s: Situation, began: Pose, p: WatchdogParameters) -> str:
        """Why the machine may go on by itself, or empty."""
        assert self.drives_s is not None
        if _apart(began, s.pose) >= p.distance_m:
            return f"watchdog: {p.distance_m:.0f} m driven"
        return "watchdog: no way forward" if self.drives_s > p.longest_s else ""

    def release(self) -> None:
        """It drives no more."""
        self.drives_s = None


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """The smooth path with a high throttle, whatever the map says."""
    w = p.states.watchdog
    if w.override == "guarded" and _dares_not(s, p):
        return stand(s)
    length = path_length(s.ego.speed_mps, p.planning.local_path)
    memory.follow(pathpoints(s.route_ahead, length), s.waypoint)
    assert memory.pathpoint_m is not None
    command = FollowPath(s.time_ns, memory.pathpoint_m, w.speed_mps, w.throttle)
    return Plan(command, w.speed_mps, float(s.route_ahead.heading_rad[0]), replanned="watchdog")


def _dares_not(s: Situation, p: Parameters) -> bool:
    """Whether the way to a stand would lead too near to what is there for certain."""
    stopping_m = _stopping_m(s, p.states.watchdog)
    if s.confirmed_m < stopping_m + p.speed.safe_distance_m:
        return True
    way_m, foot = stopping_m + EDGE_M, p.planning.footprint
    return s.edges is not None and free_arc(s.pose, s.curvature_per_m, way_m, s.edges, foot) < way_m


def _stopping_m(s: Situation, p: WatchdogParameters) -> float:
    """Way to a stand: the answer of the actuators, then braking."""
    v = max(s.ego.speed_mps, 0.0)
    return v * p.answer_s + v * v / (2.0 * p.braking_mps2)


def _apart(a: Pose, b: Pose) -> float:
    return hypot(a[0] - b[0], a[1] - b[1])
