"""Membership functions as the figures of the paper show them."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ion.style import DECIDED, GOAL, INK, QUIET, REAL, SAFE, SEEN, plain
from nav.fuzzy.membership import Variable, memberships

COLORS = (SAFE, SEEN, REAL, GOAL, DECIDED)


def draw_terms(
    axes: Axes, variable: Variable, title: str, scale: float = 1.0, most: float | None = None
) -> None:
    """Each fuzzy set over the input, named where it is full.

    Args:
        axes: drawn on.
        variable: the input with its sets.
        title: of the plot.
        scale: from the input's unit to the axis's.
        most: where the axis ends, in the input's unit; by default where the range does.
    """
    low, high = variable.range[0], variable.range[1] if most is None else most
    x = np.unique([*np.linspace(low, high, 800), *(b for b in variable.breakpoints if b < high)])
    plain(axes, title)
    for name, row, color in zip(
        variable.terms, memberships(variable.flanks, x), COLORS, strict=False
    ):
        axes.plot(scale * x, row, "-", color=color, linewidth=2.0)
        full = x[row > 0.999]
        axes.text(
            scale * float(full.mean()), 1.04, name, color=color, fontsize=10.5, ha="center",
            fontweight="bold",
        )  # fmt: skip
    axes.set(xlim=(scale * low, scale * high), ylim=(0.0, 1.18))
    axes.set_ylabel("membership", fontsize=9, color=INK)


def mark(axes: Axes, places: Sequence[float], names: Sequence[str]) -> None:
    """Name places on the axis, such as a, b, c, d."""
    for place, name in zip(places, names, strict=True):
        axes.plot([place, place], [0.0, 1.0], ":", color=QUIET, linewidth=1.0)
        axes.annotate(
            name, (place, 0.0), (4, 8), textcoords="offset points", color=INK, fontsize=10
        )
