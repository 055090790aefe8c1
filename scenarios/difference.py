"""What a replay says otherwise than the tape: one comparison, as data and as words."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from enum import Enum
from typing import Any

import numpy as np

from nav.messages import Floats, Message
from scenarios.replay import Tick
from tape.codec import encode

REPORTS = "Outputs.reports"
"""The field's name where the kinds of the messages themselves differ."""


@dataclass(frozen=True)
class Difference:
    """One field of one tick."""

    field: str
    """Such as `Decision.decision_rad`."""
    index: tuple[int, ...] | None
    """In an array: of the first element that differs, whose values the next two are."""
    logged: Any
    """On the tape: a number, a word; of arrays of unlike shapes, the shape in words."""
    now: Any
    """In the replay."""
    most: float | None
    """The largest difference within the field; None where it is not one of numbers."""

    def __str__(self) -> str:
        where = f"{list(self.index)}" if self.index else ""
        if self.field == REPORTS:
            return f"the tape has {self.logged}, the replay {self.now}"
        return f"{self.field}{where} is {self.logged} on the tape, {self.now} in the replay"


def differences(tick: Tick, tolerance: float = 0.0) -> list[Difference]:
    """All that differs, in the order of the tape; without a tolerance, all that has other bits."""
    ours: Sequence[Message] = (*tick.outputs.reports, tick.outputs.targets)
    found = _of_kinds(ours, [item.message for item in tick.logged])
    logged = {type(item.message): item for item in tick.logged}
    for message in ours:
        item = logged.get(type(message))
        if item and encode(message) != item.payload:
            found += _of_fields(message, item.message, tolerance)
    return found


def difference(tick: Tick, tolerance: float = 0.0) -> str:
    """The first of `differences` in words; empty where nothing differs."""
    found = differences(tick, tolerance)
    return str(found[0]) if found else ""


def _of_kinds(ours: Sequence[object], logged: Sequence[object]) -> list[Difference]:
    """Where one of both has a message that the other has not."""
    if [*map(type, ours)] == [*map(type, logged)]:
        return []
    now, then = (", ".join(type(m).__name__ for m in ms) for ms in (ours, logged))
    return [Difference(REPORTS, None, then, now, None)]


def _of_fields(ours: Any, logged: Any, tolerance: float) -> Iterator[Difference]:
    for field in fields(ours):
        name = f"{type(ours).__name__}.{field.name}"
        now, then = getattr(ours, field.name), getattr(logged, field.name)
        if field.type in (float, Floats):
            yield from _of_numbers(name, np.asarray(now, float), np.asarray(then, float), tolerance)
        elif now != then:
            yield Difference(name, None, _plain(then), _plain(now), None)


def _of_numbers(name: str, now: Floats, logged: Floats, tolerance: float) -> Iterator[Difference]:
    if now.shape != logged.shape:
        yield Difference(name, None, _size(logged), _size(now), None)
    elif (apart := _apart(now, logged, tolerance)).any():
        first = tuple(int(axis[0]) for axis in np.nonzero(np.atleast_1d(apart)))
        index = first if now.ndim else ()
        most = float(np.abs(now - logged).max())
        yield Difference(name, index or None, float(logged[index]), float(now[index]), most)


def _apart(now: Floats, logged: Floats, tolerance: float) -> Any:
    """Which numbers differ; without a tolerance a zero's sign counts too."""
    if tolerance:
        return ~np.isclose(now, logged, tolerance, tolerance, equal_nan=True)
    return now.view(np.int64) != logged.view(np.int64)


def _plain(value: Any) -> Any:
    return value.name if isinstance(value, Enum) else value


def _size(array: Floats) -> str:
    return " x ".join(map(str, array.shape)) + " numbers"
