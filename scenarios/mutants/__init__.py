"""Deliberately broken navigators: a verdict that no mutant fails is worth nothing."""

from scenarios.episode import Episode
from scenarios.mutants.acting import ACTING
from scenarios.mutants.believing import BELIEVING
from scenarios.mutants.deciding import DECIDING
from scenarios.mutants.hearing import HEARING
from scenarios.mutants.mutant import Mutant
from scenarios.mutants.remembering import REMEMBERING
from scenarios.mutants.rules import RULES
from scenarios.mutants.values import VALUES

__all__ = ["MUTANTS", "Mutant", "mutated"]

MUTANTS: dict[str, Mutant] = {
    **HEARING, **ACTING, **VALUES, **RULES, **BELIEVING, **REMEMBERING, **DECIDING,
}  # fmt: skip
"""By name, in a fixed order."""


def mutated(episode: Episode, name: str) -> Episode:
    """The episode, which has not begun, with a broken navigator.

    Raises:
        ValueError: an unknown mutant; lists those that exist.
    """
    if name not in MUTANTS:
        raise ValueError(f"{name!r}: no such mutant; known are {', '.join(MUTANTS)}")
    episode.navigator = MUTANTS[name].make(episode.navigator)
    return episode
