"""Fig. 6.10: past two cars."""

import numpy as np
from matplotlib.figure import Figure

from ion.figures.drives import Drive, Drives, two_cars
from ion.figures.ground import Along, draw_ground, frame, legend, sheet
from ion.figures.record import Planned
from ion.style import DECIDED, REAL, SEEN
from nav.messages import Floats
from nav.route.rddf import MPH_MPS

NAME = "6.10"
TITLE = "Path planning in the two-car-passing section"
SHOWS = (
    "Two cars about 100 ft apart in a corridor of 15 ft half-width, passed from left to right: "
    "what the navigator saw of them, three of the local paths that it planned, and the "
    "trajectory."
)
DIFFERS = (
    "Where the cars stand is drawn by the seed. The drive begins two bends before this section, "
    "not at the start of the NQE. Behind what was seen the twin's cars are drawn in grey."
)
SHOWN_M, ASIDE_M = 38.0, 7.0
"""To either side of the middle, along and across."""


def draw(drives: Drives) -> Figure:
    """From left to right."""
    drive = drives.two_cars
    cars = np.array([car.center_m[:2] for car in two_cars(drive.course)])
    along = Along.line(cars[0], cars[-1])
    second = float(along.of(cars)[-1, 0])
    middle = 0.5 * second
    side = _middle(along.of(drive.course.waypoint_m), middle)
    figure, axes = sheet(
        np.array([middle - SHOWN_M, side - ASIDE_M]), np.array([middle + SHOWN_M, side + ASIDE_M])
    )
    draw_ground(axes, drive, along, 0.3)
    axes.plot([], [], "s", color=SEEN, markersize=4, label="obstacles seen")
    track = along.of(drive.recorder.track_m())
    axes.plot(*track.T, "-", color=REAL, linewidth=1.8, label="trajectory", zorder=5)
    for k, points in enumerate(_near(drive, along, (-14.0, middle - 8.0, second - 5.0))):
        label = "three of the planned paths" if k == 0 else None
        axes.plot(*points.T, "o-", color=DECIDED, markersize=5, lw=1.0, label=label, zorder=6)
    frame(axes, f"Past the two cars at {_fastest_mph(drive, along, middle):.0f} mph", 10.0)
    legend(axes, 3)
    return figure


def _near(drive: Drive, along: Along, starts_m: tuple[float, ...]) -> list[Floats]:
    """Of each place the planned path that begins nearest to it."""
    paths = [_points(drive, along, planned) for planned in drive.recorder.planned]
    begin = np.array([path[0] for path in paths])
    return [
        paths[int(np.argmin(np.hypot(begin[:, 0] - start, 0.3 * begin[:, 1])))]
        for start in starts_m
    ]


def _points(drive: Drive, along: Along, planned: Planned) -> Floats:
    return along.of(drive.frames.to_world(planned.pathpoint_m))


def _middle(waypoint_m: Floats, x_m: float) -> float:
    """How far the corridor's middle lies to the left there."""
    near = np.argsort(np.hypot(waypoint_m[:, 0] - x_m, 0.5 * waypoint_m[:, 1]))[:2]
    return float(waypoint_m[near, 1].mean())


def _fastest_mph(drive: Drive, along: Along, middle_m: float) -> float:
    track = drive.recorder.trace.track()
    x, y = along.of(track[:, :2]).T
    return float(track[(np.abs(x - middle_m) < 25.0) & (np.abs(y) < 15.0), 2].max()) / MPH_MPS
