"""Charges the time of a run to its parts."""

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

Parts = Mapping[str, Sequence[tuple[Any, str]]]
"""What belongs to each part: owners and names of functions. What one of them calls of another part
is the other's."""


class Meter:
    """Charges wall time to one part at a time."""

    def __init__(self, parts: Iterable[str]) -> None:
        self.spent_s = dict.fromkeys((*parts, "rest"), 0.0)
        self._part, self._since_s = "rest", time.perf_counter()

    def restart(self) -> None:
        """Nothing is spent yet."""
        self.switch("rest")
        self.spent_s = dict.fromkeys(self.spent_s, 0.0)

    def switch(self, part: str) -> str:
        """From now on it is `part` that spends; returns which one did."""
        now_s, before = time.perf_counter(), self._part
        self.spent_s[before] += now_s - self._since_s
        self._part, self._since_s = part, now_s
        return before

    def metered(self, part: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The same function, at the expense of `part`."""

        def spend(*arguments: Any, **options: Any) -> Any:
            before = self.switch(part)
            try:
                return function(*arguments, **options)
            finally:
                self.switch(before)

        return spend


@contextmanager
def metering(parts: Parts) -> Iterator[Meter]:
    """All functions of all parts are metered for a while."""
    meter = Meter(parts)
    owned = [(part, owner, name) for part, all_of_it in parts.items() for owner, name in all_of_it]
    plain = [getattr(owner, name) for _, owner, name in owned]
    for (part, owner, name), function in zip(owned, plain, strict=True):
        setattr(owner, name, meter.metered(part, function))
    try:
        yield meter
    finally:
        for (_, owner, name), function in zip(owned, plain, strict=True):
            setattr(owner, name, function)
