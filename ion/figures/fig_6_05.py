"""Fig. 6.5: the smooth path, on points and in a drive."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ion.figures.drives import Drive, Drives
from ion.figures.ground import frame, legend
from ion.map_layers import draw_corridor
from ion.style import DECIDED, INK, PAPER, QUIET, REAL, new_figure, plain
from nav.messages import Floats
from nav.route.smooth_path import catmull_rom

NAME = "6.5"
TITLE = "Smooth path generation"
SHOWS = (
    "a) Eight points and the curve of (6.1) with the coefficients (6.4) through them. b) Two "
    "bends of the NQE: the local paths of ten pathpoints that were planned, and the trajectory "
    "that was driven; waypoints lie in the centres of the circles, which are as wide as the "
    "corridor."
)
DIFFERS = (
    "The paper's eight points are not given, so these are ours, and so is the plan of the "
    "course. Our curve does not go through the waypoints of a bend: corners are rounded inside "
    "the corridor before (6.4) interpolates."
)
POINTS_M = np.array(
    [[0, 0], [10, 7], [22, 6], [30, -3], [42, -6], [52, 3], [57, 15], [70, 18]], dtype=np.float64
)
"""P1 to P8."""
SHOWN_M = 140.0
"""How much of the way b) shows."""


def draw(drives: Drives) -> Figure:
    """Both parts."""
    figure = new_figure(12.0, 5.2)
    left, right = figure.subplots(1, 2, width_ratios=[1.0, 1.25])
    _points(left)
    _driven(right, drives.two_cars)
    return figure


def _points(axes: Axes) -> None:
    plain(axes, "a) Eight points and the curve (6.1), (6.4)")
    axes.plot(*POINTS_M.T, ":", color=QUIET, linewidth=1.0)
    axes.plot(*catmull_rom(POINTS_M, 40)[0].T, "-", color=REAL, linewidth=2.2)
    axes.plot(*POINTS_M.T, "o", color=DECIDED, markersize=7, markeredgecolor=PAPER)
    for k, (x, y) in enumerate(POINTS_M.tolist(), start=1):
        axes.annotate(
            f"$P_{k}$", (x, y), (0, 8), textcoords="offset points", color=INK, ha="center"
        )
    axes.set(aspect="equal", ylim=(-12, 24), xlim=(-5, 75))
    axes.set_xlabel("x [m]", fontsize=9, color=INK)
    axes.set_ylabel("y [m]", fontsize=9, color=INK)


def _driven(axes: Axes, drive: Drive) -> None:
    course = drive.course
    draw_corridor(axes, course.waypoint_m, course.half_width_m, 0.4)
    turn = np.linspace(0.0, 2.0 * np.pi, 60)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    for place, radius in zip(course.waypoint_m, course.half_width_m.tolist(), strict=True):
        axes.plot(*(place + radius * circle).T, "-", color=QUIET, linewidth=0.5, zorder=2)
    track = _first(drive.recorder.track_m())
    for number, planned in enumerate(drive.recorder.planned):
        points = drive.frames.to_world(planned.pathpoint_m)
        if np.hypot(*(track - points[-1]).T).min() > 3.0:
            break  # the rest lies beyond
        label = "planned paths" if number == 0 else None
        axes.plot(
            *points.T, ".-", color=DECIDED, linewidth=0.8, markersize=4, label=label, zorder=5
        )
    axes.plot(*track.T, "-", color=REAL, linewidth=2.0, label="trajectory", zorder=6)
    low, high = track.min(axis=0) - 10.0, track.max(axis=0) + 10.0
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    frame(axes, "b) Planned paths and trajectory in two bends of the NQE", 20.0)
    legend(axes, 2)


def _first(track_m: Floats) -> Floats:
    """The places of the stretch that is shown."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(track_m, axis=0).T))])
    return track_m[arc <= SHOWN_M]
