"""How a scenario varies a number from seed to seed."""

from math import exp, log
from statistics import NormalDist
from typing import Any

import msgspec

from scenarios.things import generator

Number = bool | int | float | str
SIGMAS = 3.0
"""Farther from its mean no quantile of a normal distribution lies."""


class Distribution(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Exactly one of these."""

    uniform: tuple[float, float] | None = None
    """From, to."""
    log_uniform: tuple[float, float] | None = None
    """From, to, both above 0: each ratio is as likely."""
    normal: tuple[float, float] | None = None
    """Mean and standard deviation."""
    choice: tuple[Number, ...] | None = None
    """One of these, each as likely."""

    def __post_init__(self) -> None:
        kinds = self.__struct_fields__
        if sum(getattr(self, kind) is not None for kind in kinds) != 1:
            raise ValueError(f"expected one of {', '.join(kinds)}")
        for low, high in filter(None, (self.uniform, self.log_uniform)):
            if not low < high:
                raise ValueError(f"expected [from, to], found [{low:g}, {high:g}]")
        if self.log_uniform and self.log_uniform[0] <= 0.0:
            raise ValueError("log_uniform: expected numbers above 0")
        if self.normal and self.normal[1] <= 0.0:
            raise ValueError("normal: expected [mean, standard deviation above 0]")
        if self.choice == ():
            raise ValueError("choice: expected at least one value")


Varied = Distribution | bool | int | float | str
"""A distribution, or always this."""


def draw(name: str, varied: Varied, seed: int) -> Number:
    """The value of one name for a seed; others do not change it."""
    if not isinstance(varied, Distribution):
        return varied
    rng: Any = generator(seed, f"vary_{name}")
    if varied.uniform:
        return float(rng.uniform(*varied.uniform))
    if varied.log_uniform:
        low, high = varied.log_uniform
        return exp(float(rng.uniform(log(low), log(high))))
    if varied.normal:
        return float(rng.normal(*varied.normal))
    assert varied.choice
    return varied.choice[int(rng.integers(len(varied.choice)))]


def quantile(varied: Distribution, share: float) -> Number:
    """The value below which a share of all draws lies, 0 to 1; a choice is in the order of its
    values, and a normal distribution ends at three standard deviations."""
    if varied.uniform:
        low, high = varied.uniform
        return low + share * (high - low)
    if varied.log_uniform:
        low, high = varied.log_uniform
        return low * (high / low) ** share
    if varied.normal:
        tail = NormalDist().cdf(-SIGMAS)
        return NormalDist(*varied.normal).inv_cdf(tail + share * (1.0 - 2.0 * tail))
    assert varied.choice
    return varied.choice[min(int(share * len(varied.choice)), len(varied.choice) - 1)]


def values_of(varied: Varied) -> tuple[Number, ...]:
    """Values that it may have, of each kind: to be checked."""
    if not isinstance(varied, Distribution):
        return (varied,)
    return varied.choice or varied.uniform or varied.log_uniform or (varied.normal or ())[:1]
