"""What the parameters of both fuzzy controllers have in common."""

from nav.errors import NavError
from nav.fuzzy.rule_base import RuleBase


def expect_inputs(base: RuleBase, where: str, names: tuple[str, ...]) -> None:
    """Refuse a rule base whose inputs are not those that its controller gives.

    Raises:
        NavError: other names, or another order.
    """
    if tuple(base.inputs) != names:
        found = ", ".join(base.inputs)
        raise NavError(f"{where}.inputs: are {found}; expected {', '.join(names)}, in this order")
