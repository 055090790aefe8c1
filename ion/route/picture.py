"""A route as a picture: where it leads, and its limits along the way."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from ion.style import DPI, INK, QUIET, REAL, SPEED_MAP, new_figure, plain
from nav.route.rddf import FOOT_M, MPH_MPS, Route
from nav.route.waypoints import route_frame, waypoints_of
from scenarios.course import Floats
from scenarios.route.statistics import miles_at, turns_rad

MARKS = 12
"""About so many numbers of miles along the way."""


def draw(route: Route, path: Path) -> None:
    """Write the picture as PNG.

    Raises:
        OSError: the file cannot be written.
    """
    figure = new_figure(12.0, 10.5)
    grid = figure.add_gridspec(4, 1, height_ratios=[7.0, 1.2, 1.2, 1.2])
    _draw_map(figure, figure.add_subplot(grid[0]), route)
    miles, mph = miles_at(route), route.speed_mps / MPH_MPS
    feet = route.half_width_m / FOOT_M
    turns = np.degrees(np.abs(np.concatenate([[0.0], turns_rad(route), [0.0]])))
    for k, (title, values) in enumerate(
        (("speed limit, mph", mph), ("half-width, ft", feet), ("turns, degrees", turns)), start=1
    ):
        axes = figure.add_subplot(grid[k])
        plain(axes, title)
        axes.step(miles, values, where="post", color=REAL, linewidth=0.8)
        axes.set_xlim(0.0, miles[-1])
        axes.set_xlabel("miles" if k == 3 else "", color=INK)
    figure.savefig(path, dpi=DPI, format="png")


def _draw_map(figure: Figure, axes: Axes, route: Route) -> None:
    """The line, coloured by its speed limit."""
    at_km = waypoints_of(route, route_frame(route)).position_m / 1000.0
    mph = route.speed_mps[:-1] / MPH_MPS
    line = LineCollection(
        list(np.stack([at_km[:-1], at_km[1:]], axis=1)), cmap=SPEED_MAP, array=mph, linewidth=2.2,
        capstyle="round",
    )  # fmt: skip
    axes.add_collection(line)
    plain(axes, f"{route.name}: {len(route)} waypoints, {miles_at(route)[-1]:.1f} miles")
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale_view()
    axes.set_xlabel("km east of the start", color=INK)
    axes.set_ylabel("km north", color=INK)
    _mark_miles(axes, at_km, miles_at(route))
    figure.colorbar(line, ax=axes, label="speed limit, mph", shrink=0.6)


def _mark_miles(axes: Axes, at_km: Floats, miles: Floats) -> None:
    """A number every 1, 2 or 5 times a power of ten."""
    step = 10.0 ** np.floor(np.log10(miles[-1] / MARKS))
    step *= min((1.0, 2.0, 5.0, 10.0), key=lambda m: abs(m * step - miles[-1] / MARKS))
    for mile in np.arange(0.0, miles[-1], step):
        x, y = (float(np.interp(mile, miles, axis)) for axis in at_km.T)
        axes.plot(x, y, "o", color=INK, markersize=3.0)
        axes.annotate(f"{mile:g}", (x, y), (5.0, 5.0), textcoords="offset points", color=QUIET)
