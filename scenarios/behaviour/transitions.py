"""Transitions: which states the navigator was in, and whether Fig. 6.3 knows its ways."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from nav.messages import Decision
from nav.states.transitions import TRANSITIONS
from nav.states.watchdog import MAIN_STATES
from scenarios.behaviour.motion import newest
from scenarios.episode import Episode
from tape.record import Record

START = MAIN_STATES[0]
"""Where Fig. 6.3 begins, and where the watchdog leads from any state."""


def _known() -> frozenset[str]:
    """All transitions of the diagram, as `nav.states.diagram` draws it."""
    guarded = [f"{a}>{b}" for a, ways in TRANSITIONS.items() for b, _ in ways]
    return frozenset([*guarded, *(f"{a}>{START}" for a in TRANSITIONS if a != START)])


KNOWN = _known()


@dataclass
class Transitions:
    """Watches a run. From the decisions of the navigator."""

    taken: list[str] = field(default_factory=list)
    """Each once, as `from>to`, in the order of the first time."""
    entered: list[str] = field(default_factory=list)
    """States, each once."""
    _state: str = START

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the decision of this tick, if there is one."""
        del episode  # Unused.
        decision = newest(records, Decision)
        if decision:
            self._enter(decision.state)

    def _enter(self, state: str) -> None:
        taken = f"{self._state}>{state}"
        if state != self._state and taken not in self.taken:
            self.taken.append(taken)
        if state not in self.entered:
            self.entered.append(state)
        self._state = state

    def figures(self) -> dict[str, Any]:
        """Sorted, so that the figures of two drives compare."""
        return {
            "transitions": sorted(self.taken),
            "states_entered": sorted(self.entered),
            "transitions_unknown": [t for t in sorted(self.taken) if t not in KNOWN],
        }
