"""Courses and drives drawn along their way: the line from one point to another is horizontal."""

from dataclasses import dataclass
from math import atan2, cos, sin

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ion.figures.drives import Drive
from ion.map_layers import draw_corridor, shadow
from ion.style import HARD, INK, PAPER, SEEN, head, new_figure
from nav.messages import Floats

WIDTH_IN, AROUND_IN = 12.0, 0.75
"""Width of a picture, and what title and legend take of its height."""


@dataclass(frozen=True)
class Along:
    """A frame with its x axis from one point of the world towards another."""

    origin_m: tuple[float, float]
    heading_rad: float

    @classmethod
    def line(cls, start_m: Floats, end_m: Floats) -> "Along":
        """From `start_m` (2,) towards `end_m` (2,)."""
        east, north = (end_m - start_m).tolist()
        x, y = start_m.tolist()
        return cls((x, y), atan2(north, east))

    def of(self, point_m: Floats) -> Floats:
        """World points (n, 2) in this frame."""
        c, s = cos(self.heading_rad), sin(self.heading_rad)
        dx, dy = (np.asarray(point_m).reshape(-1, 2) - self.origin_m).T
        return np.stack([c * dx + s * dy, c * dy - s * dx], axis=1)


def draw_ground(axes: Axes, drive: Drive, along: Along, edge_m: float) -> None:
    """Corridor, what stands there, and what was seen of it."""
    course = drive.course
    draw_corridor(axes, along.of(course.waypoint_m), course.half_width_m, edge_m)
    draw_things(axes, drive, along)


def draw_things(axes: Axes, drive: Drive, along: Along, size: float = 2.2) -> None:
    """Obstacles as they stand, and the cells in which the navigator saw them."""
    for obstacle in drive.course.world.obstacles:
        axes.fill(*along.of(shadow(obstacle)).T, color=HARD, alpha=0.45, linewidth=0, zorder=3)
    axes.plot(
        *along.of(drive.cells_m).T, "s", color=SEEN, markersize=size, markeredgewidth=0, zorder=4
    )


def sheet(low_m: Floats, high_m: Floats) -> tuple[Figure, Axes]:
    """A picture as wide as the page and as high as the box between two corners (2,) needs."""
    across, up = (high_m - low_m).tolist()
    figure = new_figure(WIDTH_IN, WIDTH_IN * up / across + AROUND_IN)
    axes = figure.subplots()
    axes.set(xlim=(low_m[0], high_m[0]), ylim=(low_m[1], high_m[1]))
    return figure, axes


def frame(axes: Axes, title: str, unit_m: float) -> None:
    """Equal scales, no axes, a bar of `unit_m` in the lower left corner."""
    axes.set(aspect="equal", xticks=[], yticks=[])
    axes.set_facecolor(PAPER)
    axes.spines[:].set_visible(False)
    head(axes, title)
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    x, y = left + 0.02 * (right - left), bottom + 0.05 * (top - bottom)
    axes.plot([x, x + unit_m], [y, y], "-", color=INK, linewidth=1.6, zorder=10)
    text = f" {unit_m:g} m"
    axes.text(x + unit_m, y, text, color=INK, fontsize=8.5, va="center", zorder=10)


def legend(axes: Axes, columns: int) -> None:
    """Below the drawing."""
    axes.legend(
        loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=columns, frameon=False, fontsize=9,
        labelcolor=INK,
    )  # fmt: skip
