"""The one gate: what passes here is finite and newer than the last of its kind.

All code behind it assumes good data, so nothing behind it checks again.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields
from functools import cache
from math import isfinite
from operator import attrgetter
from typing import Any

import numpy as np

from nav.messages import Floats, LidarScan, RadarTracks, SensorMessage, device

FUTURE_NS = 50_000_000
"""A message may be this much ahead of the call's time (clocks of the truck's devices)."""


@cache
def _floats_of(kind: type[Any]) -> Callable[[SensorMessage], tuple[Floats | float, ...]]:
    """Reads all float and array fields of a message, and its time: a tuple even of one field."""
    names = [f.name for f in fields(kind) if f.type in (float, Floats)]
    return attrgetter(*names, "time_ns")


def _finite(message: SensorMessage) -> bool:
    """A sum of squares is finite only where all its terms are, and quicker than a sum."""
    for value in _floats_of(type(message))(message):
        if not isfinite(value.dot(value) if isinstance(value, np.ndarray) else value):
            return False
    return True


def _even(tracks: RadarTracks) -> bool:
    """Whether each track has a range, an azimuth and a rate."""
    shape = tracks.range_m.shape
    return len(shape) == 1 and shape == tracks.azimuth_rad.shape == tracks.range_rate_mps.shape


@dataclass
class Admission:
    """Drops messages that are not finite, too old, from the future, backward in time, or of a
    scanner that the vehicle does not have; and tracks that lack a number."""

    stale_ns: int
    scanners: tuple[str, ...]
    """Names of the vehicle's LIDARs."""
    newest_ns: dict[str, int] = field(default_factory=dict[str, int])
    """Time of the newest good message of each device."""
    dropped: dict[str, int] = field(default_factory=dict[str, int])
    """Count for each reason."""

    def admit(self, now_ns: int, messages: Iterable[SensorMessage]) -> list[SensorMessage]:
        """The good messages in order of delivery; the others are counted by reason."""
        return [message for message in messages if self._passes(now_ns, message)]

    def _passes(self, now_ns: int, message: SensorMessage) -> bool:
        source = device(message)
        if reason := self._fault(now_ns, message, source):
            self.dropped[reason] = self.dropped.get(reason, 0) + 1
            return False
        self.newest_ns[source] = message.time_ns
        return True

    def _fault(self, now_ns: int, message: SensorMessage, source: str) -> str:
        if isinstance(message, LidarScan) and source not in self.scanners:
            return "unknown scanner"
        if isinstance(message, RadarTracks) and not _even(message):
            return "uneven"
        if not _finite(message):
            return "not finite"
        if now_ns - message.time_ns > self.stale_ns:
            return "stale"
        if message.time_ns - now_ns > FUTURE_NS:
            return "from the future"
        if message.time_ns <= self.newest_ns.get(source, -1):
            return "backward"
        return ""
