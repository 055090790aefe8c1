"""The fuzzy variables in the texts of parameter files: found, and changed in place.

Only the numbers change: comments and layout stay as people wrote them.
"""

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from nav.fuzzy.rule_base import RuleBase
from nav.parameters import ION, Parameters

CONTROLLERS = {
    "steering": ("situation", "focus", "persistence", "select"),
    "speed": ("anti_collision", "safe_steering"),
}
"""Table of the parameters to its rule bases."""
OUTPUT = "output"
NUMBER = r"[-+]?[\d.]+(?:e[-+]?\d+)?"


class Place(NamedTuple):
    """Where a fuzzy variable stands."""

    controller: str
    base: str
    variable: str
    """Name of an input, or `output`."""

    def __str__(self) -> str:
        return f"{self.controller}: {self.base}, {self.variable}"


Texts = dict[str, str]
Points = tuple[float, ...]


def places(p: Parameters) -> Iterator[Place]:
    """All fuzzy variables, in the order of the files."""
    for controller, names in CONTROLLERS.items():
        for name in names:
            base = rule_base(p, controller, name)
            yield from (Place(controller, name, variable) for variable in (*base.inputs, OUTPUT))


def rule_base(p: Parameters, controller: str, name: str) -> RuleBase:
    """One of the rule bases of a controller."""
    return getattr(getattr(p, controller), name)


def points_of(p: Parameters, place: Place) -> dict[str, Points]:
    """The breakpoints of each term; of an output term its one value."""
    base = rule_base(p, place.controller, place.base)
    if place.variable == OUTPUT:
        return {name: (value,) for name, value in base.output.terms.items()}
    return {name: term.points for name, term in base.inputs[place.variable].terms.items()}


def range_of(p: Parameters, place: Place) -> tuple[float, float]:
    """Between what its points lie."""
    base = rule_base(p, place.controller, place.base)
    of_input = place.variable != OUTPUT
    return base.inputs[place.variable].range if of_input else base.output.range


def turned(
    texts: Mapping[str, str], vehicle: str, place: Place, term: str, points: Points
) -> Texts:
    """The texts with other points of one term; the vehicle's own file goes first.

    Raises:
        KeyError: no file says them.
    """
    table = f"{place.base}.{place.variable}"
    if place.variable != OUTPUT:
        table = f"{place.base}.inputs.{place.variable}.terms"
    own = [] if vehicle == ION else [(f"{vehicle}.toml", f"{place.controller}.{table}")]
    for name, section in (*own, (f"{place.controller}.toml", table)):
        if changed := _changed(texts[name], section, place, term, points):
            return {**texts, name: changed}
    raise KeyError(f"{place}: {term}")


def _changed(text: str, section: str, place: Place, term: str, points: Points) -> str:
    """The text with other points, or nothing where that section does not say them."""
    head = re.search(rf"^\[{re.escape(section)}\].*\n", text, re.MULTILINE)
    if not head:
        return ""
    end = re.search(r"^\[", text[head.end() :], re.MULTILINE)
    stop = head.end() + end.start() if end else len(text)
    body, count = _pattern(place, term).subn(
        lambda match: match[1] + _written(place, points), text[head.end() : stop], count=1
    )
    return text[: head.end()] + body + text[stop:] if count else ""


def _pattern(place: Place, term: str) -> re.Pattern[str]:
    """What stands before the numbers of a term, and the numbers."""
    if place.variable == OUTPUT:
        return re.compile(rf"^(terms\s*=\s*\{{.*?\b{re.escape(term)}\s*=\s*){NUMBER}", re.MULTILINE)
    return re.compile(rf"^({re.escape(term)}\s*=\s*\{{.*?points\s*=\s*)\[[^\]]*\]", re.MULTILINE)


def _written(place: Place, points: Points) -> str:
    numbers = [repr(round(float(point), 6)) for point in points]
    return numbers[0] if place.variable == OUTPUT else f"[{', '.join(numbers)}]"
