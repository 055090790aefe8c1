"""The layers of a map, from the ground up."""

from collections.abc import Sequence
from math import ceil
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from numpy.typing import NDArray

from ion.style import AHEAD, EDGE, HARD, MISSED, PASSED, SAND, SEEN, SPEED_MAP, TUNNEL
from nav.route.rddf import MPH_MPS
from scenarios.course import Course
from scenarios.verdicts.shapes import Outline, footprints
from twin.world import SOFT, Obstacle

Floats = NDArray[np.float64]

EDGE_LENGTHS = 0.1
"""Width of the corridor's edge, in lengths of the vehicle."""


class Scene(NamedTuple):
    """All that a map shows, world frame."""

    course: Course
    outline: Outline
    """Of the vehicle: what is drawn to its scale is drawn in lengths of it."""
    track: Floats
    """Shape (n, 3): x, y [m] and speed [m/s]."""
    cells_m: Floats
    """Shape (m, 2): obstacle cells that the navigator saw."""
    passed: frozenset[int]
    """Gates."""
    missed: frozenset[int]

    @property
    def length_m(self) -> float:
        """Of the vehicle."""
        return self.outline.front_m - self.outline.rear_m + 2.0 * self.outline.radius_m

    def gate_color(self, gate: int) -> str:
        """Of a gate that was passed, missed, or lies ahead."""
        return PASSED if gate in self.passed else MISSED if gate in self.missed else AHEAD


def draw_scene(axes: Axes, scene: Scene, detail: bool) -> LineCollection:
    """Draw all layers; a detail with stronger lines. Returns the trajectory, for a colour bar."""
    course = scene.course
    draw_corridor(axes, course.waypoint_m, course.half_width_m, EDGE_LENGTHS * scene.length_m)
    draw_obstacles(axes, course.world.everything())
    size = 1.6 if detail else 0.7
    axes.plot(*scene.cells_m.T, "s", color=SEEN, markersize=size, markeredgewidth=0, zorder=4)
    for k, gate in enumerate(scene.course.gates):
        ends = np.stack([gate.left_m, gate.right_m])
        color = scene.gate_color(k)
        axes.plot(*ends.T, "-", color=color, linewidth=2.2, solid_capstyle="round", zorder=5)
    return _draw_track(axes, scene.track, 3.0 if detail else 1.7, _top_mph(scene.track))


def _top_mph(track: Floats) -> float:
    """The end of the colours, in fives: drives of one course have the same, nearly always."""
    return 5.0 * max(ceil(track[:, 2].max(initial=0.0) / MPH_MPS / 5.0), 1)


def draw_corridor(axes: Axes, P: Floats, width: Floats, edge_m: float) -> None:
    """Rectangles and discs in one colour, over the same a little larger for the edge.

    Args:
        axes: drawn on.
        P: waypoints, shape (n, 2).
        width: half-widths from each to the next, shape (n,).
        edge_m: how broad the edge is drawn.
    """
    for color, extra, z in ((EDGE, edge_m, 0.0), (SAND, 0.0, 1.0)):
        shapes = [_capsule(P[k], P[k + 1], width[k] + extra) for k in range(len(P) - 1)]
        axes.add_collection(_polygons(shapes, color, z))


def _capsule(start: Floats, end: Floats, radius_m: float) -> Floats:
    """Outline of all points within a distance of a segment, shape (k, 2)."""
    along = end - start
    front = np.arctan2(along[1], along[0]) + np.linspace(-0.5 * np.pi, 0.5 * np.pi, 13)
    arc = radius_m * np.stack([np.cos(front), np.sin(front)], axis=1)
    return np.vstack([end + arc, start - arc])


def draw_obstacles(axes: Axes, obstacles: Sequence[Obstacle]) -> None:
    """What may be touched or passed under is lighter."""
    colors = {"tunnel": (TUNNEL, 2.0), **dict.fromkeys(sorted(SOFT), (EDGE, 2.0))}
    groups: dict[tuple[str, float], list[Floats]] = {}
    for obstacle in obstacles:
        groups.setdefault(colors.get(obstacle.kind, (HARD, 3.0)), []).append(shadow(obstacle))
    for (color, z), shapes in groups.items():
        axes.add_collection(_polygons(shapes, color, z))


def shadow(obstacle: Obstacle) -> Floats:
    """Its outline in plan view, shape (k, 2), world frame."""
    if obstacle.shape == "cylinder":
        turn = np.linspace(0.0, 2.0 * np.pi, 17)
        circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
        return np.array(obstacle.center_m[:2]) + obstacle.half_size_m[0] * circle
    return footprints([obstacle]).corner_m[0]


def _polygons(shapes: list[Floats], color: str, z: float) -> PolyCollection:
    return PolyCollection(shapes, facecolors=color, linewidths=0.0, zorder=z)


def _draw_track(axes: Axes, track: Floats, width: float, top_mph: float) -> LineCollection:
    pieces = np.stack([track[:-1, :2], track[1:, :2]], axis=1)
    lines = LineCollection(list(pieces), cmap=SPEED_MAP, linewidths=width, zorder=6)
    speed_mph = np.abs(track[1:, 2]) / MPH_MPS
    lines.set_array(speed_mph)
    lines.set_clim(0.0, max(top_mph, float(speed_mph.max(initial=0.0))))
    lines.set_capstyle("round")
    axes.add_collection(lines)
    return lines
