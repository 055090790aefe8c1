"""The one gate: what passes here has the shape of what the vehicle's sensors give, is a number that
can be true, and is newer than the last of its kind.

All code behind it assumes good data, so nothing behind it checks again.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields
from functools import cache
from math import isfinite
from operator import attrgetter
from typing import Any

import numpy as np

from nav.messages import (
    Floats,
    GpsFix,
    ImuSample,
    LidarScan,
    SensorMessage,
    SonarScan,
    VehicleState,
    device,
)
from nav.parameters.vehicle import VehicleParameters

FUTURE_NS = 50_000_000
"""A message may be this much ahead of the call's time (clocks of the truck's devices)."""
MOST = {
    "range_m": 2e3, "azimuth_rad": 10.0, "range_rate_mps": 1e3,
    "latitude_deg": 90.0, "longitude_deg": 180.0, "altitude_m": 1e4, "sd_m": 1e3,
    "velocity_mps": 200.0, "wheel_speed_mps": 200.0,
    "angular_rate_radps": 50.0, "acceleration_mps2": 1e4, "roll_rad": 3.2, "pitch_rad": 1.5,
    "heading_rad": 6.3, "steering_rad": 1.6, "throttle": 2.0, "brake": 2.0,
    "offset_m": 100.0, "width_m": 100.0, "confidence": 2.0,
}  # fmt: skip
"""The largest magnitude of each number that can be true, with ample room (estimated); of an array,
its length as a vector: 361 beams without return are 1556 m."""


Reader = Callable[[SensorMessage], tuple[Floats | float, ...]]


@cache
def _numbers_of(kind: type[Any]) -> tuple[Reader, list[float]]:
    """Reads all float and array fields of a message, and the squares of the most they can be."""
    names = [f.name for f in fields(kind) if f.type in (float, Floats)]
    return attrgetter(*names, "time_ns"), [MOST[name] ** 2 for name in names]


@cache
def _arrays_of(kind: type[Any]) -> tuple[str, ...]:
    return tuple(f.name for f in fields(kind) if f.type is Floats)


def _out_of_range(message: SensorMessage) -> str:
    """A sum of squares is finite only where all its terms are, and quicker than a sum."""
    read, most = _numbers_of(type(message))
    for value, limit in zip(read(message), most, strict=False):  # the time has no limit
        square = value.dot(value) if isinstance(value, np.ndarray) else value * value
        if not square <= limit:  # nor is what is not a number
            return "out of range" if isfinite(square) else "not finite"
    return ""


@dataclass
class Admission:
    """Drops messages of the wrong shape, not finite, beyond what can be true, too old, from the
    future, backward in time, or of a scanner that the vehicle does not have; and all messages while
    the call's own clock is behind what it has been."""

    stale_ns: int
    vehicle: VehicleParameters
    now_ns: int = -1
    """The newest time of a call."""
    newest_ns: dict[str, int] = field(default_factory=dict[str, int])
    """Time of the newest good message of each device."""
    dropped: dict[str, int] = field(default_factory=dict[str, int])
    """Count for each reason."""
    _shapes: dict[type[Any], tuple[int]] = field(init=False)
    """Of the arrays of each kind of message; those of a radar need only be alike."""

    def __post_init__(self) -> None:
        beams, sonars = self.vehicle.lidar.count, len(self.vehicle.sonar_mounts)
        self._shapes = {
            LidarScan: (beams,), SonarScan: (sonars,), GpsFix: (3,), ImuSample: (3,),
            VehicleState: (6,),
        }  # fmt: skip

    def admit(self, now_ns: int, messages: Iterable[SensorMessage]) -> list[SensorMessage]:
        """The good messages in order of delivery; the others are counted by reason."""
        self.now_ns = max(self.now_ns, now_ns)
        with np.errstate(over="ignore"):  # squares may
            return [message for message in messages if self._passes(now_ns, message)]

    def _passes(self, now_ns: int, message: SensorMessage) -> bool:
        source = device(message)
        if reason := self._fault(now_ns, message, source):
            self.dropped[reason] = self.dropped.get(reason, 0) + 1
            return False
        self.newest_ns[source] = message.time_ns
        return True

    def _fault(self, now_ns: int, message: SensorMessage, source: str) -> str:
        if now_ns < self.now_ns:
            return "clock went back"
        if isinstance(message, LidarScan) and source not in self.vehicle.lidar_mounts:
            return "unknown scanner"
        if not self._has_shape(message):
            return "wrong shape"
        if reason := _out_of_range(message):
            return reason
        if now_ns - message.time_ns > self.stale_ns:
            return "stale"
        if message.time_ns - now_ns > FUTURE_NS:
            return "from the future"
        if message.time_ns <= self.newest_ns.get(source, -1):
            return "backward"
        return ""

    def _has_shape(self, message: SensorMessage) -> bool:
        expected = self._shapes.get(type(message))
        for name in _arrays_of(type(message)):
            shape = getattr(message, name).shape
            expected = expected or shape[:1] or (0,)
            if shape != expected:
                return False
        return True
