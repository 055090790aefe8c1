"""All that a tape's messages tell of a drive, gathered while the present navigator goes over them.

Nothing else on a tape is looked at: not what a twin knows of its world. Of a part of a drive, the
navigator goes over what was before it too, so that it knows what it knew then.
"""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ion.reconstruct.seen import Seen
from ion.reconstruct.stream import Listener, Stream
from ion.reconstruct.stretches import Stretch, Stretches
from ion.reconstruct.tally import Ints, Tally
from nav.messages import (
    RESET,
    Decision,
    DirectCommand,
    EgoEstimate,
    Floats,
    GpsFix,
    GpsQuality,
    device,
)
from nav.navigator import IonNavigator
from scenarios.replay import Tick, navigator_of, replay
from tape.reader import span_ns


class Part(NamedTuple):
    """Of a drive: from one waypoint to another, by their places in the route."""

    first: int | None = None
    """None: from the beginning of the tape."""
    last: int | None = None
    """None: to its end."""


class Evidence(NamedTuple):
    """Times are seconds since the tape or its part began, places in the route frame N."""

    end_s: float
    arrived: bool
    """Whether the last waypoint of a part was passed."""
    time_s: Floats
    """Shape (n,): of the estimates ..."""
    way_m: Floats
    """... and where the vehicle believed to be, shape (n, 2)."""
    tally: Tally
    """Where beams met obstacles."""
    held: Ints
    """Numbers of the cells that the map held when it saw them last."""
    cell_m: float
    """Edge of a cell."""
    streams: dict[str, Stream]
    """By device; of what was never heard there is none."""
    resets_s: dict[str, list[float]]
    """By device."""
    unfixed: list[Stretch]
    """GPS spoke, but had no solution: the most satellites that it had."""
    doubted: list[Stretch]
    """A device was not believed, and why."""
    fitted: tuple[str, ...]
    """The devices that the vehicle should have."""


def evidence(log: Path, shown: Callable[[Tick], None], part: Part) -> Evidence:
    """Go over a tape from its beginning to its end, or to that of a part.

    Args:
        log: the tape.
        shown: is shown every tick, for a bar.
        part: what is of interest.

    Raises:
        TapeError: no tape, a damaged one, or one that lacks what a navigator needs.
    """
    navigator, ahead = navigator_of(log), 0
    witness = Witness(navigator, span_ns(log)[0])
    for tick in replay(log, navigator):
        shown(tick)
        ahead = _ahead(tick, ahead)
        if part.last is not None and ahead > part.last:
            return witness.evidence(arrived=True)
        if part.first is not None and ahead <= part.first:
            witness.starts(tick.time_ns)
        else:
            witness.take(tick)
    return witness.evidence(arrived=False)


def _ahead(tick: Tick, before: int) -> int:
    """Place in the route of the waypoint ahead, which a decision tells."""
    told = (r.waypoint for r in tick.outputs.reports if isinstance(r, Decision))
    return next(told, before)


class Witness:
    """Looks on, tick by tick."""

    def __init__(self, navigator: IonNavigator, start_ns: int) -> None:
        self._navigator, self._start_ns, self._end_s = navigator, start_ns, 0.0
        self._seen = Seen(navigator.obstacles.cell_m)
        self._time_s: list[float] = []
        self._way: list[Floats] = []
        self._heard: dict[str, Listener] = {}
        self._resets: dict[str, list[float]] = {}
        self._unfixed, self._doubted = Stretches(), Stretches()

    def starts(self, time_ns: int) -> None:
        """Times count from here; nothing is taken before."""
        self._start_ns = time_ns

    def take(self, tick: Tick) -> None:
        """Take what was heard, what the navigator said then, and what it makes of it now."""
        self._end_s = (tick.time_ns - self._start_ns) * 1e-9
        for message in tick.messages:
            listener = self._heard.setdefault(device(message), Listener())
            listener.hear(tick.time_ns, message)
            if isinstance(message, GpsFix):
                self._take_fix(message)
        for record in tick.logged:
            if isinstance(record.message, DirectCommand) and record.message.name == RESET:
                self._resets.setdefault(record.message.sensor, []).append(self._end_s)
        for report in tick.outputs.reports:
            if isinstance(report, EgoEstimate):
                self._decided(report)

    def evidence(self, arrived: bool) -> Evidence:
        """All of it."""
        health, obstacles = self._navigator.health, self._navigator.obstacles
        return Evidence(
            self._end_s,
            arrived,
            np.array(self._time_s),
            np.array(self._way).reshape(-1, 2),
            *self._seen.all(obstacles),
            obstacles.cell_m,
            {name: each.stream(self._start_ns) for name, each in self._heard.items()},
            self._resets,
            self._unfixed.all(),
            self._doubted.all(),
            (*health.sensors, *health.helpers),
        )

    def _take_fix(self, fix: GpsFix) -> None:
        if fix.quality == GpsQuality.NONE:
            self._unfixed.holds(self._end_s, "gps", f"{fix.satellites} satellites")

    def _decided(self, ego: EgoEstimate) -> None:
        self._time_s.append(self._end_s)
        self._way.append(ego.position_m)
        self._seen.look(self._navigator.obstacles)
        for name, reason in self._navigator.plausibility.doubted.items():
            self._doubted.holds(self._end_s, name, reason)
