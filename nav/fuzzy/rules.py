"""Fuzzy rules as data: conditions on inputs' terms, one conclusion."""

from dataclasses import dataclass

import numpy as np

from nav.errors import NavError


@dataclass(frozen=True)
class Rule:
    """If any alternative holds then the output is `then`; within an alternative all must hold."""

    when: tuple[dict[str, str], ...]
    """Alternatives, each of input -> term."""
    then: str
    source: str = ""
    """Where the rule comes from, when that is not the paper as it stands."""

    def __post_init__(self) -> None:
        if not self.when or not all(self.when):
            raise NavError("when: needs at least one alternative, each with a condition")

    @property
    def label(self) -> str:
        """The rule in words: `D1_m is M and D_m is S -> MS`."""
        ways = [" and ".join(f"{v} is {t}" for v, t in way.items()) for way in self.when]
        return f"{' or '.join(ways)} -> {self.then}"


@dataclass(frozen=True)
class Output:
    """What rules conclude: singletons, in the unit of the output's name."""

    name: str
    range: tuple[float, float]
    terms: dict[str, float]
    """In order of preference: where two are picked with equal strength the first one wins."""

    def __post_init__(self) -> None:
        low, high = self.range
        if not (np.isfinite(self.range).all() and low < high):
            raise NavError(f"range: {list(self.range)} must be finite and increase")
        for term, value in self.terms.items():
            if not low <= value <= high:
                raise NavError(f"terms.{term}: {value:g} lies outside the range {list(self.range)}")
