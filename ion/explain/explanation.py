"""One decision of a navigator and all that led to it: the numbers of Fig. 6.7."""

from dataclasses import dataclass, replace

from nav.messages import Floats
from nav.navigator import IonNavigator
from nav.parameters import Parameters
from nav.planning.curve import Curve
from nav.route.waypoints import Waypoints
from nav.states import obstacle_avoidance, path_point_keeping
from nav.states.memory import Memory
from nav.states.obstacle_avoidance import Considered, consider
from nav.states.situation import Plan, Situation

STEERED = (obstacle_avoidance.NAME, path_point_keeping.NAME)
"""States in which the steering fuzzy controller has something to say."""


@dataclass(frozen=True, eq=False)
class Explanation:
    """What a decision saw, weighed and decided."""

    state: str
    reason: str
    """Why the state was entered."""
    guard: str
    """The name of the transition's guard, empty at the start."""
    situation: Situation
    plan: Plan
    considered: Considered | None
    """What the steering fuzzy controller makes of it; None in states that do not ask it."""
    in_force: bool
    """Whether the vehicle is steered by that; elsewhere it is what the controller would do."""
    previous_rad: float | None
    """theta_D(k-1), which the persistence rules look at."""
    parameters: Parameters
    waypoints: Waypoints
    refused_s: dict[str, float]
    """For how long the ego state has refused a source, [s]; empty while it believes all."""
    cells_m: Floats
    """Shape (n, 2), occupied cells of the local map."""
    path: Curve | None
    """The local path in force."""
    pathpoint_m: Floats | None
    """Shape (10, 2), the points that it leads through."""

    @property
    def time_s(self) -> float:
        """When it was decided."""
        return self.situation.time_ns * 1e-9

    @property
    def relative_rad(self) -> Floats:
        """The directions as seen from the vehicle, left positive, shape (n,)."""
        assert self.considered is not None
        return self.considered.curves.theta_rad


def explanation_of(navigator: IonNavigator) -> Explanation | None:
    """The last decision of a navigator, which is not changed; None before the first."""
    high = navigator.high_level
    if high.situation is None or high.plan is None:
        return None
    machine = high.machine
    memory = machine.memory
    # theta_D(k-1) is by now what the memory calls former
    in_force = machine.state == obstacle_avoidance.NAME and bool(high.plan.selected)
    then = replace(memory, decision_rad=memory.former_rad) if in_force else memory
    return Explanation(
        state=machine.state,
        reason=machine.reason,
        guard=machine.by,
        situation=high.situation,
        plan=high.plan,
        considered=_considered(high.situation, machine.state, then, navigator.parameters),
        in_force=in_force,
        previous_rad=then.decision_rad,
        parameters=navigator.parameters,
        waypoints=high.waypoints,
        refused_s=navigator.ego.refused_s(high.situation.time_ns),
        cells_m=navigator.obstacles.occupied().position_m,
        path=memory.curve,
        pathpoint_m=memory.pathpoint_m,
    )


def _considered(s: Situation, state: str, memory: Memory, p: Parameters) -> Considered | None:
    return consider(s, memory, p) if state in STEERED else None
