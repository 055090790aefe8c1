"""Inference: rules fire by max of min; singletons are averaged (Takagi-Sugeno) or one is picked."""

from collections.abc import Mapping

import numpy as np

from nav.fuzzy.rule_base import RuleBase
from nav.fuzzy.tables import fire
from nav.messages import Floats


def strengths(base: RuleBase, inputs: Mapping[str, Floats | float]) -> Floats:
    """Strength of each rule for each set of inputs.

    Args:
        base: the rule base.
        inputs: by name, each of shape (n,) or one number; beyond its range it saturates.

    Returns:
        Shape (rules, n), 0 to 1; for numbers only, n is 1.
    """
    rows = [np.asarray(inputs[name], dtype=np.float64) for name in base.inputs]
    x = np.empty((len(rows), max(row.size for row in rows)))
    for i, row in enumerate(rows):
        x[i] = row
    return fire(base.tables, x)


def activations(base: RuleBase, strength: Floats) -> Floats:
    """Strength of each output term, shape (terms, n): the strongest rule that concludes it."""
    tables = base.tables
    return np.maximum.reduceat(strength.take(tables.by_output, axis=0), tables.output_start, axis=0)


def average(base: RuleBase, strength: Floats) -> Floats:
    """The output by weighted average of singletons, shape (n,), in the output's unit."""
    active = activations(base, strength)
    return (base.tables.values * active).sum(axis=0) / active.sum(axis=0)


def infer(base: RuleBase, inputs: Mapping[str, Floats | float]) -> Floats:
    """The averaged output for inputs, shape (n,)."""
    return average(base, strengths(base, inputs))


def pick(base: RuleBase, strength: Floats) -> str:
    """The strongest output term, never a blend; on a tie the first in the file.

    Args:
        base: the rule base.
        strength: shape (rules, 1).
    """
    return list(base.output.terms)[int(activations(base, strength)[:, 0].argmax())]


def explain(base: RuleBase, strength: Floats) -> dict[str, float]:
    """Each rule in words with its strength, from shape (rules, 1)."""
    return dict(zip(base.labels, strength[:, 0].tolist(), strict=True))
