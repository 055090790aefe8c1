"""Fuzzy sets over one input: triangles, trapezoids and shoulders, evaluated over arrays."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nav.errors import NavError
from nav.messages import Floats

POINTS = {"triangle": 3, "trapezoid": 4, "left_shoulder": 2, "right_shoulder": 2}
"""How many breakpoints each shape has. A left shoulder is full below its first."""
NOTHING = 1e-9
"""A membership or a strength up to here counts as none."""


@dataclass(frozen=True)
class Term:
    """One fuzzy set. Its breakpoints carry the unit of the variable's name."""

    shape: str
    points: tuple[float, ...]

    def __post_init__(self) -> None:
        if self.shape not in POINTS:
            raise NavError(f"shape: {self.shape!r} is unknown; known are {', '.join(POINTS)}")
        if len(self.points) != POINTS[self.shape]:
            count = POINTS[self.shape]
            raise NavError(f"points: a {self.shape} has {count} points, not {len(self.points)}")
        if not np.isfinite(self.points).all():
            raise NavError(f"points: {list(self.points)} must be finite")
        if not (np.diff(self.points) > 0.0).all():
            raise NavError(f"points: {list(self.points)} must increase strictly")


@dataclass(frozen=True)
class Variable:
    """An input: its range, beyond which values saturate, and the fuzzy sets that cover it."""

    range: tuple[float, float]
    terms: dict[str, Term]

    def __post_init__(self) -> None:
        low, high = self.range
        if not (np.isfinite(self.range).all() and low < high):
            raise NavError(f"range: {list(self.range)} must be finite and increase")
        for name, term in self.terms.items():
            if term.points[0] < low or term.points[-1] > high:
                raise NavError(
                    f"terms.{name}: points {list(term.points)} lie outside the range "
                    f"{list(self.range)}"
                )
        self._refuse_hole()

    def _refuse_hole(self) -> None:
        places = self.places()
        covered = memberships(self.flanks, places) > NOTHING
        if not covered.any(axis=0).all():
            hole = places[~covered.any(axis=0)][0]
            names = ", ".join(self.terms)
            raise NavError(f"terms: none of {names} has a member at {hole:g}; close the hole")

    @cached_property
    def flanks(self) -> Floats:
        """Shape (4, terms, 1): where a set starts, 1/length of its rise, its end, 1/its fall."""
        corners = [_corners(term, *self.range) for term in self.terms.values()]
        a, b, c, d = np.array(corners).reshape(-1, 4).T
        return np.stack([a, 1.0 / (b - a), d, 1.0 / (d - c)])[:, :, None]

    @cached_property
    def breakpoints(self) -> tuple[float, ...]:
        """All breakpoints of all sets, each once, in increasing order."""
        return tuple(np.unique([p for term in self.terms.values() for p in term.points]).tolist())

    def places(self) -> Floats:
        """Every breakpoint and a place between each two: where memberships can differ in kind."""
        edges = np.unique([*self.range, *self.breakpoints])
        return np.sort(np.concatenate([edges, 0.5 * (edges[1:] + edges[:-1])]))


def _corners(term: Term, low: float, high: float) -> tuple[float, ...]:
    """Every set is a trapezoid; a shoulder is one whose other flank lies outside the range."""
    p = term.points
    if term.shape == "left_shoulder":
        return (low - 2.0, low - 1.0, p[0], p[1])
    if term.shape == "right_shoulder":
        return (p[0], p[1], high + 1.0, high + 2.0)
    return (p[0], p[1], p[1], p[2]) if term.shape == "triangle" else p


def memberships(flanks: Floats, x: Floats) -> Floats:
    """Membership of each value in each set.

    Args:
        flanks: shape (4, t, 1), of `Variable.flanks`.
        x: shape (n,), or (t, n) where each set looks at its own values.

    Returns:
        Shape (t, n), 0 to 1.
    """
    start, rise, end, fall = flanks
    members = (x - start) * rise
    np.minimum(members, (end - x) * fall, out=members)
    np.minimum(members, 1.0, out=members)
    return np.maximum(members, 0.0, out=members)
