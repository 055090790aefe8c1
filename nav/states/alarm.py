"""Alarm: a sensor has failed; the vehicle stands, and the sensor is reset (section 6.3)."""

from nav.parameters import Parameters
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation, stand

NAME = "alarm"


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """Reset the first of the failed sensors now and then; wait in between."""
    due_ns = p.states.alarm.reset_every_s * 1e9
    if memory.reset_ns is None or s.time_ns - memory.reset_ns >= due_ns:
        memory.reset_ns = s.time_ns
        return stand(s, reset=s.health.failed[0] if s.health.failed else "")
    return stand(s)
