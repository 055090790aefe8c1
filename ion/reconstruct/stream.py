"""What was heard of one device over a tape: when, how late, and whether it repeated itself."""

from array import array
from collections.abc import Callable
from dataclasses import fields
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.messages import (
    LIDAR_NO_RETURN_M,
    Floats,
    GpsFix,
    GpsQuality,
    LidarScan,
    RadarTracks,
    RoadEstimate,
    SensorMessage,
    SonarScan,
    VehicleState,
)


class Stream(NamedTuple):
    """The messages of one device in the order of their measurement; seconds since the start."""

    measured_s: Floats
    """Shape (n,)."""
    delivered_s: Floats
    """Shape (n,)."""
    repeats: NDArray[np.bool_]
    """Shape (n,): says to the bit what the one before said, although it says something."""

    @property
    def period_s(self) -> float:
        """From one measurement to the next, usually."""
        return float(np.median(np.diff(self.measured_s))) if len(self.measured_s) > 1 else 0.0


class Listener:
    """Hears one device; what it holds grows by 17 bytes a message."""

    def __init__(self) -> None:
        self._measured, self._delivered, self._repeats = array("q"), array("q"), array("b")
        self._said: Any = None

    def hear(self, time_ns: int, message: SensorMessage) -> None:
        """Take a message that was delivered at a time."""
        said = _content(message)
        self._measured.append(message.time_ns)
        self._delivered.append(time_ns)
        self._repeats.append(said is not None and said == self._said)
        self._said = said

    def stream(self, start_ns: int) -> Stream:
        """All that was heard."""
        order = np.argsort(np.array(self._measured, np.int64), kind="stable")
        measured, delivered = (
            _seconds(times, start_ns)[order] for times in (self._measured, self._delivered)
        )
        return Stream(measured, delivered, np.array(self._repeats, bool)[order])


def _seconds(times: "array[int]", start_ns: int) -> Floats:
    return (np.array(times, np.int64) - start_ns).astype(np.float64) * 1e-9


SAYS_NOTHING: dict[type, Callable[[Any], bool]] = {
    LidarScan: lambda scan: bool((scan.range_m >= LIDAR_NO_RETURN_M).all()),
    SonarScan: lambda scan: bool(np.ptp(scan.range_m) == 0.0),
    RadarTracks: lambda tracks: not len(tracks.range_m),
    GpsFix: lambda fix: fix.quality == GpsQuality.NONE,
    VehicleState: lambda state: not state.wheel_speed_mps.any(),
    RoadEstimate: lambda road: road.confidence == 0.0,
}
"""Messages that a sound device may well repeat: no echo, no track, no fix, a stand."""


def _content(message: SensorMessage) -> Any:
    """All that a message says but its time; None where that is nothing."""
    says_nothing = SAYS_NOTHING.get(type(message))
    if says_nothing and says_nothing(message):
        return None
    values = (getattr(message, name) for name in _names(type(message)))
    return tuple(v.tobytes() if isinstance(v, np.ndarray) else v for v in values)


@cache
def _names(kind: type[Any]) -> tuple[str, ...]:
    return tuple(field.name for field in fields(kind) if field.name != "time_ns")
