"""Fig. 6.11: the fuzzy sets of D1 and D."""

from matplotlib.figure import Figure

from ion.figures.drives import Drives
from ion.figures.membership import draw_terms, mark
from ion.style import INK, new_figure
from scenarios.parameter_files import parameters_of

NAME = "6.11"
TITLE = "The membership functions for D1 and D"
SHOWS = (
    "The fuzzy sets Dangerous, Small, Medium and Large of both distances of the anti-collision "
    "rules; D_safe lies totally within Dangerous."
)
DIFFERS = (
    "The numbers are ours (nav/parameters/speed.toml), so that from any set point the vehicle "
    "stops D_safe before the nearer of D1 and D. D1 is measured along the local path in force, "
    "not straight ahead."
)


def draw(drives: Drives) -> Figure:
    """One plot an input."""
    del drives
    figure, speed = new_figure(12.0, 3.6), parameters_of().speed
    for axes, name in zip(figure.subplots(1, 2), ("D1_m", "D_m"), strict=True):
        draw_terms(axes, speed.anti_collision.inputs[name], name.removesuffix("_m"))
        mark(axes, [speed.safe_distance_m], ["$D_{safe}$"])
        axes.set_xlabel("[m]", fontsize=9, color=INK)
    return figure
