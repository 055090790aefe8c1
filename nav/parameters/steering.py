"""Parameters of the steering fuzzy controller (section 6.4.2.1)."""

from dataclasses import dataclass

import numpy as np

from nav.errors import NavError
from nav.fuzzy.rule_base import RuleBase
from nav.parameters.fuzzy import expect_inputs


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
        expect_inputs(self.situation, "situation", ("speed_ratio",))
        expect_inputs(self.focus, "focus", ("delta_1_rad", "delta_2_rad"))
        expect_inputs(self.persistence, "persistence", ("delta_3_rad",))
        expect_inputs(self.select, "select", ("offset_rad", "spread_rad", "open_m"))
        if sorted(self.select.output.terms) != ["real", "safe"]:
            raise NavError("select.output.terms: expected safe and real")
        if self.situation.output.range[0] <= 0.0:
            raise NavError("situation.output.range: a factor must be positive")
