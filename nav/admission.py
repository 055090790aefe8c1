"""The one gate: what passes here is finite and newer than the last of its kind.

All code behind it assumes good data, so nothing behind it checks again.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields
from functools import cache
from math import isfinite
from typing import Any

from nav.messages import Floats, LidarScan, SensorMessage

FUTURE_NS = 50_000_000
"""A message may be this much ahead of the call's time (clocks of the truck's devices)."""


@cache
def _float_fields(kind: type[Any]) -> tuple[str, ...]:
    return tuple(f.name for f in fields(kind) if f.type in (float, Floats))


def _finite(message: SensorMessage) -> bool:
    for name in _float_fields(type(message)):
        value = getattr(message, name)
        # a sum is finite only where all its terms are
        if not isfinite(value if isinstance(value, float) else value.sum()):
            return False
    return True


def _source(message: SensorMessage) -> str:
    return message.sensor if isinstance(message, LidarScan) else type(message).__name__


@dataclass
class Admission:
    """Drops messages that are not finite, too old, from the future, or backward in time."""

    stale_ns: int
    newest_ns: dict[str, int] = field(default_factory=dict[str, int])
    dropped: dict[str, int] = field(default_factory=dict[str, int])
    """Count for each reason."""

    def admit(self, now_ns: int, messages: Iterable[SensorMessage]) -> Iterator[SensorMessage]:
        """Yield the good messages in order of delivery; count the others by reason."""
        for message in messages:
            if reason := self._fault(now_ns, message):
                self.dropped[reason] = self.dropped.get(reason, 0) + 1
                continue
            self.newest_ns[_source(message)] = message.time_ns
            yield message

    def _fault(self, now_ns: int, message: SensorMessage) -> str:
        if not _finite(message):
            return "not finite"
        if now_ns - message.time_ns > self.stale_ns:
            return "stale"
        if message.time_ns - now_ns > FUTURE_NS:
            return "from the future"
        if message.time_ns <= self.newest_ns.get(_source(message), -1):
            return "backward"
        return ""
