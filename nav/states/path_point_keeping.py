"""Path-Point Keeping: follow the smooth path of the route (section 6.4.1)."""

from math import inf, sqrt

import numpy as np

from nav.angles import wrapped
from nav.messages import FollowPath
from nav.parameters import Parameters
from nav.parameters.planning import SpeedProfileParameters
from nav.planning.curve import Curve
from nav.planning.local_path import path_length, pathpoints
from nav.planning.speed import set_point
from nav.states.memory import Memory
from nav.states.replanning import due
from nav.states.situation import Plan, Situation
from nav.steering_circle import curvature_rate

NAME = "path_point_keeping"
UNWOUND_S = 1.0
"""The path is to be driven as it runs from so far ahead on."""


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """Ten points of the smooth path; slow where it runs inside a safe boundary."""
    reason = due(s, memory, p)
    if reason or memory.pathpoint_m is None:
        length = path_length(s.ego.speed_mps, p.planning.local_path)
        memory.follow(pathpoints(s.route_ahead, length), s.waypoint)
    assert memory.pathpoint_m is not None
    direction = float(s.route_ahead.heading_rad[min(4, len(s.route_ahead.heading_rad) - 1)])
    turn = abs(wrapped(direction - s.ego.heading_rad))
    speed = p.planning.speed
    limit = min(
        s.V0_mps, _through_narrows(s, p), _settling(s, speed), bends_mps(s.route_ahead, speed),
        _unwinding(s, p),
    )  # fmt: skip
    clear = s.route_clear.real_m
    blocked = clear < s.route_ahead.arc_m[-1]  # the finish is no obstacle
    distance = clear if blocked else p.planning.local_path.look_ahead_m
    found = set_point(distance, distance, turn, limit, "safe", p.speed)
    command = FollowPath(s.time_ns, memory.pathpoint_m, found.speed_mps)
    return Plan(
        command, found.speed_mps, direction, distance, distance, replanned=reason, by_rules=found
    )


def _settling(s: Situation, p: SpeedProfileParameters) -> float:
    """Beyond the paper: where the corridor leaves no room to swing, the vehicle comes back to the
    smooth path before it makes haste; the steering takes a second from side to side."""
    astray = abs(s.cross_track_m) > p.settle_m or abs(s.turned_rad) > p.settle_rad
    return p.settle_mps if astray and s.narrowest_m < p.settle_half_width_m else inf


def bends_mps(ahead: Curve, p: SpeedProfileParameters) -> float:
    """Beyond the paper: V0 knows the bends of the route, not those of the way back to it. [m/s]

    Args:
        ahead: the path as it is joined from where the vehicle is.
        p: lateral acceleration, and the braking that is counted on before each bend.
    """
    bend = p.lateral_mps2 / np.maximum(np.abs(ahead.curvature_per_m), 1e-4)
    return sqrt(float((bend + 2.0 * p.braking_mps2 * ahead.arc_m).min()))


def _unwinding(s: Situation, p: Parameters) -> float:
    """Beyond the paper: with the steering at the stops, and a path that soon runs otherwise, the
    vehicle turns on until the wheels have followed. No faster than that it turns by little."""
    ahead = s.route_ahead
    soon = int(ahead.arc_m.searchsorted(UNWOUND_S * max(s.ego.speed_mps, 1.0)))
    off = s.curvature_per_m - float(ahead.curvature_per_m[min(soon, len(ahead.arc_m) - 1)])
    rate = curvature_rate(p.vehicle.steering)  # it takes off / rate, at half of `off` on average
    return 2.0 * p.planning.speed.settle_rad * rate / max(off**2, 1e-6)


def _through_narrows(s: Situation, p: Parameters) -> float:
    """Speed from which braking reaches `narrow_mps` where the safe boundary begins: none in sight
    may begin behind the horizon."""
    speed = p.planning.speed
    return sqrt(speed.narrow_mps**2 + 2.0 * speed.braking_mps2 * s.route_clear.safe_m)
