"""Fig. 6.9: the fuzzy sets exploring and travelling."""

from matplotlib.figure import Figure

from ion.figures.drives import Drives
from ion.figures.membership import draw_terms
from ion.style import INK, new_figure, plain
from nav.fuzzy.inference import infer
from scenarios.parameter_files import parameters_of

NAME = "6.9"
TITLE = "The membership functions for v/V0"
SHOWS = (
    "The fuzzy sets exploring (EX) and travelling (TR) of the speed over the speed limit, and "
    "the factor on a, b, c, d that follows: the slower, the wider the focus rules let the "
    "vehicle search."
)
DIFFERS = (
    "The paper's caption repeats that of Fig. 6.8; by its text the figure is the membership "
    "function of (6.7), which is what is drawn here. The numbers are ours."
)


def draw(drives: Drives) -> Figure:
    """Sets and what follows."""
    del drives
    figure, base = new_figure(12.0, 3.6), parameters_of().steering.situation
    left, right = figure.subplots(1, 2)
    ratio = base.inputs["speed_ratio"]
    draw_terms(left, ratio, "$S(k) = F_S(v(k), V_0)$")
    plain(right, "Factor on (a, b, c, d) $= F(S(k))$")
    x = [k / 200 * ratio.range[1] for k in range(201)]
    right.plot(x, [float(infer(base, {"speed_ratio": v})[0]) for v in x], "-", color=INK, lw=2.0)
    right.set(ylim=(0.0, 1.18 * base.output.terms["increased"]), xlim=ratio.range)
    for axes in (left, right):
        axes.set_xlabel("$v/V_0$", fontsize=10, color=INK)
    return figure
