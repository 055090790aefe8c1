"""What a figure of a drive must be, and whether it is: a verdict."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import msgspec

TABLES = ("states",)
"""Figures that hold figures: `states.alarm`; what is not in one is 0."""


class Bound(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """All that is said must hold."""

    least: float | None = None
    most: float | None = None
    has: tuple[str, ...] = ()
    """Of a figure that lists words: all of these ..."""
    lacks: tuple[str, ...] = ()
    """... and none of these."""

    def __post_init__(self) -> None:
        if self.least is None and self.most is None and not self.has and not self.lacks:
            raise ValueError("expected one of least, most, has, lacks")

    def holds(self, value: Any) -> bool:
        """Of a figure that was measured."""
        if self.has or self.lacks or isinstance(value, list):
            return self.least is None and self.most is None and self._names(value)
        enough = self.least is None or value >= self.least
        return enough and (self.most is None or value <= self.most)

    def _names(self, value: Any) -> bool:
        if not isinstance(value, list):
            return False
        return all(word in value for word in self.has) and not any(w in value for w in self.lacks)

    def __str__(self) -> str:
        said = (("at least", self.least), ("at most", self.most))
        words = [f"{how} {limit:g}" for how, limit in said if limit is not None]
        words += [f"with {word}" for word in self.has] + [f"without {word}" for word in self.lacks]
        return ", ".join(words)


Expected = Bound | str | bool | int | float
"""A bound, or exactly this."""


class Verdict(NamedTuple):
    """Whether one figure is as it must be."""

    figure: str
    passed: bool
    value: Any
    """None: not measured, which passes nothing."""
    expected: str


def judged(figures: Mapping[str, Any], expected: Mapping[str, Expected]) -> list[Verdict]:
    """All verdicts on a drive, in the order of `expected`.

    Raises:
        KeyError: there is no such figure.
    """
    return [_verdict(name, figure(figures, name), bound) for name, bound in expected.items()]


def figure(figures: Mapping[str, Any], name: str) -> Any:
    """One figure by its name.

    Raises:
        KeyError: there is none.
    """
    table, dot, key = name.partition(".")
    return figures[table].get(key, 0.0) if dot and table in TABLES else figures[name]


def _verdict(name: str, value: Any, bound: Expected) -> Verdict:
    if isinstance(bound, Bound):
        return Verdict(name, value is not None and bound.holds(value), value, str(bound))
    return Verdict(name, value == bound, value, str(bound))
