"""The clock of a shown drive: where it stands, and how fast it runs."""

from dataclasses import dataclass
from math import inf

SLOWEST, FASTEST = 0.25, 16.0
NEWEST = inf
"""A speed that stays at the end, also of a drive that goes on."""


@dataclass
class Player:
    """Time on the tape, moved on by the time of the wall."""

    time_s: float = 0.0
    speed: float = 1.0
    playing: bool = False

    def advance(self, wall_s: float, end_s: float, complete: bool) -> None:
        """Play on for `wall_s`; stand at the end, and stop there if no more will come."""
        if self.playing:
            self.time_s = min(self.time_s + max(wall_s, 1e-6) * self.speed, end_s)
            if complete and self.time_s >= end_s:
                self.playing = False

    def play(self, end_s: float) -> None:
        """Go; from the start again where it stands at the end."""
        if self.time_s >= end_s - 0.05:
            self.time_s = 0.0
        self.playing = True

    def go(self, time_s: float | None) -> None:
        """Stand still at a time; None: stay where it is."""
        self.playing = False
        if time_s is not None:
            self.time_s = time_s
