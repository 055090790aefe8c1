"""All faults of one episode: when they hold, what a reset does, and what is heard meanwhile."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from nav.messages import SensorMessage
from twin.faults.fault import Fault
from twin.faults.spoiled import LATE_S, PERIOD_S, spoiled


@dataclass
class Faults:
    """Picklable in the middle."""

    faults: Sequence[Fault]
    seed: int = 0
    way_m: float = 0.0
    """Driven so far: for faults that have a place."""
    _ends_ns: dict[int, int] = field(default_factory=dict[int, int])
    """By index: when a reset will have taken effect."""
    _held: dict[str, SensorMessage] = field(default_factory=dict[str, SensorMessage])
    """What frozen sensors said last."""
    _rng: dict[int, np.random.Generator] = field(default_factory=dict[int, np.random.Generator])

    def __post_init__(self) -> None:
        self._devices = frozenset(fault.device for fault in self.faults)

    def __contains__(self, device: str) -> bool:
        """Whether a device ever fails."""
        return device in self._devices

    def reset(self, time_ns: int, device: str) -> None:
        """Somebody resets a sensor. A reset that is under way goes on."""
        for k, fault in self._of(device, time_ns):
            if fault.recovers_s is not None:
                self._ends_ns.setdefault(k, time_ns + round(fault.recovers_s * 1e9))

    def heard(self, time_ns: int, device: str, message: SensorMessage) -> SensorMessage | None:
        """What a sensor says instead of `message`; None where nothing is heard of it."""
        if not self._of(device, time_ns):  # nearly always
            self._held[device] = message
            return message
        if not self.frozen(time_ns, device):
            self._held[device] = message
        if self.silent(time_ns, device):
            return None
        said = replace(self._held.setdefault(device, message), time_ns=message.time_ns)
        for k, fault in self.spoils(time_ns, device):
            said = spoiled(said, fault.kind, fault.size, self.rng(k))
        return said

    def silent(self, time_ns: int, device: str) -> bool:
        """Whether a device is silent, or flaps and is silent just now."""
        return any(
            fault.kind == "silent" or (fault.kind == "flapping" and _flaps(fault, time_ns))
            for _, fault in self._of(device, time_ns)
        )

    def frozen(self, time_ns: int, device: str) -> bool:
        """Whether a device is frozen."""
        return any(fault.kind == "frozen" for _, fault in self._of(device, time_ns))

    def late_s(self, time_ns: int, device: str) -> float:
        """By how much later than usual a device is heard, or acts, [s]."""
        late = [fault.size for _, fault in self._of(device, time_ns) if fault.kind == "late"]
        return max((LATE_S if size is None else size for size in late), default=0.0)

    def spoils(self, time_ns: int, device: str) -> Iterator[tuple[int, Fault]]:
        """The faults that make a device noisy or wrong, with their index."""
        return (pair for pair in self._of(device, time_ns) if pair[1].kind in ("noisy", "offset"))

    def rng(self, k: int) -> np.random.Generator:
        """The random numbers of the k-th fault."""
        key = tuple(f"fault {self.faults[k]}".encode())
        sequence = np.random.SeedSequence(self.seed, spawn_key=key)
        return self._rng.setdefault(k, np.random.default_rng(sequence))

    def _of(self, device: str, time_ns: int) -> list[tuple[int, Fault]]:
        """The faults that hold now, with their index."""
        return [
            (k, fault)
            for k, fault in enumerate(self.faults)
            if fault.device == device
            and fault.holds(time_ns * 1e-9, self.way_m)
            and time_ns < self._ends_ns.get(k, 2**63)
        ]


def _flaps(fault: Fault, time_ns: int) -> bool:
    period_s = PERIOD_S if fault.size is None else fault.size
    return time_ns * 1e-9 % period_s < 0.5 * period_s
