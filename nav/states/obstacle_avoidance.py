"""Obstacle Avoidance: the fuzzy steering controller picks a direction (section 6.4.2).

D1, the distance in front of the vehicle, is measured along the local path in force: corridor
edges are boundaries, so straight ahead would mean a stop before every sharp turn.
"""

from functools import lru_cache

import numpy as np

from nav.parameters import Parameters
from nav.parameters.planning import PlanningParameters
from nav.planning.angles import wrapped
from nav.planning.local_path import path_length, pathpoints, towards
from nav.planning.scanning import Fan, fan, scan
from nav.planning.speed import set_point
from nav.planning.steering import decide
from nav.states.memory import Memory
from nav.states.replanning import blocked_in, due
from nav.states.situation import Plan, Situation

NAME = "obstacle_avoidance"


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """Scan all directions, decide, and lead ten pathpoints there."""
    ego = s.ego
    x, y = (float(v) for v in ego.position_m)
    curves = _fan(p.planning, ego.speed_mps)
    real, safe = scan(curves, s.boundaries, x, y, ego.heading_rad)
    reason = due(s, memory, p)
    theta = curves.theta_rad + ego.heading_rad
    decision = decide(
        theta,
        real,
        safe,
        ego.heading_rad,
        s.goal_rad,
        memory.decision_rad,
        ego.speed_mps,
        s.V0_mps,
        p.steering,
    )
    row = int(np.argmin(np.abs(theta - decision.theta_D)))
    memory.decision_rad = decision.theta_D
    if reason or memory.pathpoint_m is None:
        length = min(path_length(ego.speed_mps, p.planning.local_path), float(real[row]))
        path = towards(curves, row, x, y, ego.heading_rad)
        memory.follow(pathpoints(path, max(length, 1.0)), s.waypoint)
    assert memory.pathpoint_m is not None
    D = float(real[row])
    blocked = blocked_in(s, memory, p)
    D1 = D if blocked is None else blocked
    turn = abs(wrapped(decision.theta_D - ego.heading_rad))
    speed = set_point(D1, D, turn, s.V0_mps, decision.selected, p.speed).speed_mps
    return Plan(memory.pathpoint_m, speed, D1, D, decision.theta_D, decision.selected, reason)


def _fan(p: PlanningParameters, speed_mps: float) -> Fan:
    """The tightest turn that the speed allows."""
    tightest = speed_mps**2 / p.speed.lateral_mps2
    radii = p.scanning.turn_radius_m
    return _fans(p)[next((i for i, r in enumerate(radii) if r >= tightest), len(radii) - 1)]


@lru_cache(maxsize=8)
def _fans(p: PlanningParameters) -> tuple[Fan, ...]:
    return tuple(fan(p.scanning, p.footprint, r) for r in p.scanning.turn_radius_m)
