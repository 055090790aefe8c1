"""Speed and steering around the moment, and the states of the whole drive as a band."""

from html import escape
from itertools import pairwise

import numpy as np
import viser
from viser import uplot

from ion.style import AHEAD, DECIDED, INK, STATES, TRACK
from ion.view.series import Columns
from ion.view.timeline import Timeline
from ion.view.words import state_name
from nav.messages import Floats

BEFORE_S, AFTER_S = 25.0, 10.0
"""What the curves show around the moment."""
HEIGHT_PX = 150


class Curves:
    """Draws them into the panel that is open when it is made."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._speed = _plot(gui, "speed [m/s]", ("speed", TRACK), ("set point", DECIDED))
        self._steering = _plot(gui, "steering [deg], left up", ("is", TRACK), ("target", DECIDED))

    def show(self, timeline: Timeline, time_s: float) -> None:
        """Move them to a time."""
        span = (time_s - BEFORE_S, time_s + AFTER_S)
        speed = _column(timeline.estimated, span, 4)
        _update(self._speed, time_s, speed, _column(timeline.set_point, span, 1), least=4.0)
        angle, target = (
            _column(column, span, 1, np.degrees(1.0))
            for column in (timeline.steering, timeline.steering_target)
        )
        _update(self._steering, time_s, angle, target, least=12.0)


def band(timeline: Timeline, time_s: float) -> str:
    """The states over the drive as far as it is read, the moment, and a legend: HTML."""
    end_s = max(timeline.end_s, 1e-3)
    starts = [*timeline.states, (end_s, "", "")]
    bars = [
        f'<i style="position:absolute;top:0;bottom:0;left:{100 * a[0] / end_s:.2f}%;'
        f'width:{100 * (b[0] - a[0]) / end_s:.2f}%;background:{color(a[1])}"></i>'
        for a, b in pairwise(starts)
    ]
    here = f'<i style="position:absolute;top:-3px;bottom:-3px;left:{100 * time_s / end_s:.2f}%;\
width:2px;background:{INK}"></i>'
    return (
        f'<div style="margin:2px 12px 6px 12px"><div style="position:relative;height:14px;'
        f'background:{AHEAD}">{"".join(bars)}{here}</div>{_legend(timeline)}</div>'
    )


def color(state: str) -> str:
    """Of a state."""
    return STATES.get(state, AHEAD)


def _legend(timeline: Timeline) -> str:
    names = dict.fromkeys(state for _, state, _ in timeline.states)
    words = [
        f'<span style="white-space:nowrap"><b style="color:{color(name)}">&#9632;</b> '
        f"{escape(state_name(name))}</span>"
        for name in names
    ]
    return f'<div style="font-size:11px;line-height:1.4">{" &nbsp; ".join(words)}</div>'


def _plot(
    gui: viser.GuiApi, title: str, first: tuple[str, str], second: tuple[str, str]
) -> viser.GuiUplotHandle:
    """Two curves and an upright line, over seconds."""
    named = [uplot.Series(label=label, stroke=stroke, width=2) for label, stroke in (first, second)]
    now = uplot.Series(label="now", stroke=INK, width=1)
    return gui.add_uplot(
        (np.array([0.0, 1.0]), *[np.zeros(2)] * 3),
        (uplot.Series(label="s"), *named, now),
        title=title,
        scales=_scales(0.0, 0.0, 1.0),
        legend=uplot.Legend(show=True, live=False),
        padding=(10, 14, 0, 0),
        height=HEIGHT_PX,
    )


def _update(
    plot: viser.GuiUplotHandle, time_s: float, first: Floats, second: Floats, least: float
) -> None:
    """Show two curves (n, 2) of time and value.

    Args:
        plot: of `_plot`.
        time_s: the moment.
        first: one curve.
        second: the other, at its own times.
        least: what the axis shows at least.
    """
    at = np.union1d(first[:, 0], second[:, 0])
    low = min(0.0, *(float(c[:, 1].min(initial=0.0)) for c in (first, second)))
    high = max(float(c[:, 1].max(initial=0.0)) for c in (first, second))
    high = max(-low, high, least)
    low = -high if low < -0.1 * least else 0.0
    x = np.sort(np.concatenate([at, [time_s, time_s + 1e-6]]))
    now = np.full(len(x), np.nan)
    k = int(np.searchsorted(x, time_s))
    now[k], now[k + 1] = low, high
    plot.data = (x, _over(first, x), _over(second, x), now)
    plot.scales = _scales(time_s, low, high)


def _over(curve: Floats, x: Floats) -> Floats:
    """A curve at other times, without a value beyond its ends."""
    if not len(curve):
        return np.full(len(x), np.nan)
    return np.interp(x, curve[:, 0], curve[:, 1], np.nan, np.nan)


def _scales(time_s: float, low: float, high: float) -> dict[str, uplot.Scale]:
    """The axes: seconds, not dates."""
    return {
        "x": uplot.Scale(time=False, auto=False, range=(time_s - BEFORE_S, time_s + AFTER_S)),
        "y": uplot.Scale(auto=False, range=(low, high * 1.05)),
    }


def _column(columns: Columns, span: tuple[float, float], index: int, factor: float = 1.0) -> Floats:
    """Time and one value, shape (n, 2)."""
    return columns.between(*span)[:, [0, index]] * [1.0, factor]
