"""Which sensors have failed, and which of them for good.

A sensor fails when it has been silent for too long, or says what cannot be true. One that stays so
although it is reset, or fails again and again, is given up: that is the flag with which the
navigator leaves Alarm (section 6.3).
"""

from collections.abc import Container, Mapping
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
    unfit: str = ""
    """Without what the vehicle must not drive on, if it is gone."""


@dataclass
class HealthMonitor:
    """Watches the sensors that the vehicle should have."""

    parameters: HealthParameters
    sensors: tuple[str, ...]
    helpers: tuple[str, ...] = ()
    """What the vehicle drives as safely without: a reset, which takes a stand, is not worth it."""
    eyes: tuple[str, ...] = ()
    """Its scanners: without all of them it must not drive on."""
    _first_ns: int | None = None
    _failed_ns: dict[str, int] = field(default_factory=dict[str, int])
    """Since when those have failed that have."""
    _failures_ns: dict[str, list[int]] = field(default_factory=dict[str, list[int]])
    """When each failed of late."""
    _bad_ns: dict[str, int] = field(default_factory=dict[str, int])
    """When each was bad last."""

    def check(
        self, time_ns: int, newest_ns: Mapping[str, int], doubted: Container[str] = ()
    ) -> Health:
        """Take the times of each sensor's newest message, and those who are not believed."""
        first_ns = self._first_ns = time_ns if self._first_ns is None else self._first_ns
        for name in self.sensors:
            self._follow(name, time_ns, newest_ns.get(name, first_ns), name in doubted)
        patience_ns = self.parameters.patience_s * 1e9
        lost = [
            time_ns - since > patience_ns or self._unsteady(name)
            for name, since in self._failed_ns.items()
        ]
        names = tuple(zip(self._failed_ns, lost, strict=True))
        return Health(
            tuple(name for name, gone in names if not gone),
            tuple(name for name, gone in names if gone),
            tuple(n for n in self.helpers if self._silent(time_ns, newest_ns.get(n, first_ns))),
            self._unfit(newest_ns),
        )

    def _unfit(self, heard: Container[str]) -> str:
        """What never spoke is not fitted, and nobody counts on it."""
        vital = [n for n in self.parameters.vital if n in self._failed_ns and n in heard]
        blind = bool(self.eyes) and all(n in self._failed_ns and n in heard for n in self.eyes)
        return "all scanners" if blind else " and ".join(vital)

    def _follow(self, name: str, time_ns: int, heard_ns: int, doubted: bool) -> None:
        if doubted or self._silent(time_ns, heard_ns):
            self._bad_ns[name] = time_ns
            if name not in self._failed_ns:
                self._failures_ns.setdefault(name, []).append(time_ns)
            self._failed_ns.setdefault(name, time_ns)
        elif name in self._failed_ns and self._steady(name, time_ns):
            del self._failed_ns[name]

    def _steady(self, name: str, time_ns: int) -> bool:
        """Whether one that speaks again is to be trusted: at once, but for one that often fails, or
        that the vehicle cannot drive without."""
        if name not in self.parameters.vital and not self._unsteady(name):
            return True
        if time_ns - self._bad_ns[name] < self.parameters.steady_s * 1e9:
            return False
        self._failures_ns[name].clear()
        return True

    def _unsteady(self, name: str) -> bool:
        """Whether it has failed too often within a while."""
        p, failures = self.parameters, self._failures_ns[name]
        del failures[: -p.often]
        return len(failures) == p.often and failures[-1] - failures[0] < p.often_s * 1e9

    def _silent(self, time_ns: int, heard_ns: int) -> bool:
        return time_ns - heard_ns > self.parameters.silent_s * 1e9
