"""What fails, made as simple as it still fails: fewer things set, less far from what is usual.

What varied is left as ION has it, one name after the other, wherever the same verdict fails without
it (Zeller and Hildebrandt 2002); so are devices that fail and what is taken away. Then the smallest
seed that will do; then what is left is brought nearer to its usual value by bisection.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from ion.falsify.search import Drive, Episode
from ion.falsify.space import Point, Space
from scenarios.distribution import Number

HALVINGS = 4
"""A number that must stay is known to a sixteenth of its way from what is usual."""
SMALLEST = 3
"""So many seeds from the smallest on are tried instead of the one that was found."""
OTHERS = 4
"""So many other seeds are tried to say whether the seed matters."""
DIGITS = 3
"""Of the numbers that people will read, if they still fail."""


class Shrunk(NamedTuple):
    """The simplest case that was found."""

    episode: Episode
    figure: str
    """Whose verdict fails in it."""
    drives: int
    """It took so many to find it."""
    other_seeds: int
    """Of those that were tried with the same values ..."""
    failing_seeds: int
    """... so many fail, too."""


@dataclass
class Shrinking:
    """A case that becomes simpler, step by step."""

    space: Space
    drive: Drive
    usual: dict[str, Number]
    """What each name has where nothing sets it; a word where it is no number."""
    found: Episode
    figure: str
    budget: int
    drives: int = 0
    more: dict[str, Any] = field(default_factory=dict)
    """Fields of the scenario that have become simpler."""

    def fails(self, values: dict[str, Number], seed: int, **more: Any) -> bool:
        """Whether the verdict still fails so; then this is what was found. Nothing fails any more
        when the budget is spent."""
        if self.drives >= self.budget:
            return False
        self.drives += 1
        point = self.space.at(values, seed, **(self.more | more))
        episode = Episode(point, self.drive([point])[0])
        if self.figure not in episode.failed:
            return False
        self.found, self.more = episode, self.more | more
        return True

    @property
    def point(self) -> Point:
        """The simplest so far."""
        return self.found.point


def shrunk(
    space: Space, drive: Drive, usual: dict[str, Number], found: Episode, budget: int
) -> Shrunk:
    """The simplest case of what was found, after at most `budget` drives."""
    case = Shrinking(space, drive, usual, found, found.failed[0], budget)
    _leave_as_usual(case)
    _without(case, "faults")
    _without(case, "ablate")
    _smallest_seed(case)
    for name in case.point.values:
        _nearer(case, name)
    return Shrunk(case.found, case.figure, case.drives, *_with_other_seeds(case))


def _leave_as_usual(case: Shrinking) -> None:
    """First all at once, then one by one, until none can go any more."""
    if case.point.values and case.fails({}, case.point.seed):
        return
    gone = True
    while gone:
        before = case.point.values
        gone = [n for n in before if case.fails(_but(case.point.values, n), case.point.seed)]


def _but(values: dict[str, Number], name: str) -> dict[str, Number]:
    return {n: value for n, value in values.items() if n != name}


def _without(case: Shrinking, what: str) -> None:
    """Of a list of words, those that are needed."""
    for word in getattr(case.space.scenario, what):
        now: Sequence[str] = getattr(case.point.scenario, what)
        fewer = tuple(w for w in now if w != word)
        case.fails(case.point.values, case.point.seed, **{what: fewer})


def _smallest_seed(case: Shrinking) -> None:
    smaller = [s for s in sorted(case.space.seeds)[:SMALLEST] if s < case.point.seed]
    next(filter(lambda seed: case.fails(case.point.values, seed), smaller), None)


def _nearer(case: Shrinking, name: str) -> None:
    """By bisection between what is usual, where it passes, and what fails."""
    far, near = case.point.values[name], case.usual.get(name)
    if not isinstance(far, float) or not isinstance(near, float):
        return
    if case.fails(case.point.values | {name: _short(far)}, case.point.seed):
        far = _short(far)
    for _ in range(HALVINGS):
        middle = _short((near + far) / 2.0)
        if not min(near, far) < middle < max(near, far):
            return
        if case.fails(case.point.values | {name: middle}, case.point.seed):
            far = middle
        else:
            near = middle


def _short(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def _with_other_seeds(case: Shrinking) -> tuple[int, int]:
    """How many were tried, and how many fail."""
    count = min(OTHERS, case.budget - case.drives)
    others = [s for s in case.space.seeds if s != case.point.seed][:count]
    points = [case.space.at(case.point.values, seed, **case.more) for seed in others]
    results = case.drive(points) if points else []
    failing = [
        p for p, r in zip(points, results, strict=True) if case.figure in Episode(p, r).failed
    ]
    case.drives += len(points)
    return len(points), len(failing)
