"""A drive over time: speed, steering, pedals and cross track as curves, the states as a band."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ion.report.series import Series
from ion.style import DECIDED, GOAL, INK, QUIET, REAL, SAFE, SEEN, STATES, new_figure, plain
from nav.messages import ActuatorTargets, Decision, EgoEstimate, GpsFix, GpsQuality, VehicleState
from scenarios.events import Event
from tape.truth import TrueState

WIDTH_IN, HEIGHT_IN = 12.0, 9.0
MARKED = {"contact": DECIDED, "departure": DECIDED, "missed": DECIDED, "grounded": SEEN}
"""Events that stand in all plots as a line."""


def curves(series: Series, events: tuple[Event, ...]) -> Figure:
    """All plots, one above the other, over the same time."""
    figure = new_figure(WIDTH_IN, HEIGHT_IN)
    ratios = [0.35, 2.0, 1.3, 1.3, 1.3]
    axes = figure.subplots(len(ratios), 1, sharex=True, height_ratios=ratios)
    _states(axes[0], series)
    for draw, ax in zip((_speed, _steering, _pedals, _cross_track), axes[1:], strict=True):
        draw(ax, series)
        _mark(ax, events)
        ax.legend(loc="upper right", frameon=False, fontsize=8.5, labelcolor=INK, ncols=4)
    axes[-1].set_xlabel("time [s]", color=INK)
    axes[-1].set_xlim(0.0, max(series.end_s, 1.0))
    return figure


def _states(ax: Axes, series: Series) -> None:
    plain(ax, "State of the navigator")
    spans = series.spans()
    for state in dict.fromkeys(state for _, _, state in spans):
        bars = [(start, end - start) for start, end, other in spans if other == state]
        ax.broken_barh(bars, (0.0, 1.0), color=STATES.get(state, QUIET))
        ax.plot([], [], "s", color=STATES.get(state, QUIET), label=state.replace("_", " "))
    ax.set(yticks=[], ylim=(0.0, 1.0))
    ax.grid(visible=False)
    ax.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=8.5, ncols=7,
        labelcolor=INK, handletextpad=0.1, borderpad=0.1,
    )  # fmt: skip


def _speed(ax: Axes, series: Series) -> None:
    plain(ax, "Speed [m/s]")
    time_s = series.times(Decision)
    ax.step(time_s, series.of(Decision, "V0_mps"), color=QUIET, lw=0.9, label="limit V0")
    ax.step(time_s, series.of(Decision, "speed_mps"), color=GOAL, lw=0.9, label="set point")
    kind, label = (TrueState, "true") if len(series.times(TrueState)) else (EgoEstimate, "estimate")
    ax.plot(series.times(kind), series.of(kind, "speed_mps"), color=REAL, lw=1.2, label=label)


def _steering(ax: Axes, series: Series) -> None:
    plain(ax, "Road wheels [degrees, left positive]")
    for kind, color, label in ((ActuatorTargets, GOAL, "target"), (VehicleState, REAL, "reported")):
        angle = np.degrees(series.of(kind, "steering_rad"))
        ax.plot(series.times(kind), angle, color=color, lw=0.9, label=label)


def _pedals(ax: Axes, series: Series) -> None:
    plain(ax, "Pedals, and the gear")
    time_s = series.times(ActuatorTargets)
    ax.plot(time_s, series.of(ActuatorTargets, "throttle"), color=SAFE, lw=0.9, label="throttle")
    ax.plot(time_s, series.of(ActuatorTargets, "brake"), color=DECIDED, lw=0.9, label="brake")
    gear = series.of(VehicleState, "gear") / 3.0
    ax.step(series.times(VehicleState), gear, color=QUIET, lw=0.9, label="gear R N L H, upwards")


def _cross_track(ax: Axes, series: Series) -> None:
    plain(ax, "Offset from the smooth path, estimated [m, left positive]")
    offset = series.of(Decision, "cross_track_m")
    ax.plot(series.times(Decision), offset, color=REAL, lw=0.9, label="cross track")
    lost = series.of(GpsFix, "quality") == GpsQuality.NONE
    if lost.any():
        at = series.times(GpsFix)[lost]
        ax.plot(at, np.zeros(len(at)), "|", color=SEEN, markersize=5, label="no GPS fix")


def _mark(ax: Axes, events: tuple[Event, ...]) -> None:
    for event in events:
        if event.kind in MARKED:
            ax.axvline(event.time_s, color=MARKED[event.kind], lw=1.0, ls="--")
