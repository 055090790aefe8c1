"""A rule base compiled to arrays, so that all directions are evaluated at once."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.fuzzy.membership import Variable, memberships
from nav.fuzzy.rules import Output, Rule
from nav.messages import Floats

Indices = NDArray[np.intp]


class Tables(NamedTuple):
    """Index arrays over t terms of all inputs, w conditions at most, a alternatives, r rules."""

    flanks: Floats
    """Shape (4, t, 1)."""
    term_input: Indices
    """Shape (t,), the input that a term looks at."""
    limits: Floats
    """Shape (2, inputs, 1), where inputs saturate."""
    conditions: tuple[Indices, ...]
    """w of shape (a,), rows of the memberships; row t is 1 everywhere, for "whatever it is"."""
    rule_start: Indices
    """Shape (r,), each rule's first alternative."""
    by_output: Indices
    """Shape (r,), rules sorted by what they conclude."""
    output_start: Indices
    """Shape (o,), each output term's first rule in `by_output`."""
    values: Floats
    """Shape (o, 1), the output's singletons."""


def compile_tables(inputs: dict[str, Variable], output: Output, rules: tuple[Rule, ...]) -> Tables:
    """Arrays of a rule base whose names are known to be right and all used."""
    terms = [(name, term) for name, variable in inputs.items() for term in variable.terms]
    row = {term: i for i, term in enumerate(terms)}
    alternatives = [way for rule in rules for way in rule.when]
    width = max(len(way) for way in alternatives)
    conditions = np.full((width, len(alternatives)), len(row), dtype=np.intp)
    for a, way in enumerate(alternatives):
        conditions[: len(way), a] = [row[condition] for condition in way.items()]
    concluded = np.array([list(output.terms).index(rule.then) for rule in rules])
    by_output = np.argsort(concluded, kind="stable")
    return Tables(
        flanks=np.concatenate([v.flanks for v in inputs.values()], axis=1),
        term_input=np.repeat(np.arange(len(inputs)), [len(v.terms) for v in inputs.values()]),
        limits=np.array([v.range for v in inputs.values()]).T[:, :, None],
        conditions=tuple(conditions),
        rule_start=np.cumsum([0] + [len(rule.when) for rule in rules[:-1]]),
        by_output=by_output,
        output_start=np.searchsorted(concluded[by_output], np.arange(len(output.terms))),
        values=np.array(list(output.terms.values()))[:, None],
    )


def fire(tables: Tables, x: Floats) -> Floats:
    """Strength of each rule: the best alternative's weakest condition (max of min).

    Args:
        tables: the compiled rule base.
        x: shape (inputs, n).

    Returns:
        Shape (r, n), 0 to 1.
    """
    low, high = tables.limits
    x = np.minimum(np.maximum(x, low), high)
    count = len(tables.term_input)
    members: Floats = np.empty((count + 1, x.shape[1]))
    members[:count] = memberships(tables.flanks, x.take(tables.term_input, axis=0))
    members[count] = 1.0
    first, *others = tables.conditions
    strength = members.take(first, axis=0)
    for rows in others:
        np.minimum(strength, members.take(rows, axis=0), out=strength)
    return np.maximum.reduceat(strength, tables.rule_start, axis=0)
