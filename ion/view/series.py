"""What came one after the other on a tape, found again by time."""

from bisect import bisect_right
from functools import lru_cache
from typing import Any, Generic, TypeVar

import numpy as np

from nav.messages import Floats
from tape.reader import Packed

M = TypeVar("M")


@lru_cache(maxsize=512)
def _unpacked(item: Packed) -> Any:
    return item.message()


class Series(Generic[M]):
    """The messages of one topic. They stay packed: of most of them only one moment is asked for.

    One thread appends while others ask: the time is appended last, and never taken away.
    """

    def __init__(self) -> None:
        self.time_s: list[float] = []
        self._item: list[Packed] = []

    def append(self, time_s: float, item: Packed) -> None:
        """Take the next one, not earlier than the last."""
        self._item.append(item)
        self.time_s.append(time_s)

    def index(self, time_s: float) -> int:
        """Of the newest at a time; -1 before the first."""
        return bisect_right(self.time_s, time_s) - 1

    def at(self, time_s: float) -> M | None:
        """The newest at a time; None before the first."""
        index = self.index(time_s)
        return _unpacked(self._item[index]) if index >= 0 else None

    def next_s(self, time_s: float) -> float | None:
        """When the first one behind a time came; None behind the last."""
        index = bisect_right(self.time_s, time_s)
        return self.time_s[index] if index < len(self.time_s) else None

    def previous_s(self, time_s: float) -> float | None:
        """When the one before the newest came; None at the first."""
        index = self.index(time_s) - 1
        return self.time_s[index] if index >= 0 else None


class Columns:
    """Numbers in step with time, for curves and tracks. One thread appends while others ask."""

    def __init__(self, width: int) -> None:
        self.width = width
        self._row: list[tuple[float, ...]] = []

    def append(self, time_s: float, *values: float) -> None:
        """Take the next row."""
        self._row.append((time_s, *values))

    def between(self, start_s: float, end_s: float) -> Floats:
        """The rows of start <= t <= end, shape (n, 1 + width): the time first."""
        low = bisect_right(self._row, (np.nextafter(start_s, -np.inf), np.inf))
        high = bisect_right(self._row, (end_s, np.inf))
        return np.array(self._row[low:high]).reshape(-1, 1 + self.width)

    def at(self, time_s: float) -> tuple[float, ...] | None:
        """The newest row at a time, without it; None before the first."""
        index = bisect_right(self._row, (time_s, np.inf)) - 1
        return self._row[index][1:] if index >= 0 else None
