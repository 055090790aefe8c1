"""Obstacle Avoidance: the fuzzy steering controller picks a direction (section 6.4.2).

The direction is decided on the real and the safe boundary. D1 and D, which decide the speed, end
where the outline itself would touch: a boundary that the vehicle may stray into must not stop it.
D1 is measured along the local path in force: corridor edges are boundaries, so straight ahead
would mean a stop before every sharp turn.
"""

from typing import NamedTuple

import numpy as np

from nav.angles import wrapped
from nav.messages import Floats, FollowPath
from nav.parameters import Parameters
from nav.planning.local_path import path_length, pathpoints, towards
from nav.planning.scanning import Distances, Fan, Turning, fan, scan
from nav.planning.speed import set_point
from nav.planning.steering import Aim, SteeringDecision, decide
from nav.states.memory import Memory
from nav.states.replanning import distance_ahead, due
from nav.states.situation import Plan, Situation
from nav.steering_circle import curvature_rate

NAME = "obstacle_avoidance"


class Considered(NamedTuple):
    """What the steering controller saw and decided: Fig. 6.7 in numbers."""

    curves: Fan
    theta_rad: Floats
    """Shape (n,), the directions in frame N."""
    distances: Distances
    goal_rad: float
    """phi(k)."""
    decision: SteeringDecision
    row: int
    """Of theta_D among the directions."""


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """Scan all directions, decide, and lead ten pathpoints there."""
    memory.trouble.look(s, p.states.stuck)
    found = consider(s, memory, p)
    decision, row = found.decision, found.row
    reason = due(s, memory, p)
    memory.former_rad, memory.decision_rad = memory.decision_rad, decision.theta_D
    reason = reason or _turned(memory, found.theta_rad[row], p)
    if reason or memory.pathpoint_m is None:
        memory.follow(_pathpoints(s, found, p), s.waypoint)
    assert memory.pathpoint_m is not None
    D = float(found.distances.touch_m[row])
    D1 = distance_ahead(s, memory, D, p)
    limit = min(s.V0_mps, p.planning.speed.avoid_mps)
    turn = abs(wrapped(decision.theta_D - s.ego.heading_rad))
    speed = set_point(D1, D, turn, limit, decision.selected, p.speed)
    command = FollowPath(s.time_ns, memory.pathpoint_m, speed.speed_mps)
    return Plan(command, speed.speed_mps, decision.theta_D, D1, D, decision.selected, reason, speed)


def consider(s: Situation, memory: Memory, p: Parameters) -> Considered:
    """Scan all directions and decide; changes nothing."""
    x, y, heading = s.pose
    curves = fan(p.planning.scanning, p.planning.footprint, _turning(s, p))
    distances = scan(curves, s.boundaries, p.planning.footprint, x, y, heading)
    theta, goal = curves.theta_rad + heading, memory.trouble.goal_rad(s)
    reach = memory.trouble.reach_m(s)
    decision = decide(
        theta,
        distances.real_m,
        distances.safe_m,
        Aim(heading, goal, memory.decision_rad, reach),
        s.ego.speed_mps,
        s.V0_mps,
        p.steering,
    )
    row = int(np.argmin(np.abs(theta - decision.theta_D)))
    return Considered(curves, theta, distances, goal, decision, row)


def _pathpoints(s: Situation, found: Considered, p: Parameters) -> Floats:
    """Along the decided curve, as far as it is free; and in any case on to where the steering has
    answered, or who strays into the real boundary would be led straight on into the obstacle."""
    local, speed = p.planning.local_path, s.ego.speed_mps
    _, real_m, touch_m = (float(each[found.row]) for each in found.distances)
    answered_m = max(min(local.answer_s * speed, touch_m), local.shortest_m)
    length = max(min(path_length(speed, local), real_m), answered_m)
    return pathpoints(towards(found.curves, found.row, *s.pose), length)


def _turned(memory: Memory, decision_rad: float, p: Parameters) -> str:
    """Beyond Fig. 6.4: a path that no longer leads where the decision points is stale."""
    if memory.curve is None:
        return ""
    off = abs(wrapped(decision_rad - float(memory.curve.heading_rad[-1])))
    return "direction changed" if off > p.planning.local_path.turn_rad else ""


def _turning(s: Situation, p: Parameters) -> Turning:
    steering, scanning = p.vehicle.steering, p.planning.scanning
    speed = max(s.ego.speed_mps, scanning.slowest_mps)
    return Turning(
        curvature_per_m=s.curvature_per_m,
        delay_m=steering.delay_s * max(s.ego.speed_mps, 0.0),
        rate_per_m2=curvature_rate(steering) / speed,
        limit_per_m=min(
            1.0 / (scanning.radius_margin * steering.minimum_radius_m),
            scanning.lateral_mps2 / speed**2,
        ),
    )
