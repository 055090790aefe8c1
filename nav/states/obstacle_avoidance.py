"""Obstacle Avoidance: the fuzzy steering controller picks a direction (section 6.4.2).

The direction is decided on the real and the safe boundary. D1 and D, which decide the speed, end
where the outline itself would touch: a boundary that the vehicle may stray into must not stop it.
D1 is measured along the local path in force: corridor edges are boundaries, so straight ahead
would mean a stop before every sharp turn.
"""

import numpy as np

from nav.angles import wrapped
from nav.parameters import Parameters
from nav.planning.local_path import path_length, pathpoints, towards
from nav.planning.scanning import Turning, fan, scan
from nav.planning.speed import set_point
from nav.planning.steering import Aim, decide
from nav.states.memory import Memory
from nav.states.replanning import distance_ahead, due
from nav.states.situation import Plan, Situation
from nav.steering_circle import curvature_rate

NAME = "obstacle_avoidance"


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """Scan all directions, decide, and lead ten pathpoints there."""
    ego = s.ego
    x, y = (float(v) for v in ego.position_m)
    curves = fan(p.planning.scanning, p.planning.footprint, _turning(s, p))
    distances = scan(curves, s.boundaries, x, y, ego.heading_rad)
    reason = due(s, memory, p)
    theta = curves.theta_rad + ego.heading_rad
    decision = decide(
        theta,
        distances.real_m,
        distances.safe_m,
        Aim(ego.heading_rad, s.goal_rad, memory.decision_rad),
        ego.speed_mps,
        s.V0_mps,
        p.steering,
    )
    row = int(np.argmin(np.abs(theta - decision.theta_D)))
    memory.decision_rad = decision.theta_D
    reason = reason or _turned(memory, theta[row], p)
    if reason or memory.pathpoint_m is None:
        length = min(
            path_length(ego.speed_mps, p.planning.local_path), float(distances.real_m[row])
        )
        path = towards(curves, row, x, y, ego.heading_rad)
        memory.follow(pathpoints(path, max(length, 1.0)), s.waypoint)
    assert memory.pathpoint_m is not None
    D = float(distances.touch_m[row])
    D1 = distance_ahead(s, memory, D, p)
    limit = min(s.V0_mps, p.planning.speed.avoid_mps)
    turn = abs(wrapped(decision.theta_D - ego.heading_rad))
    speed = set_point(D1, D, turn, limit, decision.selected, p.speed).speed_mps
    return Plan(memory.pathpoint_m, speed, D1, D, decision.theta_D, decision.selected, reason)


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
