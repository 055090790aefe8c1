"""What a replay makes of a whole tape: how many ticks, what differs first, and all that moved."""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from scenarios.difference import Difference, differences
from scenarios.replay import Tick

LEAD_TICKS = 100
"""Two seconds before the first difference are kept for the picture."""
Shown = Callable[[Tick], None]
"""Is shown every tick when it has been compared; may raise to end the replay."""


class First(NamedTuple):
    """Where tape and replay part."""

    tick: int
    """Counted from 0."""
    time_s: float
    difference: Difference


@dataclass
class Moved:
    """How a field differs over the tape."""

    ticks: int
    first_s: float
    last_s: float
    most: float | None
    """The largest difference; None of what is not numbers."""

    def again(self, time_s: float, most: float | None) -> None:
        """Take one tick more."""
        self.ticks, self.last_s = self.ticks + 1, time_s
        self.most = max((m for m in (self.most, most) if m is not None), default=None)


@dataclass
class Comparison:
    """Grows tick by tick; a difference does not end it, so that all shows that moves."""

    tolerance: float
    ticks: int = 0
    first: First | None = None
    moved: dict[str, Moved] = field(default_factory=dict[str, Moved])
    """By field, in the order in which they first differ."""
    kept: "deque[Tick]" = field(default_factory=lambda: deque[Tick](maxlen=LEAD_TICKS))
    """From a little before the first difference on, without what was heard."""

    def take(self, tick: Tick) -> None:
        """Compare one tick more."""
        found, time_s = differences(tick, self.tolerance), tick.time_ns * 1e-9
        if found and self.first is None:
            self.first = First(self.ticks, time_s, found[0])
            self.kept = deque(self.kept)
        for each in found:
            if each.field in self.moved:
                self.moved[each.field].again(time_s, each.most)
            else:
                self.moved[each.field] = Moved(1, time_s, time_s, each.most)
        self.kept.append(tick._replace(messages=()))
        self.ticks += 1


def compare(ticks: Iterable[Tick], tolerance: float, shown: Shown) -> Comparison:
    """Compare a tape from its beginning to its end."""
    comparison = Comparison(tolerance)
    for tick in ticks:
        comparison.take(tick)
        shown(tick)
    return comparison
