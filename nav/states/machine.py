"""The finite state machine of Fig. 6.3: who may follow whom, and why.

States that the machine does not list yet are not stubbed: Robotic Operations, Alarm, Road
Following, Rollback and the watchdog come as one file each beside these three.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

from nav.parameters import Parameters
from nav.states import obstacle_avoidance, path_point_keeping, tunnel_mode
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation

Guard = Callable[[Situation, Memory, Parameters], str]
"""Says why the transition is due, or nothing."""


def in_tunnel(s: Situation, memory: Memory, p: Parameters) -> str:
    """GPS is gone and there is a wall on either side; never GPS alone."""
    del memory
    lost = s.gps_lost_s > p.states.tunnel.gps_lost_s
    walls = tunnel_mode.between_walls(s, p.states.tunnel)
    return "no GPS between two walls" if lost and walls else ""


def out_of_tunnel(s: Situation, memory: Memory, p: Parameters) -> str:
    """The walls have ended."""
    if not tunnel_mode.sides_open(s, p.states.tunnel):
        memory.open_ns = None
        return ""
    if memory.open_ns is None:
        memory.open_ns = s.time_ns
    if s.gps_lost_s < p.states.tunnel.gps_back_s:
        return "walls ended, GPS is back"
    open_s = (s.time_ns - memory.open_ns) * 1e-9
    return "walls ended" if open_s > p.states.tunnel.leave_open_s else ""


def obstacle_ahead(s: Situation, memory: Memory, p: Parameters) -> str:
    """The smooth path comes across an obstacle (section 6.4.2)."""
    del memory, p
    blocked = s.route_clear.real_m < s.route_ahead.arc_m[-1]
    return f"obstacle on the smooth path in {s.route_clear.real_m:.0f} m" if blocked else ""


def route_clear(s: Situation, memory: Memory, p: Parameters) -> str:
    """The smooth path is free again."""
    return "" if obstacle_ahead(s, memory, p) else "smooth path is clear"


PLANNERS: dict[str, Callable[[Situation, Memory, Parameters], Plan]] = {
    path_point_keeping.NAME: path_point_keeping.plan,
    obstacle_avoidance.NAME: obstacle_avoidance.plan,
    tunnel_mode.NAME: tunnel_mode.plan,
}
TRANSITIONS: dict[str, tuple[tuple[str, Guard], ...]] = {
    path_point_keeping.NAME: (
        (tunnel_mode.NAME, in_tunnel),
        (obstacle_avoidance.NAME, obstacle_ahead),
    ),
    obstacle_avoidance.NAME: (
        (tunnel_mode.NAME, in_tunnel),
        (path_point_keeping.NAME, route_clear),
    ),
    tunnel_mode.NAME: ((path_point_keeping.NAME, out_of_tunnel),),
}


@dataclass
class Machine:
    """The state in force, why it was entered, and what it remembers."""

    parameters: Parameters
    state: str = path_point_keeping.NAME
    reason: str = "start"
    memory: Memory = field(default_factory=Memory)

    def decide(self, s: Situation) -> Plan:
        """Change state if a transition is due, then plan."""
        for target, guard in TRANSITIONS[self.state]:
            if reason := guard(s, self.memory, self.parameters):
                self.state, self.reason = target, reason
                self.memory.forget()
                break
        return PLANNERS[self.state](s, self.memory, self.parameters)
