"""Robotic Operations: back-and-forth unit operations that adjust heading and position (6.3)."""

from nav.messages import Gear, UnitOperation
from nav.parameters import Parameters
from nav.planning.arcs import free_arc
from nav.planning.unit_operations import Arc, search
from nav.states.manoeuvre import DONE_M, Manoeuvre
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation, stand
from nav.states.trouble import STILL_MPS
from nav.steering_circle import steering_angle

NAME = "robotic_operations"
STOP_M = 0.3
"""An operation ends this far before what has come into its way."""


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """Think at a stand, then drive one operation after the other; the gear takes its time."""
    if s.wide is None:
        return stand(s)  # the way around is not known before the next decision
    memory.manoeuvre = m = memory.manoeuvre or _begin(s, memory, p)
    if m.search.found is None:
        m.think(s.pose)
        return stand(s)
    arc = m.arc
    if arc is None:
        return stand(s)
    left_m = min(m.remaining_m(s.pose), _free_m(s, arc, p))
    if left_m < DONE_M and abs(s.ego.speed_mps) < STILL_MPS:
        m.cut_short = m.cut_short or m.driven_m < arc.length_m - 2.0 * STOP_M
        m.next()
        return stand(s)
    return _drive(s, arc, left_m, p)


def _begin(s: Situation, memory: Memory, p: Parameters) -> Manoeuvre:
    trouble = memory.trouble
    trouble.tries += 1
    trouble.look(s, p.states.stuck)
    way = trouble.way or [s.far_goal_m]
    # beside an obstacle, what seems free to operations need not be to the speed rules
    return Manoeuvre(search(p, s.pose, way, s.boundaries, back_first=trouble.tries % 2 == 0))


def _free_m(s: Situation, arc: Arc, p: Parameters) -> float:
    sign = -1.0 if arc.gear == Gear.REVERSE else 1.0
    way = sign * (arc.length_m + STOP_M)
    free = free_arc(s.pose, arc.curvature_per_m, way, s.boundaries, p.planning.footprint)
    return max(free - STOP_M, 0.0)


def _drive(s: Situation, arc: Arc, left_m: float, p: Parameters) -> Plan:
    speed = p.planning.operations.speed_mps
    steering = steering_angle(arc.curvature_per_m, p.vehicle.steering)
    operation = UnitOperation(s.time_ns, arc.gear, steering, left_m, speed)
    return Plan(operation, speed, s.goal_rad, left_m, left_m)
