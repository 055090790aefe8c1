"""What speaks against a device: the share of its messages that were implausible of late."""

from dataclasses import dataclass
from math import exp

from nav.parameters.plausibility import EvidenceParameters

MOST_S = 0.1
"""One message counts for no more, however long nothing could be said before it."""


@dataclass
class Evidence:
    """Against one device."""

    parameters: EvidenceParameters
    share: float = 0.0
    doubted: bool = False
    reason: str = ""
    """The last one to doubt it."""
    _heard_ns: int | None = None

    def weigh(self, time_ns: int, reason: str) -> None:
        """Take one more message: why it is implausible, or nothing."""
        p, before = self.parameters, self._heard_ns
        self._heard_ns = time_ns
        if before is None:
            return
        since_s = min((time_ns - before) * 1e-9, MOST_S)
        gain = 1.0 - exp(-since_s / p.time_s)
        self.share += gain * (bool(reason) - self.share)
        self.reason = reason or self.reason
        self.doubted = self.share > (p.believe if self.doubted else p.doubt)
