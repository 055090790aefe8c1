"""The world around the vehicle at a decision, its heading up (the upper figures of Fig. 6.7)."""

from math import cos, sin

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from ion.explain.explanation import Explanation
from ion.map_layers import draw_corridor
from ion.style import DECIDED, GOAL, INK, PAPER, QUIET, REAL, SAFE, SAND, SEEN, TRACK, head
from nav.messages import Floats
from nav.planning.boundaries import REAL as REAL_LEVEL
from nav.planning.boundaries import SAFE as SAFE_LEVEL
from nav.planning.scanning import Boundaries

AHEAD, BEHIND, ASIDE = 1.0, 0.16, 0.42
"""What is shown, in units of d_max."""
SAMPLES = 240
"""Of the boundaries, along each side."""
RAYS = 6
"""Every sixth direction is drawn."""


def draw_world(axes: Axes, why: Explanation) -> None:
    """Corridor, obstacle cells, boundaries, smooth path, and the local path in force: drawn with
    the vehicle at the origin, x to the right, y ahead."""
    d_max = why.parameters.planning.scanning.max_distance_m
    waypoint_m = to_vehicle(why, why.waypoints.position_m)
    draw_corridor(axes, waypoint_m, why.waypoints.half_width_m, 0.012 * d_max)
    _draw_boundaries(axes, why, d_max)
    _draw_rays(axes, why)
    size = 72.0 * why.parameters.obstacle_map.cell_m / d_max
    cells = to_vehicle(why, why.cells_m)
    axes.plot(*cells.T, "s", color=SEEN, markersize=max(size, 1.6), markeredgewidth=0, zorder=4)
    route = to_vehicle(why, why.situation.route_ahead.position_m)
    axes.plot(*route.T, "--", color=QUIET, linewidth=1.3, zorder=5)
    _draw_vehicle(axes, why)
    _draw_directions(axes, why, d_max)
    _draw_path(axes, why)
    _frame(axes, d_max)
    _legend(axes, why)


def to_vehicle(why: Explanation, point_m: Floats) -> Floats:
    """Points (n, 2) of the route frame N as they are drawn: x to the right, y ahead."""
    x, y, heading = why.situation.pose
    dx, dy = point_m[:, 0] - x, point_m[:, 1] - y
    c, s = cos(heading), sin(heading)
    return np.stack([s * dx - c * dy, c * dx + s * dy], axis=1)


def _draw_boundaries(axes: Axes, why: Explanation, d_max: float) -> None:
    """Edges of the safe boundary, dashed, and of the real one, as far as the map goes."""
    right = np.linspace(-ASIDE * d_max, ASIDE * d_max, SAMPLES)
    up = np.linspace(-BEHIND * d_max, AHEAD * d_max, SAMPLES)
    r, u = np.meshgrid(right, up)
    x, y, heading = why.situation.pose
    c, s = cos(heading), sin(heading)
    e, n, known = x + c * u + s * r, y + s * u - c * r, why.situation.boundaries
    level = np.where(_on_map(known, e, n), known.at(e, n).astype(np.float64), np.nan)
    for floor, color, style in ((SAFE_LEVEL, SAFE, "dashed"), (REAL_LEVEL, REAL, "solid")):
        axes.contour(
            r, u, level, levels=[floor - 0.5], colors=color, linewidths=1.1, linestyles=style,
            zorder=3,
        )  # fmt: skip


def _on_map(known: Boundaries, x_m: Floats, y_m: Floats) -> NDArray[np.bool_]:
    """Where the map ends nothing is known: no edge is drawn there."""
    size = len(known.level) * known.cell_m
    east, north = x_m - known.origin_m[0], y_m - known.origin_m[1]
    return (east > 0.0) & (east < size) & (north > 0.0) & (north < size)


