"""Fig. 6.13: the test on small robots."""

import numpy as np
from matplotlib.figure import Figure

from ion.figures.drives import Drives
from ion.figures.ground import Along, draw_ground, frame, legend, sheet
from ion.style import HARD, INK, PAPER, REAL, SEEN

NAME = "6.13"
TITLE = "The obstacle avoidance algorithm on a small robot"
SHOWS = (
    "A Pioneer P3-AT in a corridor: gates of two obstacles with a third just behind. The robot's "
    "outline is drawn every five seconds."
)
DIFFERS = (
    "The paper shows photographs of an ATRV outdoors and a Pioneer P3-AT indoors; this is the "
    "twin of the Pioneer in a corridor of ours."
)
EVERY = 25
"""Places of the trace, 0.2 s apart, between two outlines."""


def draw(drives: Drives) -> Figure:
    """The corridor from left to right."""
    drive = drives.robot
    way = drive.course.waypoint_m
    along = Along.line(way[0], way[-1])
    figure, axes = sheet(np.array([0.4, -2.5]), np.array([along.of(way)[-1, 0] + 0.4, 2.3]))
    draw_ground(axes, drive, along, 0.04)
    axes.plot([], [], "s", color=HARD, alpha=0.45, label="obstacles and walls")
    axes.plot([], [], "s", color=SEEN, markersize=4, label="obstacles seen")
    track = along.of(drive.recorder.track_m())
    axes.plot(*track.T, "-", color=REAL, linewidth=1.8, label="trajectory", zorder=5)
    for k in range(EVERY, len(track) - 1, EVERY):
        ahead = Along.line(track[k - 1], track[k + 1]).heading_rad
        x, y = track[k].tolist()
        border = drive.episode.judge.outline.border_m((x, y, ahead))
        axes.fill(
            *zip(*border, strict=True),
            facecolor=PAPER,
            edgecolor=INK,
            alpha=0.85,
            lw=0.9,
            zorder=4.5,
        )
    passed, of = len(drive.episode.judge.gates.passed), len(drive.course.gates)
    frame(axes, f"{drive.outcome}, {passed} of {of} gates passed", 1.0)
    legend(axes, 3)
    return figure
