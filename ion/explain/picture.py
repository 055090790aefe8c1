"""The picture of a decision, after Fig. 6.7, and beside it how strongly the rules fired."""

from matplotlib.figure import Figure

from ion.explain.distance_panels import (
    draw_adjusted,
    draw_deduction,
    draw_distances,
    nothing_to_show,
)
from ion.explain.explanation import Explanation
from ion.explain.rule_panels import draw_speed_rules, draw_table
from ion.explain.world_panel import draw_world
from ion.style import INK, new_figure

SIZE_IN = (15.0, 9.2)
NONE = "In {} the steering fuzzy controller is not asked:\nthere are no curves to show."


def draw(why: Explanation, title: str) -> Figure:
    """The whole picture."""
    figure = new_figure(*SIZE_IN)
    grid = figure.add_gridspec(6, 3, width_ratios=[1.12, 1.25, 0.82])
    draw_world(figure.add_subplot(grid[:, 0]), why)
    if why.considered:
        for k, draw_panel in enumerate((draw_distances, draw_deduction, draw_adjusted)):
            draw_panel(figure.add_subplot(grid[2 * k : 2 * k + 2, 1]), why)
        draw_table(figure.add_subplot(grid[:3, 2]), why)
    else:
        words = NONE.format(why.state.replace("_", " "))
        nothing_to_show(figure.add_subplot(grid[:, 1]), words)
    draw_speed_rules(figure.add_subplot(grid[3:, 2]), why)
    figure.suptitle(title, x=0.012, ha="left", color=INK, fontsize=11.5)
    return figure
