"""Mutants with wrong fuzzy rules: tables upside down, and danger that begins too late."""

from dataclasses import replace
from functools import partial
from operator import attrgetter

from nav.fuzzy.membership import Variable
from nav.fuzzy.rule_base import RuleBase
from nav.navigator import IonNavigator
from scenarios.mutants.mutant import Mutant
from scenarios.mutants.values import rebuilt, with_value

LATER = 0.2
"""Share of a distance at which it means what the whole should."""

_UPSIDE_DOWN = {
    "safe_and_real_swapped": ("Table 6.1 picks the other boundary.", "steering.select"),
    "focus_upside_down": (
        "The farther a direction is from heading and goal, the better.", "steering.focus",
    ),
    "speed_rules_upside_down": (
        "The nearer the obstacle, the faster.", "speed.anti_collision",
    ),
    "turn_rules_upside_down": ("The sharper the turn, the faster.", "speed.safe_steering"),
}  # fmt: skip


def upside_down(base: RuleBase) -> RuleBase:
    """The rules with the least conclusion where the greatest was, and so on."""
    terms = sorted(base.output.terms, key=base.output.terms.__getitem__)
    other = dict(zip(terms, reversed(terms), strict=True))
    return replace(base, rules=tuple(replace(r, then=other[r.then]) for r in base.rules))


def _turned(path: str, navigator: IonNavigator) -> IonNavigator:
    base = upside_down(attrgetter(path)(navigator.parameters))
    return rebuilt(navigator, with_value(navigator.parameters, path, base))


def _fearless(navigator: IonNavigator) -> IonNavigator:
    """All distances of the speed rules shrink: the parameters refuse a D_safe alone of zero."""
    p = navigator.parameters
    base = p.speed.anti_collision
    nearer = {name: _nearer(variable) for name, variable in base.inputs.items()}
    collision = replace(base, inputs=nearer)
    speed = replace(p.speed, safe_distance_m=0.0, anti_collision=collision)
    return rebuilt(navigator, replace(p, speed=speed))


def _nearer(variable: Variable) -> Variable:
    terms = {
        name: replace(term, points=tuple(LATER * x for x in term.points))
        for name, term in variable.terms.items()
    }
    return replace(variable, terms=terms)


RULES = {
    **{name: Mutant(why, partial(_turned, path)) for name, (why, path) in _UPSIDE_DOWN.items()},
    "danger_begins_late": Mutant("D_safe is zero, and the speed rules begin at it.", _fearless),
}
"""By name."""
