"""Parameters of the steering and the speed fuzzy controller (section 6.4.2)."""

from dataclasses import dataclass

import numpy as np

from nav.errors import NavError
from nav.fuzzy.membership import memberships
from nav.fuzzy.rule_base import RuleBase


@dataclass(frozen=True)
class Criterion:
    """The criterion distances of equation (6.5), [m]."""

    real_m: float
    """d0_CR,R."""
    safe_m: float
    """d0_CR,S."""
    epsilon_m: float
    """Keeps both candidate sets nonempty."""

    def __post_init__(self) -> None:
        for name in ("real_m", "safe_m", "epsilon_m"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) > 0.0):
                raise NavError(f"{name}: {getattr(self, name)} must be positive and finite")


@dataclass(frozen=True)
class SteeringParameters:
    """`steering.toml`."""

    criterion: Criterion
    situation: RuleBase
    """(6.7): v/V0 to the factor on (a, b, c, d)."""
    focus: RuleBase
    """Delta1 and Delta2 to the deduction Delta."""
    persistence: RuleBase
    """Angle to the former decision to what is added to Delta."""
    select: RuleBase
    """Table 6.1."""

    def __post_init__(self) -> None:
        _expect_inputs(self.situation, "situation", ("speed_ratio",))
        _expect_inputs(self.focus, "focus", ("delta_1_rad", "delta_2_rad"))
        _expect_inputs(self.persistence, "persistence", ("delta_3_rad",))
        _expect_inputs(self.select, "select", ("offset_rad", "spread_rad", "open_m"))
        if sorted(self.select.output.terms) != ["real", "safe"]:
            raise NavError("select.output.terms: expected safe and real")
        if self.situation.output.range[0] <= 0.0:
            raise NavError("situation.output.range: a factor must be positive")


@dataclass(frozen=True)
class SpeedParameters:
    """`speed.toml`."""

    safe_distance_m: float
    """D_safe: totally within the fuzzy set DA (Fig. 6.11)."""
    narrow_mps: float
    """The relatively low set point of Remark 1, where theta_RD was selected."""
    anti_collision: RuleBase
    """A(D1, D)."""
    safe_steering: RuleBase
    """T(delta theta)."""

    def __post_init__(self) -> None:
        _expect_inputs(self.anti_collision, "anti_collision", ("D1_m", "D_m"))
        _expect_inputs(self.safe_steering, "safe_steering", ("delta_theta_rad",))
        if self.narrow_mps < 0.0:
            raise NavError(f"narrow_mps: {self.narrow_mps:g} must not be negative")
        if self.anti_collision.output.terms.get("STOP") != 0.0:
            raise NavError("anti_collision.output.terms.STOP: must be there and be 0")
        for name in ("D1_m", "D_m"):
            self._refuse_danger_short_of_safe(name)

    def _refuse_danger_short_of_safe(self, name: str) -> None:
        variable = self.anti_collision.inputs[name]
        if "DA" not in variable.terms:
            raise NavError(f"anti_collision.inputs.{name}.terms.DA: missing")
        members = memberships(variable.flanks, np.array([self.safe_distance_m]))[:, 0]
        if dict(zip(variable.terms, members, strict=True))["DA"] < 1.0:
            raise NavError(
                f"safe_distance_m: {self.safe_distance_m:g} must lie where "
                f"anti_collision.inputs.{name}.terms.DA is 1"
            )


def _expect_inputs(base: RuleBase, where: str, names: tuple[str, ...]) -> None:
    """Refuse a rule base whose inputs are not those that its controller gives.

    Raises:
        NavError: other names, or another order.
    """
    if tuple(base.inputs) != names:
        found = ", ".join(base.inputs)
        raise NavError(f"{where}.inputs: are {found}; expected {', '.join(names)}, in this order")
