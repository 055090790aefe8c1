"""Derives from the tape what Foxglove and Lichtblick draw without conversion.

Input is only what is on the tape, and where the scanners sit. Nothing here is replayed or
digested. Each topic has a largest rate; it is kept by the records' own time, never by a clock.
"""

from collections.abc import Callable, Mapping
from typing import Any, Protocol

import foxglove.channels
from foxglove import Context
from foxglove.messages import Timestamp

from nav.messages import (
    Decision,
    EgoEstimate,
    FollowPath,
    GpsFix,
    GpsQuality,
    LidarScan,
    Message,
    ObstacleCells,
)
from tape import drawings
from tape.record import Record

Drawn = list[tuple[str, Any]]
"""Topics and what goes there, messages of `foxglove.messages`."""


class Mounting(Protocol):
    """Pose of a scanner in the vehicle frame; `nav.parameters.LidarMount` is one."""

    @property
    def position_m(self) -> tuple[float, float, float]: ...
    @property
    def yaw_rad(self) -> float: ...
    @property
    def pitch_rad(self) -> float: ...
    @property
    def roll_rad(self) -> float: ...


class View:
    """Draws records. Its state: when each topic was last drawn, and what was last believed."""

    def __init__(
        self,
        mountings: Mapping[str, Mounting] | None = None,
        outline_m: tuple[float, float, float, float] = (2.10, -0.95, 0.762, 1.98),
    ) -> None:
        """Remember the vehicle.

        Args:
            mountings: of the scanners, by `LidarScan.sensor`; a scan without one is not drawn.
            outline_m: front, rear (negative), half width and height of the vehicle, [m].
        """
        self._mountings = dict(mountings or {})
        self._outline_m = outline_m
        self._drawn: dict[str, int] = {}
        self._ego: EgoEstimate | None = None
        self._said = ("", "")

    def update(self, record: Record) -> Drawn:
        """What a record adds to the picture, usually nothing."""
        draw = _DRAW.get(type(record.message))
        return draw(self, record.message) if draw else []

    def _due(self, topic: str, time_ns: int, period_ns: int) -> bool:
        """True once in each period of the record's own time."""
        period = time_ns // period_ns
        if self._drawn.get(topic) == period:
            return False
        self._drawn[topic] = period
        return True

    def _scan(self, scan: LidarScan) -> Drawn:
        topic = f"/view/{scan.sensor}"
        if scan.sensor not in self._mountings or not self._due(topic, scan.time_ns, HZ_5):
            return []
        return [(topic, drawings.scan(_stamp(scan), scan))]

    def _estimate(self, ego: EgoEstimate) -> Drawn:
        self._ego = ego
        if not self._due("/view/frames", ego.time_ns, HZ_10):
            return []
        stamp = _stamp(ego)
        drawn: Drawn = [("/view/frames", drawings.ego_frame(stamp, ego))]
        if self._due("/view/vehicle", ego.time_ns, HZ_1):
            drawn += [("/view/mountings", drawings.mounting_frames(stamp, self._mountings))]
            drawn += [("/view/vehicle", drawings.vehicle(stamp, *self._outline_m))]
        return drawn

    def _path(self, path: FollowPath) -> Drawn:
        if not self._due("/view/path", path.time_ns, HZ_5):
            return []
        return [("/view/path", drawings.path(_stamp(path), path))]

    def _cells(self, cells: ObstacleCells) -> Drawn:
        if not self._due("/view/obstacles", cells.time_ns, HZ_1):
            return []
        return [("/view/obstacles", drawings.obstacles(_stamp(cells), cells))]

    def _fix(self, fix: GpsFix) -> Drawn:
        if fix.quality is GpsQuality.NONE or not self._due("/view/gps", fix.time_ns, HZ_5):
            return []
        return [("/view/gps", drawings.location(_stamp(fix), fix))]

    def _decision(self, decision: Decision) -> Drawn:
        drawn: Drawn = []
        if self._ego and self._due("/view/decision", decision.time_ns, HZ_5):
            drawn += [("/view/decision", drawings.decision(_stamp(decision), decision, self._ego))]
        said = (decision.state, decision.reason)
        if said != self._said:
            self._said = said
            drawn += [("/view/log", drawings.state_change(_stamp(decision), decision))]
        return drawn


HZ_1, HZ_5, HZ_10 = 10**9, 2 * 10**8, 10**8
"""Periods, [ns]."""

_DRAW: dict[type, Callable[[View, Any], Drawn]] = {
    LidarScan: View._scan,
    EgoEstimate: View._estimate,
    FollowPath: View._path,
    ObstacleCells: View._cells,
    GpsFix: View._fix,
    Decision: View._decision,
}


def view_channel(topic: str, drawn: Any, context: Context) -> Any:
    """A channel for what was drawn; Foxglove's SDK has one class of channel for each schema."""
    channel = getattr(foxglove.channels, f"{type(drawn).__name__}Channel")
    return channel(topic, context=context)


def _stamp(message: Message) -> Timestamp:
    return Timestamp(*divmod(message.time_ns, 10**9))
