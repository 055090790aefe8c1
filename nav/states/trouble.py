"""Whether the vehicle is in trouble: stopped by the rules, how often at one place, and the way out.

Trouble is over when the vehicle has come farther along the route than ever before.
"""

from dataclasses import dataclass, field
from math import atan2, dist, inf

from nav.angles import wrapped
from nav.parameters.states import StuckParameters
from nav.planning.detour import Point, ahead, way_around
from nav.states.situation import Situation

STILL_MPS = 0.1
EVERY = 5
"""Decisions between two looks at the map for a way around: 2 Hz."""


@dataclass
class Trouble:
    """Counts what happens at one place."""

    stopped_s: float = 0.0
    """For how long the rules have held the vehicle."""
    held: bool = False
    """Whether the last plan was to stand, by the rules of a forward state."""
    steers: bool = False
    """Whether the last plan was one of Obstacle Avoidance."""
    behind_s: float = 0.0
    """For how long the goal has lain outside the directions that are scanned: a vehicle that turns
    towards what is inside its turning circle goes round and round."""
    ahead_m: float = 0.0
    """How far the way ahead was free in it."""
    tries: int = 0
    """Sets of robotic operations here."""
    arc_m: float | None = None
    """Where on the route it began; None without trouble."""
    way: list[Point] = field(default_factory=list[Point])
    """The way around; empty where none is known."""
    goal_m: Point | None = None
    """A nearer goal point on it."""
    rolls_far: bool = False
    """Whether Rollback looks for the beginning of another path, not just for room."""
    _looked: int = 0

    def begin(self, s: Situation) -> None:
        """The vehicle is stuck here."""
        if self.arc_m is None:
            self.arc_m, self._looked = s.arc_m, 0

    def observe(self, s: Situation, elapsed_s: float, p: StuckParameters) -> None:
        """Take the time since the last decision, and see whether it is over."""
        stands = abs(s.ego.speed_mps) < STILL_MPS and not s.shifting
        held = stands and self.held
        self.stopped_s = self.stopped_s + elapsed_s if held else 0.0
        off = abs(wrapped(self.goal_rad(s) - s.ego.heading_rad))
        behind = self.steers and off > p.behind_rad
        self.behind_s = self.behind_s + elapsed_s if behind else 0.0
        if self.arc_m is not None and s.arc_m > self.arc_m + p.progress_m:
            self.tries, self.arc_m, self.rolls_far = 0, None, False
            self.way, self.goal_m = [], None

    def goal_rad(self, s: Situation) -> float:
        """phi(k): to the nearer goal point on the way around, or as the route has it."""
        if self.goal_m is None:
            return s.goal_rad
        return atan2(self.goal_m[1] - s.pose[1], self.goal_m[0] - s.pose[0])

    def reach_m(self, s: Situation) -> float:
        """Distance to the nearer goal point; without one, endless."""
        return inf if self.goal_m is None else dist(self.goal_m, s.pose[:2])

    def look(self, s: Situation, p: StuckParameters) -> None:
        """While there is trouble, find the way around anew, now and then: at once as it begins."""
        if s.wide is None or self.arc_m is None:
            return
        if self._looked % EVERY == 0:
            self.way = way_around(s.wide, s.pose[:2], s.far_goal_m)
            self.goal_m = ahead(self.way, s.boundaries, s.pose[:2], p.detour_reach_m)
        self._looked += 1
