"""Parameters of the speed fuzzy controller (section 6.4.2.2)."""

from dataclasses import dataclass

import numpy as np

from nav.errors import NavError
from nav.fuzzy.membership import memberships
from nav.fuzzy.rule_base import RuleBase
from nav.parameters.fuzzy import expect_inputs


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
        expect_inputs(self.anti_collision, "anti_collision", ("D1_m", "D_m"))
        expect_inputs(self.safe_steering, "safe_steering", ("delta_theta_rad",))
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
