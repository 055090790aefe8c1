"""Fig. 6.8: the fuzzy sets of Delta1 and Delta2."""

from math import degrees

from matplotlib.figure import Figure

from ion.figures.drives import Drives
from ion.figures.membership import draw_terms, mark
from ion.style import INK, new_figure
from scenarios.parameter_files import parameters_of

NAME = "6.8"
TITLE = "The membership functions for Δ1 and Δ2"
SHOWS = (
    "The fuzzy sets Small, Medium and Large of the angles from the heading, Delta1, and from the "
    "goal direction, Delta2, with a, b, c, d as they are at speed (travelling)."
)
DIFFERS = (
    "The paper's numbers did not survive; ours are tuned in the twin "
    "(nav/parameters/steering.toml). The paper uses triangles; our Medium is flat between b and "
    "c. When exploring, all four grow by the factor of (6.7)."
)
MOST_RAD = 2.0


def draw(drives: Drives) -> Figure:
    """One plot an input."""
    del drives
    figure = new_figure(12.0, 3.6)
    inputs = parameters_of().steering.focus.inputs
    names = {"delta_1_rad": r"$|\theta - \theta(k)|$", "delta_2_rad": r"$|\theta - \phi(k)|$"}
    for axes, (name, text) in zip(figure.subplots(1, 2), names.items(), strict=True):
        draw_terms(axes, inputs[name], f"Δ{name[6]} = {text}", degrees(1.0), MOST_RAD)
        points = [degrees(point) for point in inputs[name].breakpoints]
        mark(axes, points, [*"abcdefgh"][: len(points)])
        axes.set_xlabel("[deg]", fontsize=9, color=INK)
    return figure
