"""The waveform of what moved: logged and now over time, zoomed to where they differ."""

from collections.abc import Iterator
from itertools import groupby
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ion.replay.comparison import Comparison, Moved
from ion.style import (
    AHEAD,
    DECIDED,
    INK,
    QUIET,
    STATES,
    new_figure,
    plain,
)
from scenarios.replay import Tick

WIDTH_IN, PANEL_IN, HEAD_IN = 13.0, 1.55, 1.5
PANELS = 6
"""Fields that are drawn, of those that moved most for what they are."""
STATE = "Decision.state"
Told = dict[str, list[tuple[float, object, object]]]
"""By kind of message: when, what the tape says, and what the replay says."""


class Waveform(NamedTuple):
    """A field over time, on the tape and in the replay."""

    time_s: list[float]
    logged: list[Any]
    now: list[Any]


def draw(comparison: Comparison, title: str) -> Figure:
    """The whole picture of a comparison that has a difference."""
    ticks = _where_it_moved(comparison)
    told = both(ticks)
    names = _most(comparison, told)
    figure = new_figure(WIDTH_IN, HEAD_IN + PANEL_IN * len(names))
    heights = [0.45, *[1.0] * len(names)]
    band, *panels = figure.subplots(len(heights), sharex=True, height_ratios=heights, squeeze=False)
    _draw_states(band[0], waveform(told, STATE))
    for (axes,), name in zip(panels, names, strict=True):
        _draw_field(axes, name, waveform(told, name))
    last = panels[-1][0] if panels else band[0]
    last.set_xlabel("simulated time [s]", color=INK, fontsize=9)
    last.set_xlim(ticks[0].time_ns * 1e-9, ticks[-1].time_ns * 1e-9)
    figure.suptitle(title, x=0.012, ha="left", color=INK, fontsize=11.5)
    return figure


def both(ticks: list[Tick]) -> Told:
    """What tape and replay both say, by kind of message; one pass for all fields."""
    told: Told = {}
    for tick in ticks:
        logged = {type(item.message): item.message for item in tick.logged}
        for now in (*tick.outputs.reports, tick.outputs.targets):
            if then := logged.get(type(now)):
                told.setdefault(type(now).__name__, []).append((tick.time_ns * 1e-9, then, now))
    return told


def waveform(told: Told, name: str) -> Waveform:
    """A field, such as `Decision.speed_mps`, of all ticks in which both have it."""
    kind, _, attribute = name.partition(".")
    found = told.get(kind, [])
    return Waveform(
        [time_s for time_s, _, _ in found],
        [getattr(message, attribute) for _, message, _ in found],
        [getattr(message, attribute) for _, _, message in found],
    )


def _where_it_moved(comparison: Comparison) -> list[Tick]:
    """From a little before the first difference to a little after the last."""
    kept = list(comparison.kept)
    first_s, last_s = kept[0].time_ns * 1e-9, max(m.last_s for m in comparison.moved.values())
    lead_s = comparison.first.time_s - first_s if comparison.first else 0.0
    return [tick for tick in kept if tick.time_ns * 1e-9 <= last_s + lead_s]


def _most(comparison: Comparison, told: Told) -> list[str]:
    """The fields of numbers that moved most, compared with how far they range."""
    moved = [(name, m) for name, m in comparison.moved.items() if m.most is not None]
    return sorted((n for n, _ in moved), key=lambda n: -_share(comparison.moved[n], told, n))[
        :PANELS
    ]


def _share(moved: Moved, told: Told, name: str) -> float:
    logged = [np.max(np.abs(value), initial=0.0) for value in waveform(told, name).logged]
    return (moved.most or 0.0) / (float(np.max(logged)) + 1e-12)


def _draw_states(axes: Axes, states: Waveform) -> None:
    """Two coloured bands; on a tape without decisions they stay empty."""
    plain(axes)
    axes.grid(visible=False)
    axes.set_ylim(-0.5, 1.5)
    axes.set_yticks([1.0, 0.0], ["logged", "now"])
    for y, words in ((1.0, states.logged), (0.0, states.now)):
        for word, start_s, end_s in _stretches(states.time_s, words):
            colour = STATES.get(word, AHEAD)
            axes.barh(y, end_s - start_s, 0.8, start_s, color=colour, linewidth=0)
    for word in dict.fromkeys(states.logged + states.now):
        axes.barh(0.0, 0.0, 0.0, color=STATES.get(word, AHEAD), label=word.replace("_", " "))
    if states.time_s:
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1), frameon=False, ncols=7, fontsize=8.5)


def _stretches(time_s: list[float], words: list[str]) -> Iterator[tuple[str, float, float]]:
    """Each word, with when it began and when the next did."""
    pairs = zip(words, time_s, strict=True)
    starts = [next(run) for _, run in groupby(pairs, itemgetter(0))]
    ends = [start for _, start in starts[1:]] + time_s[-1:]
    for (word, start_s), end_s in zip(starts, ends, strict=True):
        yield word, start_s, end_s


def _draw_field(axes: Axes, name: str, found: Waveform) -> None:
    """Both curves of a number; of an array, how far apart both are."""
    if not found.now or np.ndim(found.now[0]):
        plain(axes, f"{name}: largest difference")
        axes.plot(found.time_s, _apart(found), "-", color=DECIDED, linewidth=1.3)
        return
    plain(axes, name)
    axes.plot(found.time_s, found.logged, "-", color=QUIET, linewidth=2.6, label="logged")
    axes.plot(found.time_s, found.now, "-", color=DECIDED, linewidth=1.1, label="now")
    axes.legend(loc="lower right", bbox_to_anchor=(1, 0.97), frameon=False, fontsize=8.5, ncols=2)


def _apart(found: Waveform) -> list[float]:
    """The largest difference of two arrays; where their shapes differ there is none."""
    pairs = zip(found.logged, found.now, strict=True)
    return [
        float(np.abs(b - a).max(initial=0.0)) if a.shape == b.shape else np.nan for a, b in pairs
    ]
