"""Drives that are done once: each result goes to the disk as it comes, and is read from there."""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ion.falsify.cost import clearance_m, cost
from ion.falsify.space import Point
from ion.job import stop_when_asked
from ion.suite.cases import Case
from ion.suite.results import rows_of
from ion.telling import Result
from scenarios.behaviour import Behaviour
from scenarios.episode import Episode
from scenarios.run import run
from scenarios.scenario_file import ARRIVED

FILE = "drives.jsonl"
Many = Callable[[Callable[[int], Result], Sequence[int]], Iterator[Result]]
"""As `scenarios.batch.workers` gives it."""


class BrokenDriveError(RuntimeError):
    """A drive raised, or its process died: nothing is known of its verdicts."""


Break = Callable[[Episode, Mapping[str, Any]], Episode]
"""Breaks something of an episode that has not begun, knowing what its scenario sets."""


def healthy(episode: Episode, values: Mapping[str, Any]) -> Episode:
    """The episode as it is."""
    del values  # Unused.
    return episode


@dataclass(frozen=True)
class Work:
    """Drives a point by its number, for `scenarios.batch`."""

    points: Sequence[Point]
    broken: Break = healthy

    def __call__(self, number: int) -> Result:
        scenario, _, seed = self.points[number]
        episode, behaviour = self.broken(scenario.episode(seed), scenario.vary), Behaviour()
        figures = run(episode, None, [behaviour, stop_when_asked]) | behaviour.figures()
        told = {"verdicts": [v._asdict() for v in scenario.judged(figures)]}
        found = {"cost": cost(figures, scenario.verdicts or ARRIVED)}
        return {"number": number} | figures | told | found | {"clear_m": clearance_m(figures)}


class Drives:
    """Any points, a few at a time."""

    def __init__(self, folder: Path, code: str, many: Many, broken: Break = healthy) -> None:
        """Take over what stands in the folder and was driven by this code."""
        self.path = folder / FILE
        self._code, self._many, self._broken = code, many, broken
        self._known = {row["holds"]: row for row in rows_of(self.path) if "holds" in row}

    def __call__(self, points: Sequence[Point]) -> list[Result]:
        """What the points come to, in their order.

        Raises:
            BrokenDriveError: one raised, or its process died.
            KeyboardInterrupt: the user wants no more; what was driven until then is kept.
        """
        holds = [Case(point.scenario, point.seed).holds_for(self._code) for point in points]
        new = {h: p for h, p in zip(holds, points, strict=True) if h not in self._known}
        self._drive(list(new), list(new.values()))
        return [self._known[h] for h in holds]

    def _drive(self, holds: list[str], points: list[Point]) -> None:
        interrupted = False
        for driven in self._many(Work(points, self._broken), range(len(points))):
            if driven["outcome"] == "error":
                broken = points[driven["seed"]]
                raise BrokenDriveError(f"seed {broken.seed}, {broken.values}: {driven['message']}")
            if driven["outcome"] == "interrupted":
                interrupted = True
                continue
            number = driven.pop("number")  # what the pool calls its seed
            self._keep(holds[number], points[number], driven)
        if interrupted:
            raise KeyboardInterrupt

    def _keep(self, holds: str, point: Point, driven: Result) -> None:
        """To the last bit, unlike other results: a search that goes on must see the same costs."""
        row = {"holds": holds, "seed": point.seed, "values": point.values} | driven
        self._known[holds] = row
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
