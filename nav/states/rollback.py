"""Rollback: back along the recorded trajectory till another path can begin (section 6.3)."""

from math import hypot

from nav.messages import Gear, UnitOperation
from nav.parameters import Parameters
from nav.planning.arcs import curvature_back, free_arc
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation, stand
from nav.steering_circle import steering_angle

NAME = "rollback"
LOOK_M = 8.0
MARGIN_M = 0.5
"""It stops this far before what it would touch behind."""


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """One unit operation in reverse, steered anew at every decision."""
    curvature, way_m = _back(s, memory, p)
    if way_m <= 0.0:
        return stand(s)
    speed = p.states.rollback.speed_mps
    steering = steering_angle(curvature, p.vehicle.steering)
    back = UnitOperation(s.time_ns, Gear.REVERSE, steering, way_m, speed)
    return Plan(back, speed, s.goal_rad, way_m, way_m)


def way_back_m(s: Situation, memory: Memory, p: Parameters) -> float:
    """How far it can still drive back, [m]."""
    return _back(s, memory, p)[1]


def rolled_m(s: Situation, memory: Memory) -> float:
    """How far it is from where it began to drive back, [m]."""
    x, y, _ = memory.entered
    return hypot(s.pose[0] - x, s.pose[1] - y)


def _back(s: Situation, memory: Memory, p: Parameters) -> tuple[float, float]:
    """Curvature, and the way that is free on it before the trajectory's beginning."""
    memory.trail.unwind(s.pose)
    target = memory.trail.behind(s.pose, p.states.rollback.look_m)
    if target is None:
        return 0.0, 0.0
    curvature = curvature_back(*target, p.vehicle.steering.minimum_radius_m)
    free = free_arc(s.pose, curvature, -LOOK_M, s.boundaries, p.planning.footprint)
    return curvature, min(free - MARGIN_M, memory.trail.length_m)
