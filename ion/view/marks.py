"""Moments worth jumping to."""

from collections.abc import Iterable
from typing import NamedTuple

from ion.recorded import Recorded
from ion.view.timeline import Timeline

MARGIN_S = 0.05
"""A mark this near is where one stands already."""


class Mark(NamedTuple):
    """One moment, and what happened then."""

    time_s: float
    text: str


def events(recorded: Recorded, timeline: Timeline) -> list[Mark]:
    """Changes of state as far as the tape is read, and what the judge counted."""
    judged = [Mark(e.time_s, _text(e.kind, e.text)) for e in recorded.events if e.kind != "state"]
    states = [Mark(t, f"{state.replace('_', ' ')}: {why}") for t, state, why in timeline.states]
    return sorted(judged + states)


def replannings(timeline: Timeline) -> list[Mark]:
    """New local paths, as far as the tape is read."""
    return [Mark(time_s, f"new path: {why}") for time_s, why in timeline.replanned]


def following(marks: Iterable[Mark], time_s: float) -> Mark | None:
    """The first behind a time."""
    return next((mark for mark in marks if mark.time_s > time_s + MARGIN_S), None)


def preceding(marks: Iterable[Mark], time_s: float) -> Mark | None:
    """The last before a time."""
    before = [mark for mark in marks if mark.time_s < time_s - MARGIN_S]
    return before[-1] if before else None


def _text(kind: str, text: str) -> str:
    return f"{kind}: {text}" if kind in ("contact", "missed", "end") else text
