"""What a tape tells over time, as columns."""

from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nav.messages import ActuatorTargets, Decision, EgoEstimate, GpsFix, ObstacleCells, VehicleState
from tape.reader import read
from tape.record import PREFIX
from tape.truth import TRUTH, TrueState

Floats = NDArray[np.float64]
KEPT: dict[type[Any], tuple[str, ...]] = {
    TrueState: ("position_m", "speed_mps"),
    EgoEstimate: ("position_m", "speed_mps", "position_sd_m"),
    Decision: ("V0_mps", "speed_mps", "cross_track_m"),
    VehicleState: ("steering_rad", "gear"),
    ActuatorTargets: ("steering_rad", "throttle", "brake"),
    GpsFix: ("quality",),
}
"""The fields of each kind of message that a report shows."""


class Series:
    """The kept fields of all messages, by kind."""

    def __init__(self, log: Path, shown: Callable[[float], None] = lambda _: None) -> None:
        """Read a tape to its end.

        Args:
            log: the tape.
            shown: is told how far that is, [s].

        Raises:
            TapeError: no tape, or a damaged one.
        """
        self._kept: dict[tuple[type[Any], str], list[Any]] = defaultdict(list)
        self.states: list[tuple[float, str]] = []
        """Time and state of each decision."""
        self.cells_m: list[Floats] = []
        """Obstacle cells as they were reported, each shape (n, 2), route frame N."""
        self.end_s = 0.0
        for record in read(log, (PREFIX, TRUTH)):
            self.end_s = record.delivery_ns * 1e-9
            self._take(record.message)
            shown(self.end_s)

    def of(self, kind: type[Any], name: str) -> Floats:
        """A column, shape (n,) or (n, k); n is 0 where the tape has no such message."""
        return np.array(self._kept[kind, name], dtype=np.float64)

    def times(self, kind: type[Any]) -> Floats:
        """When each message of a kind was delivered, shape (n,), [s]."""
        return self.of(kind, "")

    def _take(self, message: Any) -> None:
        kind = type(message)
        if kind in KEPT:
            self._kept[kind, ""].append(self.end_s)
            for name in KEPT[kind]:
                self._kept[kind, name].append(getattr(message, name))
        if kind is Decision:
            self.states.append((self.end_s, message.state))
        elif kind is ObstacleCells:
            self.cells_m.append(message.position_m)

    def spans(self) -> list[tuple[float, float, str]]:
        """From when to when the navigator was in which state, [s]."""
        found: list[tuple[float, float, str]] = []
        for time_s, state in self.states:
            if found and found[-1][2] == state:
                found[-1] = (found[-1][0], time_s, state)
            else:
                found.append((time_s, time_s, state))
        return [(start, end + 0.1, state) for start, end, state in found]
