"""The search: points, their drives, and what these tell of where to look next."""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ion.falsify.samplers import Floats, Sampler
from ion.falsify.space import Point, Space
from ion.suite.results import failed
from ion.telling import Result

Drive = Callable[[Sequence[Point]], list[Result]]
"""Drives points; the results in their order, each with its `cost`."""


class Episode(NamedTuple):
    """One drive of a search."""

    point: Point
    result: Result

    @property
    def cost(self) -> float:
        """See `ion.falsify.cost`."""
        return self.result["cost"]

    @property
    def failed(self) -> list[str]:
        """The figures whose verdicts failed."""
        return failed(self.result)


def search(
    space: Space, sampler: Sampler, drive: Drive, budget: int, search_seed: int, at_once: int = 1
) -> Iterator[Episode]:
    """Drive `budget` points, one after the other or a few at once; give each as it is known.

    The same arguments give the same points, whatever each drive takes: those that are driven at
    once are all known before the next are asked for. Seeds take turns in an order of their own.
    """
    seeds = np.random.default_rng(search_seed).permutation(space.seeds).tolist()
    places, costs = np.zeros((0, len(space.varied))), np.zeros(0)
    while len(costs) < budget:
        count = min(at_once, budget - len(costs))
        asked = _asked(sampler, places, costs, count)
        turn = [seeds[(len(costs) + k) % len(seeds)] for k in range(count)]
        points = [space.point(place.tolist(), s) for place, s in zip(asked, turn, strict=True)]
        found = [Episode(p, r) for p, r in zip(points, drive(points), strict=True)]
        places = np.vstack([places, asked])
        costs = np.append(costs, [episode.cost for episode in found])
        yield from found


def _asked(sampler: Sampler, places: Floats, costs: Floats, count: int) -> Floats:
    """As many places, shape (count, d). Until its cost is known, one is thought to be as the others
    are on average, so that the next goes elsewhere."""
    likely = costs.mean() if len(costs) else 0.0
    for _ in range(count):
        places = np.vstack([places, sampler.ask(places, costs)])
        costs = np.append(costs, likely)
    return places[-count:]
