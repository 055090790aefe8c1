"""What stands beside the scene of an exported page: words, states, curves and events, as data."""

import re
from html import escape
from typing import Any

import numpy as np

from ion.view.curves import color
from ion.view.show import Show
from ion.view.words import sentence, state_name

WORDS_S, CURVES_S = 0.5, 0.2
LEFT_OUT = (
    "point clouds at 2 Hz, as half floats (they err by up to 3 cm); "
    "the trajectory as it grows (it is drawn whole); "
    "cameras other than the mouse; decisions (Fig. 6.7) and tuning; {more}"
)


def told(show: Show, title: str, span_s: tuple[float, float]) -> dict[str, Any]:
    """All of it, in seconds of the drive."""
    start_s, end_s = span_s
    within = [mark for mark in show.events() if start_s <= mark.time_s <= end_s]
    return {
        "title": title,
        "command": show.recorded.command,
        "start_s": start_s,
        "end_s": end_s,
        "left_out": _left_out(show, span_s),
        "words": _words(show, span_s),
        "states": _states(show, span_s),
        "curves": _curves(show, span_s),
        "events": [[round(mark.time_s, 2), mark.text] for mark in within],
    }


def _left_out(show: Show, span_s: tuple[float, float]) -> str:
    end_s = show.timeline.end_s
    whole = span_s[0] <= show.timeline.start_s + 1e-9 and span_s[1] >= end_s - 1e-9
    part = f"the drive before {span_s[0]:.1f} s and after {span_s[1]:.1f} s, of {end_s:.1f} s"
    return LEFT_OUT.format(more="nothing of the drive's length" if whole else part)


def _words(show: Show, span_s: tuple[float, float]) -> list[list[Any]]:
    """When what is to be said, where it is something else than before: twice a second, and at once
    when the state changes."""
    found: list[list[Any]] = []
    changes = [time_s for time_s, *_ in show.timeline.states if span_s[0] <= time_s <= span_s[1]]
    for time_s in np.union1d(np.arange(*span_s, WORDS_S), changes).tolist():
        html = _html(sentence(show.timeline.at(time_s)))
        if not found or found[-1][1] != html:
            found.append([round(time_s, 2), html])
    return found


def _html(markdown: str) -> str:
    bold = re.sub(r"\*\*(.+?)\*\*", r"<b>\1</b>", escape(markdown))
    return bold.replace("\n\n", "<br>")


def _states(show: Show, span_s: tuple[float, float]) -> list[list[Any]]:
    return [
        [round(max(time_s, span_s[0]), 2), state_name(state), color(state)]
        for time_s, state, _ in show.timeline.states
        if time_s <= span_s[1]
    ]


def _curves(show: Show, span_s: tuple[float, float]) -> dict[str, list[float]]:
    """Each at the same times; before its first value a curve is at zero."""
    line, at = show.timeline, np.arange(*span_s, CURVES_S)
    columns = {
        "speed": (line.estimated, 4, 1.0), "set_point": (line.set_point, 1, 1.0),
        "steering": (line.steering, 1, np.degrees(1.0)),
        "target": (line.steering_target, 1, np.degrees(1.0)),
    }  # fmt: skip
    curves = {"time_s": np.round(at, 2).tolist()}
    for name, (column, index, factor) in columns.items():
        rows = column.between(0.0, span_s[1])
        value = np.interp(at, rows[:, 0], rows[:, index]) if len(rows) else np.zeros(len(at))
        curves[name] = np.round(value * factor, 2).tolist()
    return curves
