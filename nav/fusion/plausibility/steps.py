"""By how much all ranges of a scanner have stepped: an offset has come, or gone.

The world does not step. What the vehicle nears comes nearer scan by scan. Ground that is grazed in
40 m moves by half a metre when the vehicle rises by 7 mm, and all of it alike, but it mostly does
so in one scan after the other: an offset is a step between scans that hardly change. Where ground
is so far that half a degree a second for one scan moves it as much as an offset, it does step, once
in a hundred miles; there beams do not count.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.messages import LIDAR_NO_RETURN_M, Floats
from nav.parameters.plausibility import StepParameters

EVERY = 4
"""So many beams are enough to see that all have stepped."""


class Seen(NamedTuple):
    """One scan."""

    range_m: Floats
    """Of every fourth beam."""
    way_m: float
    """Driven since the scan before; negative backwards."""


@dataclass
class Steps:
    """Adds up the steps of one scanner."""

    parameters: StepParameters
    height_m: float
    """Of the scanner above the ground."""
    sum_m: float = 0.0
    """Of all steps so far: the offset, if it had none in the beginning."""
    far_m: float = field(init=False)
    """Ground this far ahead, R, comes nearer by R^2 / h for each radian of pitch: by a step."""
    _seen: deque[Seen] = field(default_factory=deque[Seen])
    """The latest, oldest first: as many before a step as after it."""

    def __post_init__(self) -> None:
        p = self.parameters
        self.far_m = sqrt(p.least_m * self.height_m / p.sway_rad)

    def observe(self, range_m: Floats, way_m: float) -> None:
        """Take a scan, shape (n,) [m], and the way since the one before, [m]."""
        seen, beams = self._seen, range_m[::EVERY]
        seen.append(Seen(np.where(beams < self.far_m, beams, LIDAR_NO_RETURN_M), way_m))
        if len(seen) == 2 * self.parameters.quiet_scans:
            self.sum_m += step_m(tuple(seen), self.parameters)
            seen.popleft()


def step_m(seen: Sequence[Seen], p: StepParameters) -> float:
    """By how much all ranges step in the middle of an even number of scans, four at least, [m]; 0
    if they do not, or if they change between other scans, too."""
    middle = len(seen) // 2
    before, after = seen[middle - 1 : middle + 1]
    moved = np.abs(after.range_m - before.range_m) > p.least_m
    if EVERY * np.count_nonzero(moved) < p.beams:  # as nearly always: no need to look closer
        return 0.0
    step = _alike_m(seen[middle - 2 : middle + 2], p)
    if abs(step) < p.least_m:
        return 0.0
    around = [change_m(*pair, p) for pair in pairwise(seen) if pair[1] is not after]
    return step if all(c is not None and abs(c) < p.quiet_m for c in around) else 0.0


def change_m(before: Seen, after: Seen, p: StepParameters) -> float | None:
    """The median change of range that the way does not explain, [m]: what the vehicle nears comes
    nearer by the cosine of its bearing. None where too few beams meet anything."""
    both = _meet(before, after)
    if EVERY * both.size < p.beams or EVERY * (both[-1] - both[0]) < p.span:
        return None
    change = _median((after.range_m - before.range_m)[both])
    nearest, farthest = sorted((-after.way_m, 0.0))
    return change - min(max(change, nearest), farthest)


def _alike_m(four: Sequence[Seen], p: StepParameters) -> float:
    """By how much nearly all ranges change alike in the middle of four scans, beside what each
    changed by just before and changes by just after: there it is the vehicle that moves, [m]."""
    a, b, c, d = (seen.range_m[_meet(*four)] for seen in four)
    if EVERY * a.size < p.beams:
        return 0.0
    step = (c - b) - 0.5 * ((b - a) + (d - c))
    middle = _median(step)
    alike = np.count_nonzero(np.abs(step - middle) < p.alike_m)
    return middle if alike > p.alike_share * step.size else 0.0


def _meet(*seen: Seen) -> NDArray[np.intp]:
    """The beams that meet something in all scans."""
    return np.flatnonzero(np.max([s.range_m for s in seen], axis=0) < LIDAR_NO_RETURN_M)


def _median(values: Floats) -> float:
    """numpy's own takes five times as long."""
    half = values.size // 2
    return float(np.partition(values, half)[half])
