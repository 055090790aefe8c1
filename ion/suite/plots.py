"""Each figure that has a bound, over the seeds of a run: where the drives lie, and the bound."""

from collections.abc import Sequence

from matplotlib.axes import Axes

from ion.style import DECIDED, HARD, INK, PASSED, new_figure, plain, png
from ion.telling import Result
from scenarios.bounds import Bound, Expected

ACROSS, WIDTH_IN, HEIGHT_IN = 4, 2.7, 1.5
"""Plots beside each other, and the size of each."""


def strips(results: Sequence[Result], expected: dict[str, Expected]) -> bytes | None:
    """A picture of one run; None where no bound is a number."""
    bounds = {name: b for name, b in expected.items() if isinstance(b, Bound) and not b.has}
    if not bounds:
        return None
    rows = -(-len(bounds) // ACROSS)
    figure = new_figure(ACROSS * WIDTH_IN, rows * HEIGHT_IN)
    axes = figure.subplots(rows, ACROSS, squeeze=False).ravel().tolist()
    for ax, (name, bound) in zip(axes, bounds.items(), strict=False):
        _strip(ax, name, bound, results)
    for ax in axes[len(bounds) :]:
        ax.set_axis_off()
    return png(figure)


def _strip(ax: Axes, name: str, bound: Bound, results: Sequence[Result]) -> None:
    plain(ax, name)
    for result in results:
        for verdict in result.get("verdicts", ()):
            if verdict["figure"] == name and verdict["value"] is not None:
                color = PASSED if verdict["passed"] else DECIDED
                ax.plot(verdict["value"], result["seed"], "o", color=color, markersize=4)
    for limit in (bound.least, bound.most):
        if limit is not None:
            ax.axvline(limit, color=HARD, linewidth=1.0, linestyle="--")
    ax.set_yticks([])
    ax.tick_params(labelsize=8, labelcolor=INK)
