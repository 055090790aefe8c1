"""The judge: sees the true state at 50 Hz, and says how the drive went and when it is over."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nav.messages import Decision, EgoEstimate
from nav.route.smooth_path import SmoothPath
from nav.route.waypoints import Waypoints
from scenarios.course import Course
from scenarios.verdicts.clearance import Clearance
from scenarios.verdicts.contacts import Contacts
from scenarios.verdicts.corridor import Departures, Progress
from scenarios.verdicts.falls import Falls
from scenarios.verdicts.gates import GateKeeper
from scenarios.verdicts.shapes import Outline, Pose
from scenarios.verdicts.tracking import CrossTrack, Deviation, frames, line_offset_m, route_path
from twin.truth import Truth
from twin.world import SOFT

Floats = NDArray[np.float64]

TICK_S = 0.02
PATH_STATE = "path_point_keeping"
PATH_SPEED_MPS = 1.0
PATH_CLEAR_M = 15.0
TUNNEL_REACH_M = 4.0
"""Farther from its centre line a vehicle is beside the tunnel, not in it: on another leg."""


@dataclass
class Movement:
    """Distance, top speed, and for how long the vehicle has stayed in one place."""

    place_m: float = 1.0
    """Farther away is another place."""
    distance_m: float = 0.0
    max_speed_mps: float = 0.0
    still_s: float = 0.0
    _last: tuple[float, float] | None = None
    _anchor: tuple[float, float, float] = (math.inf, math.inf, 0.0)
    """x, y [m] and time [s] of the last place that it left."""

    def observe(self, truth: Truth) -> None:
        """Take the true state."""
        x, y, now_s = *truth.position_m[:2].tolist(), truth.time_ns * 1e-9
        if self._last is not None:
            self.distance_m += math.hypot(x - self._last[0], y - self._last[1])
        self._last = (x, y)
        self.max_speed_mps = max(self.max_speed_mps, abs(truth.speed_mps))
        if math.hypot(x - self._anchor[0], y - self._anchor[1]) >= self.place_m:
            self._anchor = (x, y, now_s)
        self.still_s = now_s - self._anchor[2]


@dataclass
class Judge:
    """Takes the truth every 20 ms; `outcome` is one word when the drive is over.

    The navigator's estimate and state enter the cross-track figures only, as defined.
    """

    course: Course
    departure_ends: bool = True
    """Whether leaving the corridor ends the drive."""
    outcome: str | None = None
    outline: Outline = field(default_factory=Outline)
    path: SmoothPath | None = None
    """The smooth path of the course's route, where one has it already: it takes a while."""
    pose: Pose | None = None
    """The last that was seen."""

    def __post_init__(self) -> None:
        course = self.course
        owners = {o.owner or o.name: o.kind for o in course.world.obstacles}
        corridor = Waypoints(course.waypoint_m, course.half_width_m, course.speed_mps)
        self.patience = course.patience
        self.movement = Movement(course.patience.metres)
        self.progress = Progress(course.waypoint_m, course.goal_m)
        self.departures = Departures(corridor)
        self.gates = GateKeeper(course.gates, self.outline)
        self.contacts = Contacts(frozenset(o for o, kind in owners.items() if kind in SOFT))
        self.falls = Falls()
        self.clearance = Clearance(course.world, self.outline)
        path = self.path or route_path(course)
        self.frames = frames(course)
        self.estimated, self.true, self.tunnel = CrossTrack(path), CrossTrack(path), Deviation()
        self._state_ticks: dict[str, int] = {}
        self._estimate_ns = -1

    def observe(
        self, truth: Truth, estimate: EgoEstimate | None, decision: Decision | None
    ) -> None:
        """Take the true state, and the navigator's latest reports."""
        x, y = truth.position_m[:2].tolist()
        self.pose = pose = (x, y, truth.heading_rad)
        self.movement.observe(truth)
        self.progress.observe((x, y), self.outline.nose_m(pose))
        self.departures.observe(truth.time_ns, self.progress.segment, truth.tire_center_m[:, :2])
        self.gates.observe(pose)
        self.contacts.observe(truth.time_ns, truth.contacts)
        self.falls.observe(truth)
        self.clearance.observe(truth.time_ns, pose)
        self._observe_lines(truth, estimate, decision)
        state = decision.state if decision else "starting"
        self._state_ticks[state] = self._state_ticks.get(state, 0) + 1
        self.outcome = self.outcome or self._verdict(truth.time_ns * 1e-9)

    def stop(self, word: str) -> None:
        """End the drive from outside, unless it is over."""
        self.outcome = self.outcome or word

    def _observe_lines(
        self, truth: Truth, estimate: EgoEstimate | None, decision: Decision | None
    ) -> None:
        """Cross track at the rate of the estimate, so that each one counts once."""
        if estimate is None or decision is None or estimate.time_ns == self._estimate_ns:
            return
        self._estimate_ns = estimate.time_ns
        place = truth.position_m[:2]
        counts = self._keeps_path(truth, decision)
        self.estimated.observe(estimate.position_m, counts)
        if counts:
            near = self.estimated.index
            self.true.observe(self.frames.to_route(place[None])[0], counts, near)
        if self.course.tunnel_center_line_m is not None:
            offset_m = line_offset_m(self.course.tunnel_center_line_m, place)
            if offset_m is not None and offset_m < TUNNEL_REACH_M:
                self.tunnel.add(offset_m)

    def _keeps_path(self, truth: Truth, decision: Decision) -> bool:
        return (
            decision.state == PATH_STATE
            and truth.speed_mps > PATH_SPEED_MPS
            and self.clearance.now_m > PATH_CLEAR_M
        )

    def _verdict(self, time_s: float) -> str | None:
        """The first of these that is so."""
        over = {
            "contact": self.contacts.count > 0,
            "departure": self.departure_ends and self.departures.count > 0,
            "fell": self.falls.fell,
            "finished": self.progress.finished,
            self.patience.word: self.movement.still_s >= self.patience.seconds,
            "timeout": time_s >= self.course.time_limit_s,
        }
        return next((word for word, is_so in over.items() if is_so), None)

    def figures(self) -> dict[str, Any]:
        """All that was measured, ready for JSON; None where there was nothing to measure."""
        return {
            "distance_m": self.movement.distance_m,
            "max_speed_mps": self.movement.max_speed_mps,
            "gates_passed": len(self.gates.passed),
            "gates_total": len(self.course.gates),
            "gates_missed": self.gates.missed(all_behind=self.progress.finished),
            "contacts": self.contacts.count,
            "contact_objects": self.contacts.objects,
            "grounded": self.contacts.grounded,
            "max_tilt_rad": self.falls.max_tilt_rad,
            "departures": self.departures.count,
            "min_clearance_m": self.clearance.least_m.get("other"),
            "gate_clearance_m": self.clearance.least_m.get("gate"),
            "tunnel_clearance_m": self.clearance.least_m.get("tunnel"),
            "tunnel_offset_rms_m": self.tunnel.rms_m,
            "tunnel_offset_max_m": self.tunnel.greatest_m if self.tunnel.count else None,
            "cross_track_rms_m": self.estimated.deviation.rms_m,
            "true_cross_track_rms_m": self.true.deviation.rms_m,
            "waypoints_passed": self.progress.passed,
            "waypoints_total": len(self.course.waypoint_m),
            "states": {state: n * TICK_S for state, n in self._state_ticks.items()},
        }
