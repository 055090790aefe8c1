"""A search as a picture: how near to failing each drive was, and where in the space that lies."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ion.falsify.search import Episode
from ion.style import DPI, INK, MISSED, QUIET, SPEED_MAP, TRACK, new_figure, plain
from scenarios.distribution import Distribution


def draw(
    episodes: Sequence[Episode], varied: dict[str, Distribution], title: str, path: Path
) -> None:
    """Write the picture as PNG.

    Raises:
        OSError: the file cannot be written.
    """
    figure = new_figure(11.0, 4.6)
    names = telling(episodes, list(varied))
    left, *right = figure.subplots(1, 2 if names else 1, squeeze=False)[0]
    _over_episodes(left, episodes)
    for axes in right:
        _where(figure, axes, episodes, names, varied)
    figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=11.0)
    figure.savefig(path, dpi=DPI, format="png")


def telling(episodes: Sequence[Episode], names: Sequence[str]) -> list[str]:
    """The names on whose values the cost depends most, two at most, by rank correlation."""
    costs = _ranks([e.cost for e in episodes])
    tells = {n: abs(_correlation(_ranks(_column(episodes, n)), costs)) for n in names}
    return sorted(names, key=lambda name: -tells[name])[:2]


def _over_episodes(axes: Any, episodes: Sequence[Episode]) -> None:
    plain(axes, "How near to failing, drive by drive")
    number, cost = np.arange(1, len(episodes) + 1), [e.cost for e in episodes]
    failed = np.array([bool(e.failed) for e in episodes])
    axes.axhline(0.0, color=MISSED, linewidth=0.9)
    axes.step(number, np.minimum.accumulate(cost), color=QUIET, linewidth=1.0, where="post")
    axes.scatter(number, cost, s=16.0, c=np.where(failed, MISSED, TRACK), zorder=3)
    axes.set_xlabel("drive", color=INK)
    axes.set_ylabel("cost (below 0 a verdict fails)", color=INK)


def _where(
    figure: Any, axes: Any, episodes: Sequence[Episode], names: Sequence[str],
    varied: dict[str, Distribution],
) -> None:  # fmt: skip
    plain(axes, "Where it was looked, and where a verdict fails (red)")
    cost = np.array([e.cost for e in episodes])
    places = [np.array(_column(episodes, name)) for name in names]
    x, y = places if len(places) > 1 else (places[0], cost)
    passes = np.array([not e.failed for e in episodes])
    dots = axes.scatter(x[passes], y[passes], s=26.0, c=cost[passes], cmap=SPEED_MAP)
    axes.scatter(x[~passes], y[~passes], s=34.0, c=MISSED, marker="X", zorder=3)
    figure.colorbar(dots, ax=axes).set_label("cost of those that pass", color=INK)
    axes.set_xlabel(names[0], color=INK)
    axes.set_ylabel(names[1] if len(names) > 1 else "cost", color=INK)
    axes.set_xscale(_scale(varied[names[0]]))
    axes.set_yscale(_scale(varied[names[1]]) if len(names) > 1 else "linear")


def _scale(varied: Distribution) -> str:
    return "log" if varied.log_uniform else "linear"


def _column(episodes: Sequence[Episode], name: str) -> list[Any]:
    return [episode.point.values[name] for episode in episodes]


def _ranks(values: Sequence[Any]) -> Any:
    """Of words, in the order of the alphabet."""
    order = np.unique(np.array(values), return_inverse=True)[1]
    return order.astype(float)


def _correlation(a: Any, b: Any) -> float:
    if a.std() == 0.0 or b.std() == 0.0:
        return 0.0
    return float(np.corrcoef(a, b)[0, 1])
