"""A decision as tables for the terminal."""

from collections.abc import Iterator

import numpy as np
from rich.table import Table

from ion.explain.explanation import Explanation
from ion.explain.words import NOT_IN_FORCE, decided, entered, from_heading, known, speed
from nav.states.obstacle_avoidance import Considered

SHOWN = 0.005
"""A weaker rule is left out."""
EVERY = 10
"""Directions in the table of curves: every tenth, and those that were decided."""


def tables(why: Explanation) -> Iterator[Table]:
    """The decision, the curves, the rules; what a state does not have is left out."""
    yield _summary(why)
    if why.considered:
        yield _curves(why, why.considered)
    if why.considered or why.plan.by_rules:
        yield _rules(why)


def _summary(why: Explanation) -> Table:
    grid = Table(title=f"Decision at {why.time_s:.2f} s", show_header=False, title_justify="left")
    grid.add_column()
    grid.add_column(overflow="fold")
    for name, text in _rows(why):
        grid.add_row(name, text)
    return grid


def _rows(why: Explanation) -> Iterator[tuple[str, str]]:
    s, plan, found = why.situation, why.plan, why.considered
    yield "state", entered(why)
    yield "speed set point V_s", speed(why)
    if found:
        decision = found.decision
        yield "theta_D", decided(why) + ("" if why.in_force else f" ({NOT_IN_FORCE})")
        yield "theta_RD", from_heading(why, decision.theta_RD)
        yield "theta_SD", from_heading(why, decision.theta_SD)
        yield "goal phi", from_heading(why, found.goal_rad)
        if why.previous_rad is not None:
            yield "theta_D(k-1)", from_heading(why, why.previous_rad)
        yield "criterion d_CR,R", f"{decision.criterion_real_m:.2f} m"
        yield "criterion d_CR,S", f"{decision.criterion_safe_m:.2f} m"
        yield "exploring EX", f"{decision.situation.exploring:.2f}"
    if not why.in_force:
        yield "the path leads", from_heading(why, plan.decision_rad)
    yield "new local path", plan.replanned or "no, the former one is kept"
    yield "D1, D", f"{plan.D1_m:.1f} m, {plan.D_m:.1f} m"
    yield "v, limit V0", f"{s.ego.speed_mps:.2f} m/s, {s.V0_mps:.2f} m/s"
    yield "ego state", known(why)
    yield "beside the route", f"{s.cross_track_m:+.2f} m, waypoint {s.waypoint} ahead"


def _curves(why: Explanation, found: Considered) -> Table:
    grid = Table(title="Distances in m by direction, in degrees left of the heading")
    for name in ("theta", "D_R", "D_S", "Delta", "D_R-Delta", "D_S-Delta", "in I", "in J", ""):
        grid.add_column(name, justify="right")
    for row in _shown(found):
        grid.add_row(*_cells(why, found, row))
    return grid


def _shown(found: Considered) -> list[int]:
    rows = set(range(0, len(found.theta_rad), EVERY)) | set(_marks(found))
    return sorted(rows, reverse=True)


def _marks(found: Considered) -> dict[int, str]:
    """Rows of the decisions, and their names."""
    decision, marks = found.decision, dict[int, str]()
    named = (("theta_RD", decision.theta_RD), ("theta_SD", decision.theta_SD))
    for name, theta in (*named, ("theta_D", decision.theta_D)):
        row = int(np.argmin(np.abs(found.theta_rad - theta)))
        marks[row] = " ".join((marks.get(row, ""), name)).strip()
    return marks


def _cells(why: Explanation, found: Considered, row: int) -> list[str]:
    decision, far = found.decision, found.distances
    real, safe, less = (float(a[row]) for a in (far.real_m, far.safe_m, decision.deduction_m))
    sets = (decision.candidates_real[row], decision.candidates_safe[row])
    return [
        f"{np.degrees(why.relative_rad[row]):+.1f}",
        *(f"{value:.1f}" for value in (real, safe, less, real - less, safe - less)),
        *("x" if inside else "" for inside in sets),
        _marks(found).get(row, ""),
    ]


def _rules(why: Explanation) -> Table:
    grid = Table(title=f"Rules that fired (from {SHOWN:g} on)", title_justify="left")
    for name in ("", "rule", "strength"):
        grid.add_column(name, overflow="fold")
    rules, found = why.plan.by_rules, why.considered
    for name, strengths in (
        ("Table 6.1", found.decision.select_rules if found else {}),
        ("A", rules.anti_collision_rules if rules else {}),
        ("T", rules.safe_steering_rules if rules else {}),
    ):
        for label, strength in strengths.items():
            if strength >= SHOWN:
                grid.add_row(name, label, f"{strength:.2f}")
    return grid
