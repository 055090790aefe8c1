"""Fig. 6.6: an example scenario, and the scanning distances in it."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ion.explain.distance_panels import draw_distances, from_heading_deg, mark_directions
from ion.explain.explanation import Explanation
from ion.explain.world_panel import draw_world
from ion.figures.drives import Drives
from ion.style import INK, QUIET, REAL, SAFE, head, new_figure

NAME = "6.6"
TITLE = "An example scenario"
SHOWS = (
    "a) A moment of the random field: only the near side of each circle is seen, and expanded to "
    "the real and the safe boundary. b) The scanning distances to both boundaries, with d_max, "
    "the criterion distances d_CR, the distance D1 in the present heading, and both decisions."
)
DIFFERS = (
    "The paper scans along straight rays from a point; we scan along the curves that the vehicle "
    "can follow from its present steering. Scenario and numbers are ours."
)


def draw(drives: Drives) -> Figure:
    """Both parts."""
    why = drives.field.recorder.chosen
    assert why is not None
    figure = new_figure(12.0, 6.6)
    left, right = figure.subplots(1, 2, width_ratios=[0.8, 1.25])
    draw_world(left, why)
    head(left, "a) Local navigation scenario")
    draw_distances(right, why)
    _lines(right, why)
    head(right, "b) Scanning distances to the boundaries")
    right.set_xlabel("direction from the heading, left is left [deg]", fontsize=9, color=INK)
    return figure


def _lines(axes: Axes, why: Explanation) -> None:
    """What the paper's figure names."""
    found, edge = why.considered, min(axes.get_xlim())
    assert found is not None
    decision, middle = found.decision, len(found.theta_rad) // 2
    d_max = why.parameters.planning.scanning.max_distance_m
    D1 = float(found.distances.real_m[middle])
    for height, color, name in (
        (d_max, QUIET, "$d_{max}$"),
        (decision.criterion_real_m, REAL, "$d_{CR,R}$"),
        (decision.criterion_safe_m, SAFE, "$d_{CR,S}$"),
    ):
        axes.axhline(height, color=color, linewidth=0.9, linestyle=(0, (5, 3)))
        axes.text(0.97 * edge, height, name, color=color, fontsize=10, ha="right", va="bottom")
    axes.plot([0.0, 0.0], [0.0, D1], "-", color=INK, linewidth=2.0)
    axes.annotate("$D_1$", (0.0, 0.5 * D1), (5, 0), textcoords="offset points", color=INK)
    marks = [
        (0.0, INK, r"$\theta(k)$"),
        (from_heading_deg(why, decision.theta_RD), REAL, r"$\theta_{RD}$"),
        (from_heading_deg(why, decision.theta_SD), SAFE, r"$\theta_{SD}$"),
    ]
    mark_directions(axes, why, marks)
