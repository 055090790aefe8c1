"""Scanning distances over all directions, the deduction, and what is left (Fig. 6.7)."""

import numpy as np
from matplotlib.axes import Axes

from ion.explain.explanation import Explanation
from ion.style import DECIDED, GOAL, INK, QUIET, REAL, SAFE, plain
from nav.angles import wrapped
from nav.messages import Floats
from nav.states.obstacle_avoidance import Considered

SHORT_DEG, LONG_DEG = 9.5, 18.0
"""How broad the names of directions are; a long one has a (k)."""
Mark = tuple[float, str, str]
"""A direction from the heading [deg], a colour, a name."""


def draw_distances(axes: Axes, why: Explanation) -> None:
    """D_R and D_S over theta."""
    found = _found(why)
    plain(axes, r"Scanning distances  $D_R(\theta)$,  $D_S(\theta)$")
    degrees = np.degrees(why.relative_rad)
    axes.fill_between(degrees, found.distances.real_m, color=REAL, alpha=0.08, linewidth=0)
    axes.plot(degrees, found.distances.real_m, "-", color=REAL, linewidth=1.6, label="real, $D_R$")
    axes.plot(degrees, found.distances.safe_m, "-", color=SAFE, linewidth=1.6, label="safe, $D_S$")
    axes.axvline(0.0, color=INK, linewidth=0.9, linestyle="dotted")
    _axis(axes, why, bottom=0.0)
    axes.legend(loc="lower left", frameon=False, fontsize=8.5, labelcolor=INK, ncols=2)


def draw_deduction(axes: Axes, why: Explanation) -> None:
    """d_max - Delta(theta), the priority window, with where it is widest open."""
    found, d_max = _found(why), why.parameters.planning.scanning.max_distance_m
    plain(axes, r"Priority window  $d_{max} - \Delta(\theta)$")
    window = d_max - found.decision.deduction_m
    degrees = np.degrees(why.relative_rad)
    axes.fill_between(degrees, window, color=GOAL, alpha=0.08, linewidth=0)
    axes.plot(degrees, window, "-", color=INK, linewidth=1.6)
    marks = [(0.0, INK, r"$\theta(k)$"), (from_heading_deg(why, found.goal_rad), GOAL, r"$\phi$")]
    if why.previous_rad is not None:
        marks += [(from_heading_deg(why, why.previous_rad), DECIDED, r"$\theta_D(k{-}1)$")]
    _axis(axes, why, bottom=min(0.0, float(window.min())))
    mark_directions(axes, why, marks)


def draw_adjusted(axes: Axes, why: Explanation) -> None:
    """D - Delta with both criteria; candidate sets shaded, decisions and goal marked."""
    found = _found(why)
    plain(axes, r"Adjusted  $D(\theta) - \Delta(\theta)$  and the candidate sets  $I$, $J$")
    decision, degrees = found.decision, np.degrees(why.relative_rad)
    d_max = why.parameters.planning.scanning.max_distance_m
    rows = (
        (found.distances.real_m, decision.candidates_real, decision.criterion_real_m, REAL, "$I$"),
        (found.distances.safe_m, decision.candidates_safe, decision.criterion_safe_m, SAFE, "$J$"),
    )
    low = min(float((row[0] - decision.deduction_m).min()) for row in rows)
    bottom = min(low, 0.0) - 0.27 * d_max
    _axis(axes, why, bottom)
    for k, (distance, among, criterion, color, name) in enumerate(rows):
        adjusted = distance - decision.deduction_m
        axes.plot(degrees, adjusted, "-", color=color, linewidth=1.6)
        axes.axhline(criterion, color=color, linewidth=0.8, linestyle=(0, (5, 3)))
        axes.fill_between(
            degrees, criterion, adjusted, where=list(among), color=color, alpha=0.28, linewidth=0
        )
        _strip(axes, degrees, among, bottom + (0.16 - 0.09 * k) * d_max, color, name)
    marks = [
        (from_heading_deg(why, found.goal_rad), GOAL, r"$\phi$"),
        (from_heading_deg(why, decision.theta_RD), REAL, r"$\theta_{RD}$"),
        (from_heading_deg(why, decision.theta_SD), SAFE, r"$\theta_{SD}$"),
        (from_heading_deg(why, decision.theta_D), DECIDED, r"$\theta_D$"),
    ]
    mark_directions(axes, why, marks)
    axes.set_xlabel("direction from the heading, left is left [deg]", fontsize=9, color=INK)


