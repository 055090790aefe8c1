"""One check as a picture."""

from matplotlib.figure import Figure

from ion.style import GRID, QUIET, REAL, SAFE, SEEN, new_figure
from scenarios.truth import Check

COLORS = (REAL, SEEN, SAFE, QUIET)


def plot(check: Check) -> Figure:
    """The curve of a check.

    Raises:
        ValueError: it has none.
    """
    curve = check.curve
    if curve is None:
        raise ValueError(f"{check.title}: has no curve")
    figure = new_figure(6.0, 3.4)
    axes = figure.add_subplot()
    for (name, values), color in zip(curve.lines.items(), COLORS, strict=False):
        axes.plot(curve.x, values, "o-" if curve.points else "-", label=name, color=color)
    if curve.log:
        axes.loglog()
    axes.set_xlabel(curve.x_label)
    axes.set_ylabel(curve.y_label)
    axes.grid(color=GRID)
    if len(curve.lines) > 1:
        axes.legend(frameon=False)
    return figure