def _draw_rays(axes: Axes, why: Explanation) -> None:
    """The curves along which directions are scanned, as far as they are free."""
    if why.considered is None:
        return
    fan, free_m = why.considered.curves, why.considered.distances.real_m
    for row in range(0, len(fan.theta_rad), RAYS):
        along = fan.arc_m <= free_m[row] + 1e-9
        ahead, left = fan.position_m[:, row, along]
        axes.plot(-left, ahead, "-", color=REAL, linewidth=0.5, alpha=0.45, zorder=2.5)


def _draw_vehicle(axes: Axes, why: Explanation) -> None:
    box = why.parameters.vehicle.outline
    ahead = [box.rear_m, box.front_m, box.front_m, box.rear_m]
    aside = [box.half_width_m, box.half_width_m, -box.half_width_m, -box.half_width_m]
    axes.fill(aside, ahead, facecolor=PAPER, edgecolor=INK, linewidth=1.5, zorder=7)


def _draw_directions(axes: Axes, why: Explanation, d_max: float) -> None:
    """Where the goal is, and where the two decisions point."""
    heading, reach = why.situation.ego.heading_rad, 0.97 * d_max
    goal = why.considered.goal_rad if why.considered else why.situation.goal_rad
    marks = [(goal, GOAL, r"$\phi$", reach)]
    if why.considered:
        decision = why.considered.decision
        marks += [(decision.theta_SD, SAFE, r"$\theta_{SD}$", 0.82 * d_max)]
        marks += [(decision.theta_RD, REAL, r"$\theta_{RD}$", 0.9 * d_max)]
    for theta, color, name, far in marks:
        aside = max(abs(sin(theta - heading)), 1e-3)
        length = min(far, 0.93 * ASIDE * d_max / aside)
        x, y = -length * sin(theta - heading), length * cos(theta - heading)
        axes.plot([0.0, x], [0.0, y], ":", color=color, linewidth=1.1, zorder=5)
        axes.text(
            x, y, name, color=color, fontsize=10, ha="center", va="center", zorder=9,
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.6, "alpha": 0.85},
        )  # fmt: skip


def _draw_path(axes: Axes, why: Explanation) -> None:
    if why.path is None or why.pathpoint_m is None:
        return
    color = DECIDED if why.in_force else TRACK
    axes.plot(*to_vehicle(why, why.path.position_m).T, "-", color=color, linewidth=1.6, zorder=8)
    axes.plot(
        *to_vehicle(why, why.pathpoint_m).T, "o", markerfacecolor=color, markeredgecolor=PAPER,
        markersize=5.5, markeredgewidth=0.8, zorder=8,
    )  # fmt: skip


def _frame(axes: Axes, d_max: float) -> None:
    axes.set(xlim=(-ASIDE * d_max, ASIDE * d_max), ylim=(-BEHIND * d_max, AHEAD * d_max))
    axes.set(aspect="equal", xticks=[], yticks=[], anchor="N")
    axes.set_facecolor(PAPER)
    axes.spines[:].set_visible(False)
    length = 5.0 if d_max > 10.0 else 1.0
    x, y = -0.96 * ASIDE * d_max, -0.8 * BEHIND * d_max
    axes.plot([x, x + length], [y, y], "-", color=INK, linewidth=1.6, zorder=9)
    axes.text(x + length + 0.02 * d_max, y, f"{length:g} m", color=INK, fontsize=8.5, va="center")
    head(axes, "The world as the navigator knows it, heading up")


def _legend(axes: Axes, why: Explanation) -> None:
    color = DECIDED if why.in_force else TRACK
    marks = [
        Patch(color=SAND, label="corridor"),
        _line("obstacle cells", SEEN, marker="s", linestyle="none", markersize=4),
        _line("real boundary", REAL),
        _line("safe boundary", SAFE, linestyle="dashed"),
        _line("smooth path of the route", QUIET, linestyle="dashed"),
        _line("local path, ten pathpoints", color, marker="o", markersize=4),
    ]
    axes.legend(
        handles=marks, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=2, frameon=False,
        fontsize=8.5, labelcolor=INK,
    )  # fmt: skip


def _line(label: str, color: str, **look: object) -> Line2D:
    return Line2D([], [], color=color, label=label, **look)  # pyright: ignore[reportArgumentType]
