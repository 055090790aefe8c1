"""The map of a run: course, gates, corridor, what was seen, the trajectory by speed; and below it
the places where it was tight."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ion.map_layers import Scene, draw_scene
from ion.style import AHEAD, DPI, INK, MISSED, PAPER, PASSED, SEEN, TRACK, new_figure
from ion.trace import Trace
from nav.route.rddf import FOOT_M, MILE_M
from scenarios.course import Course
from scenarios.verdicts import Judge
from scenarios.verdicts.shapes import Pose
from scenarios.verdicts.tracking import frames

Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]
"""Left, right, bottom, top, [m]."""

WIDTH_IN, DETAIL_IN = 12.0, 2.9
DETAILS = 3
MARGIN_LENGTHS = 4.6
"""Around course and trajectory, in lengths of the vehicle ..."""
MARGIN_SHARE = 0.015
"""... but at least this share of a long one, or its ends' marks would be cut off."""
DETAIL_LENGTHS = (6.9, 3.6)
"""Half width and half height of a detail."""
NUMBER_LENGTHS = 2.3
"""From a gate to its number."""
FAMILIES = {"other": "nearest obstacle", "gate": "tightest gate", "tunnel": "tunnel wall"}


def draw_map(course: Course, trace: Trace, judge: Judge, title: str, path: Path) -> None:
    """Write the map of a run as PNG.

    Args:
        course: what was driven.
        trace: of the run.
        judge: of the run.
        title: one line, above the map.
        path: of the picture.

    Raises:
        OSError: the file cannot be written.
    """
    missed = frozenset(judge.gates.missed(all_behind=judge.progress.finished))
    cells_m = frames(course).to_world(trace.cells_m())
    passed = frozenset(judge.gates.passed)
    scene = Scene(course, judge.outline, trace.track(), cells_m, passed, missed)
    details = _details(judge)
    if not details:
        whole_map(scene, title).savefig(path, dpi=DPI)
        return
    whole = _whole(scene)
    map_in = _height_in(whole)
    figure = new_figure(WIDTH_IN, map_in + DETAIL_IN)
    grid = figure.add_gridspec(2, DETAILS, height_ratios=[map_in, DETAIL_IN])
    _draw_whole(figure.add_subplot(grid[0, :]), scene, whole, title)
    for k, (name, pose) in enumerate(details):
        _draw_detail(figure.add_subplot(grid[1, k]), scene, name, pose)
    figure.savefig(path, dpi=DPI)


def whole_map(scene: Scene, title: str) -> Figure:
    """The map alone, without the places where it was tight."""
    box = _whole(scene)
    figure = new_figure(WIDTH_IN, _height_in(box))
    _draw_whole(figure.add_subplot(), scene, box, title)
    return figure


def _whole(scene: Scene) -> Box:
    points = np.vstack([scene.course.waypoint_m, scene.track[:, :2]])
    around = min(float(scene.course.half_width_m.max()), 30.0) + MARGIN_LENGTHS * scene.length_m
    margin = max(around, MARGIN_SHARE * float(np.ptp(points, axis=0).max()))
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return float(low[0]), float(high[0]), float(low[1]), float(high[1])


def _height_in(box: Box) -> float:
    left, right, bottom, top = box
    return float(np.clip(0.93 * WIDTH_IN * (top - bottom) / (right - left) + 0.8, 3.5, 14.0))


def _details(judge: Judge) -> list[tuple[str, Pose]]:
    """Where the drive ended too early, and where each kind of thing was nearest; three at most."""
    least = judge.clearance
    tight = [
        (f"{text}: {least.least_m[family]:.2f} m", least.least_at[family])
        for family, text in FAMILIES.items()
        if family in least.least_at
    ]
    if judge.outcome != "finished" and judge.pose:
        tight.insert(0, (f"the end: {judge.outcome}", judge.pose))
    return tight[:DETAILS]


