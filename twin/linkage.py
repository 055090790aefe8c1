"""The gear linkage R-N-L-H: a slow motor walks it from position to position, and may have to try
again.

Numbers with unit, source and grade: models/README.md.
"""

from dataclasses import dataclass
from math import exp

import numpy as np

from nav.messages import Gear


@dataclass(frozen=True)
class GearboxParameters:
    """How long the linkage takes from one position to the next: log-normal, cut off."""

    shift_s_per_position: float = 2.0
    """Median of one try."""
    shift_sigma: float = 0.5
    """Standard deviation of the logarithm."""
    shift_least_s: float = 0.7
    """Shortest: R to H, three positions, in 2 s."""
    shift_limit_s: float = 20.0
    """Longest, all tries together: R to H in the paper's "up to one minute"."""
    try_again: float = 0.1
    """How often the dogs do not meet, and the linkage goes back and tries again."""
    rolling_mps: float = 0.3
    """The linkage does not leave a position while the vehicle is faster than this."""


class Gearbox:
    """A linkage that is at a position, or on its way to the next."""

    def __init__(self, parameters: GearboxParameters, rng: np.random.Generator, gear: Gear) -> None:
        self.parameters = parameters
        self.gear = gear
        """The position that it left last, or is at."""
        self.shifting = False
        self._rng = rng
        self._next = gear
        self._try_s = self._left_s = 0.0
        self._spent_s = 0.0

    @property
    def position(self) -> float:
        """Where its potentiometer stands, in positions: 0 is R, 3 is H."""
        if not self.shifting:
            return float(self.gear)
        return self.gear + (self._next - self.gear) * (1.0 - self._left_s / self._try_s)

    def step(self, target: Gear, speed_mps: float, dt_s: float) -> None:
        """Advance by `dt_s` towards `target`; refuse to leave a position while rolling."""
        if self.shifting:
            self._walk(dt_s)
        if not self.shifting and target != self.gear:
            self._leave(target, speed_mps)

    def _leave(self, target: Gear, speed_mps: float) -> None:
        if abs(speed_mps) > self.parameters.rolling_mps:
            return
        self._next = Gear(self.gear + (1 if target > self.gear else -1))
        self._spent_s = 0.0
        self.shifting = True
        self._try(self._duration_s())

    def _walk(self, dt_s: float) -> None:
        self._left_s -= dt_s
        if self._left_s > 0.0:
            return
        again_s, meets = self._duration_s(), self._rng.random() >= self.parameters.try_again
        if meets or self._spent_s + again_s > self.parameters.shift_limit_s:
            self.gear = self._next
            self.shifting = False
        else:
            self._try(again_s)

    def _try(self, duration_s: float) -> None:
        self._try_s = self._left_s = duration_s
        self._spent_s += duration_s

    def _duration_s(self) -> float:
        p = self.parameters
        drawn = p.shift_s_per_position * exp(p.shift_sigma * self._rng.standard_normal())
        return min(max(drawn, p.shift_least_s), p.shift_limit_s)
