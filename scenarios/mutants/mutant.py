"""A mutant: a navigator with one deliberate fault, to see whether what judges drives notices it."""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from nav.navigator import IonNavigator

Kind = TypeVar("Kind")


class Mutant(NamedTuple):
    """One fault, of the kind that a programmer or a mechanic makes."""

    sentence: str
    """What is broken."""
    make: Callable[[IonNavigator], IonNavigator]
    """Takes a healthy navigator before its first call; it is used up."""


def remade(kind: type[Kind], healthy: object, **more: Any) -> Kind:
    """What is healthy, as one of `kind`, a subclass of its own, with all that it holds and `more`.

    A subclass, so that whoever asks a navigator something still can, and so that it pickles.
    """
    made = object.__new__(kind)
    vars(made).update(vars(healthy), **more)
    return made
