"""Which sensors have failed, and which of them for good.

A sensor fails when it has been silent for too long. One that stays so although it is reset is given
up: that is the flag with which the navigator leaves Alarm (section 6.3).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from nav.parameters.states import HealthParameters


class Health(NamedTuple):
    """Names as those of `Admission.newest_ns`, in their fixed order."""

    failed: tuple[str, ...] = ()
    """Silent, and worth a reset."""
    lost: tuple[str, ...] = ()
    """Given up, until they speak again."""
    missed: tuple[str, ...] = ()
    """Helpers that are silent: nobody stops or slows down for them."""


@dataclass
class HealthMonitor:
    """Watches the sensors that the vehicle should have."""

    parameters: HealthParameters
    sensors: tuple[str, ...]
    helpers: tuple[str, ...] = ()
    """What the vehicle drives as safely without: a reset, which takes a stand, is not worth it."""
    _first_ns: int | None = None
    _failed_ns: dict[str, int] = field(default_factory=dict[str, int])

    def check(self, time_ns: int, newest_ns: Mapping[str, int]) -> Health:
        """Take the times of each sensor's newest message."""
        first_ns = self._first_ns = time_ns if self._first_ns is None else self._first_ns
        for name in self.sensors:
            self._follow(name, time_ns, newest_ns.get(name, first_ns))
        patience_ns = self.parameters.patience_s * 1e9
        lost = [time_ns - since > patience_ns for since in self._failed_ns.values()]
        names = tuple(zip(self._failed_ns, lost, strict=True))
        return Health(
            tuple(name for name, gone in names if not gone),
            tuple(name for name, gone in names if gone),
            tuple(n for n in self.helpers if self._silent(time_ns, newest_ns.get(n, first_ns))),
        )

    def _follow(self, name: str, time_ns: int, heard_ns: int) -> None:
        if self._silent(time_ns, heard_ns):
            self._failed_ns.setdefault(name, time_ns)
        else:
            self._failed_ns.pop(name, None)

    def _silent(self, time_ns: int, heard_ns: int) -> bool:
        return time_ns - heard_ns > self.parameters.silent_s * 1e9
