"""The page of a drive; pictures are in it, and it asks nobody for anything."""

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from string import Template
from typing import NamedTuple

from ion.style import DECIDED, GRID, INK, PAPER, PASSED, QUIET
from scenarios.events import Event

PAGE = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
body { background: $paper; color: $ink; font: 16px/1.5 sans-serif; margin: 2rem auto;
  max-width: 72rem; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin: 0; }
h2 { font-size: 1.15rem; margin: 2.5rem 0 .5rem; }
img { display: block; width: 100%; }
table { border-collapse: collapse; }
td { border-top: 1px solid $grid; padding: .15rem 1.5rem .15rem 0; vertical-align: top;
  overflow-wrap: anywhere; }
td:first-child { color: $quiet; white-space: nowrap; }
code { background: $grid; padding: .1rem .4rem; }
.good { color: $good; } .bad { color: $bad; font-weight: bold; }
.quiet { color: $quiet; }
details { max-height: 30rem; overflow: auto; }
</style>
</head>
<body>
<h1>$title</h1>
<p class="$mood">$verdict</p>
<p>To drive it again: <code>$command</code></p>
<h2>Verdict</h2>
<table>$rows</table>
<h2>Map</h2>
<img alt="Map of the drive" src="data:image/png;base64,$map">
<h2>Over time</h2>
<img alt="Speed, steering, pedals and cross track over time" src="data:image/png;base64,$curves">
<h2>Events</h2>
$events
<p class="quiet">$left_out</p>
</body>
</html>
""")
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
    colors = {"paper": PAPER, "ink": INK, "quiet": QUIET, "grid": GRID}
    words = {name: escape(getattr(told, name)) for name in ("title", "verdict", "command")}
    return PAGE.substitute(
        colors, **words, good=PASSED, bad=DECIDED, mood="good" if told.good else "bad",
        rows="".join(_row(*row) for row in told.rows), events=_events(told.events),
        map=b64encode(told.map_png).decode(), curves=b64encode(told.curves_png).decode(),
        left_out=escape(told.left_out),
    )  # fmt: skip


def _row(*cells: str, mood: str = "") -> str:
    inside = "".join(f"<td>{escape(cell)}</td>" for cell in cells)
    return f'<tr class="{mood}">{inside}</tr>' if mood else f"<tr>{inside}</tr>"


def _events(events: Sequence[Event]) -> str:
    if not events:
        return "<p>None on the tape.</p>"
    rows = [
        _row(f"{e.time_s:.1f} s", e.kind, e.text, mood="bad" if e.kind in BAD else "")
        for e in events
    ]
    return f"<details open><table>{''.join(rows)}</table></details>"
