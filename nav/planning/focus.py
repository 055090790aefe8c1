"""The deduction Delta(theta): focus, focus against search (6.7) and persistence."""

from dataclasses import dataclass
from math import pi

import numpy as np

from nav.fuzzy.inference import average, infer, strengths
from nav.messages import Floats
from nav.parameters.fuzzy import SteeringParameters


@dataclass(frozen=True)
class Situation:
    """S(k) of (6.7) and what it does to the focus rules."""

    exploring: float
    """Membership of v/V0 in EX."""
    travelling: float
    """Membership of v/V0 in TR."""
    stretch: float
    """Factor on (a, b, c, d)."""


def angle_between(a_rad: Floats | float, b_rad: float) -> Floats:
    """|a - b| in [0, pi], for angles of any turn; odd-symmetric rounding keeps mirrors exact."""
    difference = np.asarray(a_rad, dtype=np.float64) - b_rad
    return np.abs(difference - 2.0 * pi * np.rint(difference / (2.0 * pi)))


def situation(speed_mps: float, V0_mps: float, parameters: SteeringParameters) -> Situation:
    """S(k) = F_S(v(k), V0) and [a b c d] = F(S(k)), equation (6.7)."""
    base = parameters.situation
    ratio = abs(speed_mps) / V0_mps if V0_mps > 0.0 else 0.0
    strength = strengths(base, {"speed_ratio": ratio})
    exploring, travelling = strength[:, 0].tolist()
    return Situation(exploring, travelling, float(average(base, strength)[0]))


def deduction(
    theta_rad: Floats,
    heading_rad: float,
    goal_rad: float,
    previous_rad: float | None,
    stretch: float,
    parameters: SteeringParameters,
) -> Floats:
    """Delta(theta), shape (n,), [m]: what is deducted from the scanning distances in (6.5).

    To widen (a, b, c, d) by a factor is to divide the angles by it.
    """
    delta_1 = angle_between(theta_rad, heading_rad) / stretch
    delta_2 = angle_between(theta_rad, goal_rad) / stretch
    focus = infer(parameters.focus, {"delta_1_rad": delta_1, "delta_2_rad": delta_2})
    if previous_rad is None:
        return focus
    delta_3 = angle_between(theta_rad, previous_rad)
    return focus + infer(parameters.persistence, {"delta_3_rad": delta_3})


def breakpoints(stretch: float, parameters: SteeringParameters) -> tuple[float, ...]:
    """The effective (a, b, c, d) of Delta1, [rad]."""
    return tuple(stretch * p for p in parameters.focus.inputs["delta_1_rad"].breakpoints)
