"""The picture of what was rebuilt: corridor, driven way as estimated, things, and faults."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from ion.map_layers import draw_corridor
from ion.reconstruct.obstacles import rectangle_of
from ion.reconstruct.rebuilt import Rebuilt, place_m
from ion.style import INK, MISSED, PAPER, SEEN, TRACK, new_figure
from nav.messages import Floats
from nav.route.rddf import Route
from nav.route.waypoints import route_frame, waypoints_of
from scenarios.planned import Thing

WIDTH_IN, HEIGHT_IN = 13.0, 12.0
LEAST_SHARE = 0.25
"""Of the longer side of the map, for the shorter."""
MARGIN_M = 12.0
EDGE_M = 0.3
"""Of the corridor."""
THICK_PX = 1.5
"""Outline of things, so that a post is seen on a map of a mile."""


def draw(found: Rebuilt, route: Route, title: str) -> Figure:
    """North is up, metres east and north of the first waypoint: the numbers of the file."""
    waypoints = waypoints_of(route, route_frame(route))
    low, high = _box(found.evidence.way_m)
    figure = new_figure(WIDTH_IN, _height_in(low, high))
    axes = figure.add_subplot()
    draw_corridor(axes, waypoints.position_m, route.half_width_m, EDGE_M)
    _draw_things(axes, found.things)
    axes.plot(*found.evidence.way_m.T, "-", color=TRACK, linewidth=1.6, zorder=5,
              label="driven, as estimated")  # fmt: skip
    _draw_ends(axes, found.evidence.way_m)
    _draw_faults(axes, found)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    _frame(axes, title)
    figure.legend(loc="outside lower center", ncols=5, frameon=False, fontsize=8.5, labelcolor=INK)
    return figure


def _box(way_m: Floats) -> tuple[Floats, Floats]:
    """All that was driven; of a route that was not finished, not the rest."""
    low, high = way_m.min(axis=0) - MARGIN_M, way_m.max(axis=0) + MARGIN_M
    more = np.maximum(LEAST_SHARE * (high - low)[::-1] - (high - low), 0.0) / 2.0
    return low - more, high + more


def _height_in(low: Floats, high: Floats) -> float:
    width, height = (high - low).tolist()
    return min(0.93 * WIDTH_IN * height / width + 1.3, HEIGHT_IN)


def _draw_things(axes: Axes, things: list[Thing]) -> None:
    shapes = [rectangle_of(thing).corners_m() for thing in things]
    axes.add_collection(
        PolyCollection(
            shapes, facecolors=SEEN, edgecolors=SEEN, linewidths=THICK_PX, zorder=4,
            label="things, as they were seen",
        )
    )  # fmt: skip


def _draw_ends(axes: Axes, way_m: Floats) -> None:
    for (x, y), marker, label in ((way_m[0], "o", "start"), (way_m[-1], "X", "end")):
        axes.plot(x, y, marker, markersize=9, markerfacecolor="white", markeredgecolor=INK,
                  markeredgewidth=1.3, zorder=8, label=label, linestyle="none")  # fmt: skip


def _draw_faults(axes: Axes, found: Rebuilt) -> None:
    """Where each began; those at one place one above the other."""
    for k, fault in enumerate(found.faults):
        x, y = place_m(found.evidence, fault.begins).tolist()
        axes.plot(x, y, "v", color=MISSED, markersize=9, markeredgecolor=PAPER, zorder=9)
        axes.annotate(str(fault), (x, y), (10.0, 24.0 + 14.0 * (k % 4)),
                      textcoords="offset points", color=MISSED, fontsize=8.5, zorder=9,
                      arrowprops={"arrowstyle": "-", "color": MISSED, "linewidth": 0.7},
                      )  # fmt: skip
    if found.faults:
        axes.plot([], [], "v", color=MISSED, markersize=9, linestyle="none",
                  label="a fault begins")  # fmt: skip


def _frame(axes: Axes, title: str) -> None:
    axes.set_facecolor(PAPER)
    axes.spines[:].set_visible(False)
    axes.tick_params(colors=INK, labelsize=8.5)
    axes.set_xlabel("m east of the first waypoint", color=INK, fontsize=9)
    axes.set_ylabel("m north", color=INK, fontsize=9)
    axes.set_title(title, loc="left", color=INK, fontsize=11.5, fontweight="bold")
