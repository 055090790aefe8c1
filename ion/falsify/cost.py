"""How far a drive is from failing: one number to go down, below 0 exactly if a verdict fails.

Each verdict has a margin: of a bound on a number, the distance to it as a share of the bound (of a
bound of 0, the distance itself), pressed between -1 and 1 so that no figure outshouts the others;
of a word, a list or an exact number, 1 where it is right. The least of them counts. Who passes is
also no farther from failing than from the nearest obstacle: where nothing but `outcome` or
`contacts` is asked, the clearance is what leads there.
"""

from collections.abc import Mapping
from typing import Any

from scenarios.bounds import Bound, Expected, figure

CLEARANCES = ("min_clearance_m", "gate_clearance_m", "tunnel_clearance_m")


def cost(figures: Mapping[str, Any], expected: Mapping[str, Expected]) -> float:
    """Of a drive, -1 to 1.

    Raises:
        KeyError: there is no such figure.
    """
    worst = min(margin(figure(figures, name), bound) for name, bound in expected.items())
    return worst if worst < 0.0 else min(worst, _pressed(clearance_m(figures)))


def clearance_m(figures: Mapping[str, Any]) -> float:
    """To the nearest obstacle of any kind, [m]; a metre more than far where there is none."""
    measured = [figures[name] for name in CLEARANCES if figures.get(name) is not None]
    return max(min(measured, default=FAR_M), 0.0)


FAR_M = 15.0
"""Beyond this clearance is only a lower bound; see `scenarios.verdicts.clearance`."""


def margin(value: Any, expected: Expected) -> float:
    """Of one verdict, -1 to 1, below 0 exactly if it fails."""
    if value is None:
        return -1.0
    if not isinstance(expected, Bound):
        return 1.0 if value == expected else _beside(value, expected)
    if isinstance(value, list) or expected.has or expected.lacks:
        return 1.0 if expected.holds(value) else -1.0
    sides = ((expected.least, 1.0), (expected.most, -1.0))
    return min(_beyond(value, limit, sign) for limit, sign in sides if limit is not None)


def _beyond(value: float, limit: float, sign: float) -> float:
    return _pressed(sign * (value - limit) / (abs(limit) or 1.0))


def _beside(value: Any, expected: Any) -> float:
    """Of a verdict that failed."""
    numbers = isinstance(value, int | float) and isinstance(expected, int | float)
    return -_pressed(abs(value - expected)) if numbers else -1.0


def _pressed(x: float) -> float:
    return x / (1.0 + abs(x))
