"""The finite state machine of Fig. 6.3 in motion; who may follow whom stands in `transitions`."""

from collections.abc import Callable
from dataclasses import dataclass, field

from nav.messages import Gear
from nav.parameters import Parameters
from nav.states import (
    alarm,
    obstacle_avoidance,
    path_point_keeping,
    road_following,
    robotic_operations,
    rollback,
    tunnel_mode,
    watchdog,
)
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation
from nav.states.transitions import TRANSITIONS

STOP_MPS = 0.2
"""A set point below this is a stop."""
LONGEST_S = 0.5
"""A decision counts for at most this much time."""
PLANNERS: dict[str, Callable[[Situation, Memory, Parameters], Plan]] = {
    state.NAME: state.plan
    for state in (
        path_point_keeping,
        obstacle_avoidance,
        tunnel_mode,
        robotic_operations,
        alarm,
        road_following,
        rollback,
    )
}


@dataclass
class Machine:
    """The state in force, why it was entered, and what it remembers."""

    parameters: Parameters
    state: str = path_point_keeping.NAME
    reason: str = "start"
    by: str = ""
    """The name of the guard that led here."""
    memory: Memory = field(default_factory=Memory)
    dog: watchdog.Watchdog = field(default_factory=watchdog.Watchdog)
    _time_ns: int | None = None

    def decide(self, s: Situation) -> Plan:
        """Change state if a transition is due, then plan."""
        self._observe(s)
        if self.dog.drives_s is None:
            self._change(s)
        elif reason := self.dog.lets_go(s, self.memory.entered, self.parameters.states.watchdog):
            self.dog.release()
            self._enter(path_point_keeping.NAME, reason, "lets_go", s)
        return self._plan(s)

    def _observe(self, s: Situation) -> None:
        since_s = 0.0 if self._time_ns is None else (s.time_ns - self._time_ns) * 1e-9
        elapsed_s, self._time_ns = min(since_s, LONGEST_S), s.time_ns
        p = self.parameters.states
        self.dog.observe(s, self.state, elapsed_s, p.watchdog)
        self.memory.trouble.observe(s, elapsed_s, p.stuck)
        if s.gear != Gear.REVERSE:
            self.memory.trail.record(s.pose, p.rollback.longest_m)

    def _change(self, s: Situation) -> None:
        if reason := self.dog.bites(self.parameters.states.watchdog):
            self.dog.seize()
            self._enter(path_point_keeping.NAME, reason, "bites", s)
            return
        for target, guard in TRANSITIONS[self.state]:
            if reason := guard(s, self.memory, self.parameters):
                self._enter(target, reason, guard.__name__, s)
                return

    def _enter(self, state: str, reason: str, by: str, s: Situation) -> None:
        self.state, self.reason, self.by = state, reason, by
        self.memory.enter(s.pose, s.time_ns)
        if state in (robotic_operations.NAME, rollback.NAME):
            self.memory.trouble.begin(s)

    def _plan(self, s: Situation) -> Plan:
        if self.dog.drives_s is not None:
            return watchdog.plan(s, self.memory, self.parameters)
        plan = PLANNERS[self.state](s, self.memory, self.parameters)
        trouble = self.memory.trouble
        trouble.held = self.state in watchdog.MAIN_STATES and plan.speed_mps < STOP_MPS
        trouble.steers = self.state == obstacle_avoidance.NAME
        trouble.ahead_m = min(plan.D1_m, plan.D_m)
        return plan
