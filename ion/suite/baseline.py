"""What has moved since another time: verdicts one by one, figures with their interval over seeds.

The same seeds draw the same courses, so drives are compared in pairs: what differs between seeds is
no noise here. A figure has moved when the interval of its mean difference leaves out 0.
"""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ion.errors import UsageError
from ion.suite.results import run_of
from ion.telling import Result

LEAST_SEEDS = 5
"""Fewer say nothing of others."""
CONFIDENCE = 0.99
"""High, since many figures are looked at."""
RESAMPLED = 2000
SPENT = ("wall_time_s", "real_time_factor", "seed")
"""What is no figure of the drive."""


class Turned(NamedTuple):
    """A verdict that came out otherwise."""

    case: str
    figure: str
    passes: bool
    """Now."""
    then: Any
    now: Any


class Moved(NamedTuple):
    """A figure of a run."""

    run: str
    figure: str
    seeds: int
    then: float
    """Mean over the seeds."""
    now: float
    low: float
    """Of the mean difference ..."""
    high: float
    """... so much at most."""


class Changes(NamedTuple):
    """All of them, and what changed first."""

    turned: list[Turned]
    moved: list[Moved]
    other: list[str]
    """Cases whose digests differ, in the order of the suite."""

    @property
    def regressions(self) -> list[Turned]:
        """What passed then and fails now."""
        return [verdict for verdict in self.turned if not verdict.passes]


def read(path: Path) -> dict[str, Result]:
    """The results of another time, by case.

    Raises:
        UsageError: the file holds none.
    """
    try:
        rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
        return {row["case"]: row for row in rows}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise UsageError(f"--baseline {path}: expected the results.jsonl of a suite") from error


def changes(now: Sequence[Result], then: dict[str, Result]) -> Changes:
    """What has moved in the cases that both have."""
    pairs = [(then[result["case"]], result) for result in now if result["case"] in then]
    turned = [turn for before, after in pairs for turn in _turned(before, after)]
    other = [b["case"] for a, b in pairs if a.get("digest") != b.get("digest")]
    return Changes(turned, list(_moved(pairs)), other)


def _turned(then: Result, now: Result) -> Iterator[Turned]:
    before = {v["figure"]: v for v in then.get("verdicts", ())}
    for verdict in now.get("verdicts", ()):
        old = before.get(verdict["figure"])
        if old and old["passed"] != verdict["passed"]:
            values = old["value"], verdict["value"]
            yield Turned(now["case"], verdict["figure"], verdict["passed"], *values)


def _moved(pairs: Sequence[tuple[Result, Result]]) -> Iterator[Moved]:
    runs = dict.fromkeys(run_of(now) for _, now in pairs)
    for run in runs:
        of_run = [(then, now) for then, now in pairs if run_of(now) == run]
        for figure in of_run[0][1]:
            values = [(then.get(figure), now[figure]) for then, now in of_run if figure in now]
            numbers = np.array([pair for pair in values if all(map(_number, pair))], dtype=float)
            if figure not in SPENT and len(numbers) >= LEAST_SEEDS:
                yield from _beyond_chance(run, figure, numbers)


def _beyond_chance(run: str, figure: str, pairs: Any) -> Iterator[Moved]:
    """Pairs (n, 2), then and now. The interval is a bootstrap's (Efron 1979), its draws fixed."""
    difference = pairs[:, 1] - pairs[:, 0]
    drawn = np.random.default_rng(0).choice(difference, (RESAMPLED, len(difference)))
    tail = 0.5 * (1.0 - CONFIDENCE)
    low, high = np.quantile(drawn.mean(axis=1), (tail, 1.0 - tail)).tolist()
    if low > 0.0 or high < 0.0:
        then, now = pairs.mean(axis=0).tolist()
        yield Moved(run, figure, len(pairs), then, now, low, high)


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
