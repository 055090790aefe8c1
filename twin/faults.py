"""Sensors that fall silent; some come back when they are reset."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Literal


@dataclass(frozen=True)
class Fault:
    """What happens to one sensor, and when."""

    sensor: str
    """As `SensorSuite` names it."""
    kind: Literal["silent"]
    from_s: float
    to_s: float = inf
    recovers_s: float | None = None
    """It works again this long after a reset; None where a reset does not help."""


@dataclass
class Faults:
    """All faults of one episode, and the resets so far. Picklable in the middle."""

    faults: Sequence[Fault]
    _ends_ns: dict[int, int] = field(default_factory=dict)
    """By index: when a reset will have taken effect."""

    def reset(self, time_ns: int, sensor: str) -> None:
        """Somebody resets a sensor. A reset that is under way goes on."""
        for k, fault in enumerate(self.faults):
            helps = fault.sensor == sensor and fault.recovers_s is not None
            if helps and time_ns >= fault.from_s * 1e9:
                self._ends_ns.setdefault(k, time_ns + round(fault.recovers_s * 1e9))  # pyright: ignore

    def silent(self, time_ns: int, sensor: str) -> bool:
        """Whether nothing is heard of what a sensor measures at `time_ns`."""
        return any(
            fault.sensor == sensor and self._holds(k, fault, time_ns)
            for k, fault in enumerate(self.faults)
        )

    def _holds(self, k: int, fault: Fault, time_ns: int) -> bool:
        began = fault.from_s * 1e9 <= time_ns < fault.to_s * 1e9
        return began and time_ns < self._ends_ns.get(k, 2**63)
