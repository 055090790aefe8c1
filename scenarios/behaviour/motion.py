"""What several figures ask of the true motion and of what was said."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from tape.record import Record

T = TypeVar("T")

MOVES_MPS = 0.05
"""Slower than this it stands: a vehicle that stands shakes on its springs."""
SPAN_NS = 500_000_000
"""Rates are means over this time: what a rider feels, not what a tire does on a bump."""


def newest(records: Sequence[Record], kind: type[T]) -> T | None:
    """The last message of a kind that crossed the boundary in a tick, if any."""
    for item in reversed(records):
        if isinstance(item.message, kind):
            return item.message
    return None


def _values() -> deque[tuple[int, float]]:
    return deque()


@dataclass
class Rate:
    """How fast a quantity changes, as the mean over half a second."""

    _past: deque[tuple[int, float]] = field(default_factory=_values)
    """Times [ns] and values of the last half second."""

    def of(self, time_ns: int, value: float) -> float | None:
        """Take the next value; its change a second, None before there are values for the span."""
        past = self._past
        past.append((time_ns, value))
        while len(past) > 1 and time_ns - past[1][0] >= SPAN_NS:
            past.popleft()
        gone_ns = time_ns - past[0][0]
        return (value - past[0][1]) * 1e9 / gone_ns if gone_ns >= SPAN_NS else None