def _draw_whole(axes: Axes, scene: Scene, box: Box, title: str) -> None:
    speed = draw_scene(axes, scene, detail=False)
    _number_gates(axes, scene)
    _mark_ends(axes, scene)
    _frame(axes, box)
    axes.set_title(title, loc="left", color=INK, fontsize=13, fontweight="bold")
    bar = axes.figure.colorbar(speed, ax=axes, shrink=0.55, aspect=35, pad=0.01)
    bar.ax.set_title("mph", color=INK, fontsize=9)
    bar.ax.spines[:].set_visible(False)
    _scale_bar(axes, box)


def _draw_detail(axes: Axes, scene: Scene, name: str, pose: Pose) -> None:
    draw_scene(axes, scene, detail=True)
    border = np.array(scene.outline.border_m(pose))
    axes.fill(*border.T, facecolor="none", edgecolor=INK, linewidth=1.4, zorder=9)
    x, y, _ = pose
    across, up = (scene.length_m * lengths for lengths in DETAIL_LENGTHS)
    box = (x - across, x + across, y - up, y + up)
    _frame(axes, box)
    axes.spines[:].set(visible=True, color="#d9d6cf")
    axes.set_title(name, loc="left", color=INK, fontsize=10)
    _scale_bar(axes, box)


def _number_gates(axes: Axes, scene: Scene) -> None:
    for k, gate in enumerate(scene.course.gates):
        across = gate.left_m - gate.right_m
        away = NUMBER_LENGTHS * scene.length_m / np.hypot(*across)
        x, y = (gate.left_m + away * across).tolist()
        axes.text(
            x,
            y,
            str(k + 1),
            color=scene.gate_color(k),
            fontsize=6.5,
            ha="center",
            va="center",
            zorder=8,
        )


def _mark_ends(axes: Axes, scene: Scene) -> None:
    marks = [(scene.course.world.start[:2], "o", "start")]
    marks += [(tuple(scene.course.waypoint_m[-1].tolist()), "s", "finish")]
    marks += [(tuple(track[:2].tolist()), "X", "end of the run") for track in scene.track[-1:]]
    for (x, y), marker, label in marks:
        axes.plot(
            x, y, marker, markersize=8, markerfacecolor="white", markeredgecolor=INK,
            markeredgewidth=1.3, zorder=9, label=label, linestyle="none",
        )  # fmt: skip
    axes.plot([], [], "s", color=SEEN, markersize=4, label="obstacle seen", linestyle="none")
    colors = {"gate passed": PASSED, "missed": MISSED, "ahead": AHEAD}
    shown = {scene.gate_color(k) for k in range(len(scene.course.gates))}
    lines = {name: color for name, color in colors.items() if color in shown}
    for name, color in (lines | {"trajectory": TRACK}).items():
        axes.plot([], [], "-", color=color, linewidth=2.2, label=name)
    axes.legend(
        loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=8, frameon=False, fontsize=8.5,
        labelcolor=INK,
    )  # fmt: skip


def _frame(axes: Axes, box: Box) -> None:
    left, right, bottom, top = box
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", xticks=[], yticks=[])
    axes.set_facecolor(PAPER)
    axes.spines[:].set_visible(False)


def _scale_bar(axes: Axes, box: Box) -> None:
    """A bar of a round length, about an eighth of the width, in the lower left; north is up."""
    left, right, bottom, _ = box
    width = right - left
    power = 10.0 ** np.floor(np.log10(width / 8.0))
    length = float(power * max(f for f in (1.0, 2.0, 5.0) if f * power <= width / 8.0))
    x, y, tick = left + 0.015 * width, bottom + 0.012 * width, 0.004 * width
    bar = np.array([[x, y + tick], [x, y], [x + length, y], [x + length, y + tick]])
    axes.plot(*bar.T, "-", color=INK, linewidth=1.4, zorder=10)
    text = f"{_told(length)}, north is up"
    axes.text(x + length + 2 * tick, y, text, color=INK, fontsize=8, va="bottom", zorder=10)


def _told(length_m: float) -> str:
    if length_m < 1000.0:
        return f"{length_m:g} m = {length_m / FOOT_M:.3g} ft"
    return f"{length_m / 1000.0:g} km = {length_m / MILE_M:.2g} miles"
