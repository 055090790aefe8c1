"""What a drive leaves for figures: places, planned paths, obstacles seen, one decision."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ion.explain.explanation import Explanation, explanation_of
from ion.trace import Trace
from nav.angles import wrapped
from nav.messages import Decision, Floats, FollowPath
from tape.record import Record

if TYPE_CHECKING:
    from scenarios.episode import Episode

Score = Callable[[Explanation], float]


class Planned(NamedTuple):
    """A new local path."""

    state: str
    pathpoint_m: Floats
    """Shape (10, 2), route frame N."""


def evades(why: Explanation) -> float:
    """How far a decision turns away from the goal, where an obstacle stands near ahead; any other
    decision is worth less, and least what the controller only would do."""
    found = why.considered
    if not why.in_force or found is None:
        return -1.0
    scanning = why.parameters.planning.scanning
    ahead_m = float(found.distances.real_m[len(found.theta_rad) // 2])
    near = 0.25 * scanning.max_distance_m < ahead_m < 0.8 * scanning.max_distance_m
    return abs(wrapped(found.decision.theta_D - found.goal_rad)) if near else 0.0


@dataclass
class Recorder:
    """Watches a run."""

    trace: Trace = field(default_factory=Trace)
    planned: list[Planned] = field(default_factory=list[Planned])
    chosen: Explanation | None = None
    """The decision that evades most."""
    _best: float = -2.0

    def __call__(self, episode: "Episode", records: Sequence[Record]) -> None:
        """Take what is new."""
        self.trace(episode, records)
        said = {type(record.message): record.message for record in records}
        decision, command = said.get(Decision), said.get(FollowPath)
        if not isinstance(decision, Decision):
            return
        if decision.replanned and isinstance(command, FollowPath):
            self.planned.append(Planned(decision.state, command.pathpoint_m))
        why = explanation_of(episode.navigator)
        if why and why.considered:
            self._choose(why)

    def _choose(self, why: Explanation) -> None:
        score = evades(why)
        if score > self._best:
            self._best, self.chosen = score, why

    def track_m(self) -> Floats:
        """Where the reference point was, shape (n, 2), world frame."""
        return self.trace.track()[:, :2]

    def cells_m(self) -> Floats:
        """Obstacle cells ever seen, shape (n, 2), route frame N."""
        return np.asarray(self.trace.cells_m())
