"""One figure of the twin beside what is known of it."""

from dataclasses import dataclass
from math import isfinite
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Grade = Literal["measured", "published", "estimated"]


@dataclass(frozen=True, eq=False)
class Curve:
    """What a check looks like: lines over one quantity."""

    x: Floats
    x_label: str
    y_label: str
    lines: dict[str, Floats]
    """By their names, each of the shape of `x`."""
    points: bool = False
    """Whether the values are single ones, not a course of time."""
    log: bool = False
    """Whether both axes are logarithmic."""


class Range(NamedTuple):
    """What was measured or published, with its tolerance."""

    low: float
    high: float
    reference: float | None = None
    """The value itself, where there is one."""


@dataclass(frozen=True, eq=False)
class Check:
    """It holds where the twin's value lies within the range."""

    title: str
    unit: str
    twin: float
    allowed: Range
    grade: Grade
    """Of what the range rests on."""
    source: str
    remark: str = ""
    curve: Curve | None = None

    @property
    def holds(self) -> bool:
        """Whether the twin is as true as asked."""
        return isfinite(self.twin) and self.allowed.low <= self.twin <= self.allowed.high

    @property
    def off(self) -> float | None:
        """How far the twin is off the reference, as a share of it."""
        reference = self.allowed.reference
        return self.twin / reference - 1.0 if reference else None


def within(reference: float, share: float) -> Range:
    """The range of a reference and a share of it either way."""
    spread = abs(reference) * share
    return Range(reference - spread, reference + spread, reference)
