"""The steering fuzzy controller of section 6.4.2.1: equations (6.5), (6.6) and Table 6.1.

All angles of one call are in one frame, whichever it is, counter-clockwise.
"""

from dataclasses import dataclass
from math import inf, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.fuzzy.inference import explain, pick, strengths
from nav.messages import Floats
from nav.parameters.fuzzy import SteeringParameters
from nav.planning.focus import Situation, angle_between, breakpoints, deduction, situation

TIE_RAD = 1e-9
"""Angles that differ by less are tied: rounding decides nothing."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class SteeringDecision:
    """theta_D(k) and all that led to it: the numbers of Fig. 6.7. Angles in [rad]."""

    situation: Situation
    """S(k) of (6.7)."""
    breakpoints_rad: tuple[float, ...]
    """The effective (a, b, c, d) of the focus rules."""
    deduction_m: Floats
    """Shape (n,), Delta(theta)."""
    criterion_real_m: float
    """d_CR,R(k)."""
    criterion_safe_m: float
    """d_CR,S(k)."""
    candidates_real: Mask
    """Shape (n,), the set I(k)."""
    candidates_safe: Mask
    """Shape (n,), the set J(k)."""
    theta_RD: float  # noqa: N815
    """The decision on the real boundary."""
    theta_SD: float  # noqa: N815
    """The decision on the safe boundary."""
    theta_D: float  # noqa: N815
    """The one that was selected."""
    selected: str
    """`safe` or `real`."""
    select_rules: dict[str, float]
    """Strength of each cell of Table 6.1, and of what was added to it, in words."""


class Aim(NamedTuple):
    """The directions that all others are compared with; none need lie among those scanned."""

    heading_rad: float
    """theta(k)."""
    goal_rad: float
    """phi(k)."""
    previous_rad: float | None
    """theta_D(k-1), or None where there was none."""
    reach_m: float = inf
    """Distance to the goal point: no direction need be free for longer."""


class _Choice(NamedTuple):
    """Equations (6.5) and (6.6) on one boundary."""

    criterion_m: float
    candidates: Mask
    row: int


def decide(
    theta_rad: Floats,
    distance_real_m: Floats,
    distance_safe_m: Floats,
    aim: Aim,
    speed_mps: float,
    V0_mps: float,
    parameters: SteeringParameters,
) -> SteeringDecision:
    """The direction nearest to the goal that has distance enough, equations (6.5) to (6.7).

    Args:
        theta_rad: shape (n,), directions; the decision is one of them.
        distance_real_m, distance_safe_m: shape (n,), D_R(theta) and D_S(theta), finite.
        aim: heading, goal and previous decision.
        speed_mps, V0_mps: v(k) and the speed limit.
        parameters: `steering.toml`.
    """
    S = situation(speed_mps, V0_mps, parameters)
    delta = deduction(theta_rad, *aim[:3], S.stretch, parameters)

    def choose(distance_m: Floats, limit_m: float) -> _Choice:
        limit_m = min(limit_m, aim.reach_m)
        criterion, among = candidates(distance_m - delta, limit_m, parameters.criterion.epsilon_m)
        return _Choice(criterion, among, nearest(theta_rad, among, aim.goal_rad, aim.previous_rad))

    real = choose(distance_real_m, parameters.criterion.real_m)
    safe = choose(distance_safe_m, parameters.criterion.safe_m)
    theta_RD, theta_SD = float(theta_rad[real.row]), float(theta_rad[safe.row])
    open_m = float(distance_safe_m[safe.row])
    strength = select_strengths(theta_RD, theta_SD, aim.goal_rad, open_m, parameters)
    selected = pick(parameters.select, strength)
    theta_D = theta_SD if selected == "safe" else theta_RD
    return SteeringDecision(
        S, breakpoints(S.stretch, parameters), delta,
        real.criterion_m, safe.criterion_m, real.candidates, safe.candidates,
        theta_RD, theta_SD, theta_D, selected, explain(parameters.select, strength),
    )  # fmt: skip


def candidates(adjusted_m: Floats, limit_m: float, epsilon_m: float) -> tuple[float, Mask]:
    """d_CR(k) and the candidate set of equation (6.5).

    Args:
        adjusted_m: shape (n,), D(theta) - Delta(theta).
        limit_m: d0_CR.
        epsilon_m: keeps the set nonempty.
    """
    criterion = min(limit_m, float(adjusted_m.max()) - epsilon_m)
    return criterion, adjusted_m > criterion


def nearest(theta_rad: Floats, among: Mask, goal_rad: float, previous_rad: float | None) -> int:
    """Index of the argmin of (6.6); exact ties go to the previous decision, then left."""
    best = np.flatnonzero(among)
    best = _least(best, angle_between(theta_rad[best], goal_rad))
    if len(best) > 1 and previous_rad is not None:
        best = _least(best, angle_between(theta_rad[best], previous_rad))
    if len(best) > 1:
        turn = theta_rad[best] - goal_rad
        best = _least(best, 2.0 * pi * np.rint(turn / (2.0 * pi)) - turn)
    return int(best[0])


def _least(indices: NDArray[np.intp], value: Floats) -> NDArray[np.intp]:
    """Those of the indices whose value is least, ties included; both of shape (m,)."""
    return indices[value <= value.min() + TIE_RAD]


def select_strengths(
    theta_RD: float, theta_SD: float, goal_rad: float, open_m: float, parameters: SteeringParameters
) -> Floats:
    """Strengths of the rules of Table 6.1, shape (rules, 1); `open_m` is D_S(theta_SD)."""
    inputs = {
        "offset_rad": angle_between(theta_SD, goal_rad),
        "spread_rad": angle_between(theta_SD, theta_RD),
        "open_m": open_m,
    }
    return strengths(parameters.select, inputs)
