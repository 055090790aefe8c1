"""Fig. 6.7 for the moment shown: scanning distances, what is left of them, and what was decided."""

from typing import Any

import numpy as np
import viser
from viser import uplot

from ion.explain.numbers import Numbers
from ion.style import DECIDED, GOAL, REAL, SAFE
from ion.view.decide.decisions import Found
from nav.angles import wrapped
from nav.messages import Floats

HEIGHT_PX = 230
DASH = (6.0, 4.0)
CURVES = (
    ("D_R", "distance_real_m", REAL, 1.0), ("D_S", "distance_safe_m", SAFE, 1.0),
    ("D_R - Δ", "adjusted_real_m", REAL, 2.5), ("D_S - Δ", "adjusted_safe_m", SAFE, 2.5),
)  # fmt: skip
"""Label, key, colour, width."""
TUNED = CURVES[2:]
"""What other terms change."""
MARKS = (
    ("goal φ", "goal_rad", GOAL, 1.0), ("θ_RD", "decision_real_rad", REAL, 1.0),
    ("θ_SD", "decision_safe_rad", SAFE, 1.0), ("θ_D", "decision_rad", DECIDED, 2.5),
)  # fmt: skip
SETS = (("I", "candidates_real", REAL, 5.0), ("J", "candidates_safe", SAFE, 5.0))
"""The candidate sets, as bars below the curves; what is within a criterion of the best."""
BELOW_M = 1.2
EDGE = 1e-6
"""Between the two ends of an upright line, [deg]: x must increase."""


class DecisionPlot:
    """Draws it into what is open when it is made; what other terms make of it is dashed."""

    def __init__(self, gui: viser.GuiApi) -> None:
        was = [_series(*c[:1], *c[2:]) for c in (*CURVES, *MARKS, *SETS)]
        would = [_series(f"{c[0]}, tuned", *c[2:], dash=DASH) for c in (*TUNED, MARKS[-1])]
        series = (uplot.Series(label="deg"), *was, *would)
        x = np.array([-90.0, 90.0])
        self._count = len(series) - 1
        self._plot = gui.add_uplot(
            (x, *[np.full(2, np.nan)] * self._count),
            series,
            title="D(θ) and D - Δ [m] by direction [deg]: left -, right +",
            scales=_scales(0.0, 30.0),
            legend=uplot.Legend(show=True, live=False),
            padding=(10, 14, 0, 0),
            height=HEIGHT_PX,
        )

    def show(self, found: Found) -> None:
        """Draw a decision; of a state that asks no steering controller only its direction."""
        tables = [found.was, found.would or {}]
        marks = [[_aside(n, n.get(key)) for _, key, *_ in MARKS] for n in tables]
        curves = [_curve(found.was, key) for _, key, *_ in CURVES]
        tuned = [_curve(tables[1], key) for _, key, *_ in TUNED]
        low, high = _limits([*curves, *tuned])
        ends = [np.array([at, at + EDGE]) for at in (*marks[0], marks[1][-1]) if at is not None]
        x = np.unique(np.concatenate([c[0] for c in curves if c is not None] + ends or [[-90.0]]))
        rows = [_over(c, x) for c in curves]
        rows += [_upright(at, x, low, high) for at in marks[0]]
        rows += [
            _bar(found.was, key, x, low - (1 + k) * BELOW_M) for k, (_, key, *_) in enumerate(SETS)
        ]
        rows += [_over(c, x) for c in tuned] + [_upright(marks[1][-1], x, low, high)]
        low -= (1 + len(SETS)) * BELOW_M
        self._plot.data = (x, *rows)
        self._plot.scales = _scales(low, high)


def _series(label: str, color: str, width: float, dash: Any = None) -> uplot.Series:
    look = {"dash": dash} if dash else {}
    return uplot.Series(label=label, stroke=color, width=width, **look)


def _curve(n: Numbers, key: str) -> tuple[Floats, Floats] | None:
    """Directions as drawn, ascending, [deg], and a value each; None where there is none."""
    if n.get("theta_rad") is None or n.get(key) is None:
        return None
    degrees = -np.degrees(np.array(n["theta_rad"]) - n["heading_rad"])
    return degrees[::-1], np.array(n[key], float)[::-1]


def _aside(n: Numbers, theta_rad: float | None) -> float | None:
    """A direction as drawn, [deg]."""
    return None if theta_rad is None else -float(np.degrees(wrapped(theta_rad - n["heading_rad"])))


def _bar(n: Numbers, key: str, x: Floats, height_m: float) -> Floats:
    """A candidate set: a level line where a direction is in it."""
    inside = _curve(n, key)
    if inside is None:
        return np.full(len(x), np.nan)
    at = np.clip(np.searchsorted(inside[0], x), 0, len(inside[0]) - 1)
    return np.where(inside[1][at] > 0.0, height_m, np.nan)


def _over(curve: tuple[Floats, Floats] | None, x: Floats) -> Floats:
    if curve is None:
        return np.full(len(x), np.nan)
    return np.interp(x, *curve, np.nan, np.nan)


def _upright(at: float | None, x: Floats, low: float, high: float) -> Floats:
    line = np.full(len(x), np.nan)
    if at is not None:
        k = int(np.searchsorted(x, at))
        line[k], line[k + 1] = low, high
    return line


def _limits(curves: list[tuple[Floats, Floats] | None]) -> tuple[float, float]:
    values = [c[1] for c in curves if c is not None]
    if not values:
        return 0.0, 30.0
    return min(0.0, *(float(v.min()) for v in values)), max(float(v.max()) for v in values)


def _scales(low: float, high: float) -> dict[str, uplot.Scale]:
    return {
        "x": uplot.Scale(time=False, auto=False, range=(-90.0, 90.0)),
        "y": uplot.Scale(auto=False, range=(low, high * 1.05 + 0.1)),
    }
