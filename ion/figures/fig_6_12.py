"""Fig. 6.12: over an obstacle-occupied terrain."""

import numpy as np
from matplotlib.figure import Figure

from ion.figures.drives import Drives
from ion.figures.ground import Along, frame, legend, sheet
from ion.map_layers import shadow
from ion.style import AHEAD, GOAL, INK, PAPER, REAL, SEEN

NAME = "6.12"
TITLE = "The trajectory over the obstacle-occupied terrain"
SHOWS = (
    "The simulator of section 6.5, equations (6.9) and (6.10): a point among random obstacles "
    "follows check points to its goal. Orange is what it sensed on its way, grey what is there."
)
DIFFERS = (
    "The field is ours: circles of 0.5 to 4 m in a square of 200 m, drawn by the seed. The "
    "paper's obstacles are already expanded; here they come raw and the navigator expands them."
)
MARGIN_M = np.array([16.0, 24.0])
"""Around the way, along and across it."""


def draw(drives: Drives) -> Figure:
    """The way from left to right, and what is near it."""
    drive = drives.field
    way = drive.course.waypoint_m
    along = Along.line(way[0], way[-1])
    track, points = along.of(drive.recorder.track_m()), along.of(way)
    both = np.vstack([track, points])
    figure, axes = sheet(both.min(axis=0) - MARGIN_M, both.max(axis=0) + MARGIN_M)
    for obstacle in drive.course.world.obstacles:
        axes.fill(
            *along.of(shadow(obstacle)).T,
            facecolor="none",
            edgecolor=AHEAD,
            linewidth=0.9,
            zorder=2,
        )
    axes.plot([], [], "-", color=AHEAD, label="obstacles")
    seen = along.of(drive.cells_m)
    axes.plot(*seen.T, "s", color=SEEN, ms=2.2, mew=0, label="locally sensed obstacles", zorder=4)
    axes.plot(*track.T, "-", color=REAL, linewidth=2.0, label="trajectory", zorder=5)
    axes.plot(*points.T, "x", color=GOAL, ms=8, mew=2.0, label="check points", zorder=6)
    for name, (x, y) in (("start", points[0]), ("goal", points[-1])):
        axes.annotate(
            name, (x, y), (0, 9), textcoords="offset points", color=INK, ha="center", zorder=7,
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.8},
        )  # fmt: skip
    frame(axes, f"{drive.outcome} in {drive.episode.time_s:.0f} s", 20.0)
    legend(axes, 4)
    return figure
