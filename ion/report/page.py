"""The page of a drive."""

from collections.abc import Sequence
from html import escape
from string import Template
from typing import NamedTuple

from ion.html import document, image, mood, row
from scenarios.events import Event

BODY = Template("""<p class="$mood">$verdict</p>
<p>To drive it again: <code>$command</code></p>
<h2>Verdict</h2>
<table>$rows</table>
<h2>Map</h2>
$map
<h2>Over time</h2>
$curves
<h2>Events</h2>
$events
<p class="quiet">$left_out</p>""")
STYLE = """img { width: 100%; }
td:first-child { white-space: nowrap; }
details { max-height: 30rem; overflow: auto; }
"""
BAD = ("contact", "departure", "missed", "grounded")


class Told(NamedTuple):
    """All that the page says."""

    title: str
    verdict: str
    good: bool
    """Whether the drive finished."""
    command: str
    rows: Sequence[tuple[str, str]]
    """What was measured: a name and a text each."""
    map_png: bytes
    curves_png: bytes
    events: Sequence[Event]
    left_out: str
    """What this tape cannot tell."""


def page(told: Told) -> str:
    """The HTML file's text."""
    words = {name: escape(getattr(told, name)) for name in ("verdict", "command", "left_out")}
    body = BODY.substitute(
        words, mood=mood(told.good), rows="".join(row(*each) for each in told.rows),
        events=_events(told.events), map=image(told.map_png, "Map of the drive"),
        curves=image(told.curves_png, "Speed, steering, pedals and cross track over time"),
    )  # fmt: skip
    return document(told.title, body, STYLE)


def _events(events: Sequence[Event]) -> str:
    if not events:
        return "<p>None on the tape.</p>"
    rows = [
        row(f"{e.time_s:.1f} s", e.kind, e.text, mood="bad" if e.kind in BAD else "")
        for e in events
    ]
    return f"<details open><table>{''.join(rows)}</table></details>"
