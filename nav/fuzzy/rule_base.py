"""A rule base as data, and everything that is refused about one before it decides anything."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nav.errors import NavError
from nav.fuzzy.membership import NOTHING, Variable, memberships
from nav.fuzzy.rules import Output, Rule
from nav.fuzzy.tables import Tables, compile_tables, fire


@dataclass(frozen=True)
class RuleBase:
    """Inputs, one output, and rules between them; built from TOML by `from_toml`.

    Raises:
        NavError: a rule names an unknown input or term, a term is never used, or some
            combination of inputs fires no rule.
    """

    inputs: dict[str, Variable]
    output: Output
    rules: tuple[Rule, ...]

    def __post_init__(self) -> None:
        if not self.inputs or not self.rules:
            raise NavError("a rule base needs at least one input and one rule")
        for i, rule in enumerate(self.rules):
            self._refuse_unknown(rule, f"rules[{i}]")
        self._refuse_unused()
        self._refuse_silence()

    @cached_property
    def tables(self) -> Tables:
        """The rule base as arrays, compiled once."""
        return compile_tables(self.inputs, self.output, self.rules)

    @cached_property
    def labels(self) -> tuple[str, ...]:
        """Each rule in words."""
        return tuple(rule.label for rule in self.rules)

    def _refuse_unknown(self, rule: Rule, where: str) -> None:
        for name, term in (condition for way in rule.when for condition in way.items()):
            if name not in self.inputs:
                raise _unknown(f"{where}.when", "input", name, self.inputs)
            if term not in self.inputs[name].terms:
                raise _unknown(f"{where}.when.{name}", "term", term, self.inputs[name].terms)
        if rule.then not in self.output.terms:
            raise _unknown(f"{where}.then", "term", rule.then, self.output.terms)

    def _refuse_unused(self) -> None:
        used = {item for rule in self.rules for way in rule.when for item in way.items()}
        for name, variable in self.inputs.items():
            for term in variable.terms:
                if (name, term) not in used:
                    raise NavError(f"inputs.{name}.terms.{term}: no rule uses it")
        for term in self.output.terms:
            if term not in {rule.then for rule in self.rules}:
                raise NavError(f"output.terms.{term}: no rule concludes it")

    def _refuse_silence(self) -> None:
        """Between breakpoints the set of active terms is constant: these places are enough."""
        axes = [variable.places() for variable in self.inputs.values()]
        x = np.stack([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")])
        silent = fire(self.tables, x).max(axis=0) <= NOTHING
        if silent.any():
            places = dict(zip(self.inputs, x[:, silent.argmax()].tolist(), strict=True))
            at = ", ".join(f"{n} = {v:g} ({self._terms_at(n, v)})" for n, v in places.items())
            raise NavError(f"rules: none fires at {at}; add a rule")

    def _terms_at(self, name: str, value: float) -> str:
        variable = self.inputs[name]
        members = memberships(variable.flanks, np.array([value]))[:, 0]
        return "/".join(t for t, m in zip(variable.terms, members, strict=True) if m > NOTHING)


def _unknown(where: str, kind: str, name: str, known: Iterable[str]) -> NavError:
    return NavError(f"{where}: {name!r} is an unknown {kind}; known are {', '.join(known)}")
