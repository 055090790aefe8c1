"""What happened in a drive, and when: for reports, and to jump to in the viewer."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from nav.messages import Decision
from scenarios.episode import Episode
from tape.record import Record

EVERY = 5
"""Ticks between two looks at what the judge has counted: 0.1 s."""


class Event(NamedTuple):
    """One thing that happened."""

    time_s: float
    kind: str
    """`state`, `gate`, `missed`, `contact`, `grounded`, `departure` or `end`."""
    text: str


class Events:
    """Watches a run."""

    def __init__(self) -> None:
        self.found: list[Event] = []
        self._state = ("", "")
        self._counts: dict[str, int] = {}
        self._tick = 0

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take what the navigator reported and what the judge has counted."""
        for record in records:
            if isinstance(record.message, Decision):
                self._follow(episode.time_s, record.message)
        if self._tick % EVERY == 0 or episode.outcome:
            self._count(episode)
        if episode.outcome:
            self.found.append(Event(episode.time_s, "end", episode.outcome))
        self._tick += 1

    def _count(self, episode: Episode) -> None:
        for kind, names in _counted(episode).items():
            new = names[self._counts.get(kind, 0) :]
            self.found += [Event(episode.time_s, kind, name) for name in new]
            self._counts[kind] = len(names)

    def _follow(self, now_s: float, decision: Decision) -> None:
        said = (decision.state, decision.reason)
        if said != self._state:
            self._state = said
            text = f"{decision.state.replace('_', ' ')}: {decision.reason}"
            self.found.append(Event(now_s, "state", text))


def _counted(episode: Episode) -> dict[str, list[str]]:
    """All that the judge has counted so far, in the order of counting."""
    judge = episode.judge
    return {
        "gate": [f"gate {k + 1}" for k in judge.gates.passed],
        "missed": [f"gate {k + 1}" for k in judge.gates.missed(bool(episode.outcome))],
        "contact": list(judge.contacts.objects),
        "grounded": ["chassis on the ground"] * judge.contacts.grounded,
        "departure": ["out of the corridor"] * judge.departures.count,
    }


def as_rows(events: Sequence[Event]) -> list[dict[str, Any]]:
    """For JSON."""
    return [event._asdict() for event in events]
