"""The speed fuzzy controller of section 6.4.2.2: equation (6.8)."""

from dataclasses import dataclass

from nav.fuzzy.inference import average, explain, strengths
from nav.fuzzy.rule_base import RuleBase
from nav.parameters.fuzzy import SpeedParameters


@dataclass(frozen=True)
class SpeedDecision:
    """V_s(k) and all that led to it."""

    speed_mps: float
    """V_s(k)."""
    limited_by: str
    """Which term of (6.8) is the least: `V0`, `A`, `T`, or `narrow` for Remark 1."""
    terms_mps: dict[str, float]
    """The terms of the minimum, by the names above."""
    anti_collision_rules: dict[str, float]
    """Strength of each rule of A, in words."""
    safe_steering_rules: dict[str, float]
    """Strength of each rule of T, in words."""


def set_point(
    D1_m: float,
    D_m: float,
    delta_theta_rad: float,
    V0_mps: float,
    selected: str,
    parameters: SpeedParameters,
) -> SpeedDecision:
    """V_s(k) = min[V0, A(D1, D), T(delta theta)], equation (6.8), and Remark 1.

    Args:
        D1_m: free distance straight ahead.
        D_m: free distance along the planned path (Fig. 6.4).
        delta_theta_rad: theta_D(k) - theta(k) within half a turn; the sign does not matter.
        V0_mps: speed limit.
        selected: `real` where theta_RD was picked: a narrow path, so a low set point.
        parameters: `speed.toml`.
    """
    A, collision = _rules(parameters.anti_collision, {"D1_m": D1_m, "D_m": D_m})
    T, steering = _rules(parameters.safe_steering, {"delta_theta_rad": abs(delta_theta_rad)})
    terms = {"V0": max(V0_mps, 0.0), "A": A, "T": T}
    if selected == "real":
        terms["narrow"] = parameters.narrow_mps
    least = min(terms, key=terms.__getitem__)
    return SpeedDecision(terms[least], least, terms, collision, steering)


def _rules(base: RuleBase, inputs: dict[str, float]) -> tuple[float, dict[str, float]]:
    strength = strengths(base, inputs)
    return float(average(base, strength)[0]), explain(base, strength)