def mark_directions(axes: Axes, why: Explanation, marks: list[Mark]) -> None:
    """A dotted line up to d_max at each direction, with its name; the last one is strongest."""
    top, bottom = why.parameters.planning.scanning.max_distance_m, axes.get_ylim()[0]
    for k, (place, color, _) in enumerate(marks):
        thick = 1.8 if k + 1 == len(marks) else 1.0
        axes.plot(
            [place, place], [bottom, 1.02 * top], color=color, linewidth=thick, linestyle="dotted"
        )
    _name(axes, why, marks)


def _strip(
    axes: Axes, degrees: Floats, among: Floats | object, height: float, color: str, name: str
) -> None:
    """A candidate set as a bar below the curves."""
    inside = np.asarray(among, dtype=bool)
    places = np.where(inside, degrees, np.nan)
    axes.plot(
        places, np.full(len(places), height), "-", color=color, linewidth=4.0,
        solid_capstyle="butt", marker="s", markersize=2.2, zorder=4,
    )  # fmt: skip
    axes.text(degrees[0] * 0.98, height, name, color=color, fontsize=9, va="center", ha="right")


def _found(why: Explanation) -> Considered:
    assert why.considered is not None
    return why.considered


def from_heading_deg(why: Explanation, theta_rad: float) -> float:
    """A direction as seen from the heading, left positive, [deg]."""
    return float(np.degrees(wrapped(theta_rad - why.situation.ego.heading_rad)))


def _axis(axes: Axes, why: Explanation, bottom: float) -> None:
    """Left directions at the left."""
    edge = float(np.degrees(why.relative_rad.max()))
    d_max = why.parameters.planning.scanning.max_distance_m
    axes.set(xlim=(edge, -edge), ylim=(bottom, 1.24 * d_max))
    axes.set_ylabel("[m]", fontsize=9, color=INK)


def _name(axes: Axes, why: Explanation, marks: list[Mark]) -> None:
    """Names above the curves, beside each other, each with a line to its direction."""
    d_max = why.parameters.planning.scanning.max_distance_m
    marks = sorted(marks, key=lambda mark: mark[0])
    for (place, color, name), x in zip(marks, _apart(marks), strict=True):
        axes.plot([place, x], [1.02 * d_max, 1.1 * d_max], "-", color=color, linewidth=0.8)
        axes.text(x, 1.11 * d_max, name, color=color, fontsize=10.5, ha="center", va="bottom")


def _apart(marks: list[Mark]) -> list[float]:
    """Where names go: ascending places, moved until each has its room beside its neighbours."""
    moved = [place for place, _, _ in marks]
    room = [LONG_DEG if "k" in name else SHORT_DEG for _, _, name in marks]
    for _ in range(60):
        for k in range(len(moved) - 1):
            need = 0.5 * (room[k] + room[k + 1])
            lack = max(need - (moved[k + 1] - moved[k]), 0.0)
            moved[k], moved[k + 1] = moved[k] - 0.5 * lack, moved[k + 1] + 0.5 * lack
    return moved


def nothing_to_show(axes: Axes, words: str) -> None:
    """In place of a curve that does not exist."""
    axes.axis("off")
    axes.text(0.5, 0.5, words, color=QUIET, fontsize=11, ha="center", va="center", wrap=True)
