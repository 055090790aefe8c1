"""The sensors' words held against each other: whom to believe.

Each check compares a device with itself or with what does not depend on it. What is implausible for
half a second is as good as silent: the device is reset, and given up where that does not help
(section 6.3).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from nav.fusion.plausibility.checks import Compass, Fixes, Gyro, Ranges, Repeats, Wheels
from nav.fusion.plausibility.evidence import Evidence
from nav.fusion.plausibility.scans import Scans
from nav.fusion.plausibility.witnesses import Ego, Witnesses
from nav.messages import (
    CompassHeading,
    GpsFix,
    ImuSample,
    LidarScan,
    RadarTracks,
    SensorMessage,
    SonarScan,
    VehicleState,
    device,
)
from nav.parameters.plausibility import EvidenceParameters, PlausibilityParameters
from nav.parameters.vehicle import LidarMount

CHECKS: dict[type, Any] = {
    GpsFix: Fixes, ImuSample: Gyro, VehicleState: Wheels, CompassHeading: Compass,
    SonarScan: Ranges, RadarTracks: Ranges,
}  # fmt: skip
"""By the kind of message; what is not here is believed."""


@dataclass
class Plausibility:
    """Hears every admitted message, and says which to believe. Picklable."""

    parameters: PlausibilityParameters
    mounts: Mapping[str, LidarMount]
    _evidence: dict[str, Evidence] = field(default_factory=dict[str, Evidence])
    _checks: dict[str, Any] = field(default_factory=dict[str, Any])
    _others: Witnesses = field(default_factory=Witnesses)

    @property
    def doubted(self) -> dict[str, str]:
        """The devices that are not believed, and why."""
        return {name: e.reason for name, e in self._evidence.items() if e.doubted}

    def believes(self, message: SensorMessage, ego: Ego) -> bool:
        """Whether to take a message; weighs it against its device."""
        name = device(message)
        evidence = self._evidence.get(name)
        if evidence is None:
            evidence = self._evidence[name] = Evidence(self._patience(message))
        reason = self._wrong(name, message, ego)
        if reason is not None:
            evidence.weigh(message.time_ns, reason)
        if not evidence.doubted:
            self._witness(message)
        return not evidence.doubted

    def _patience(self, message: SensorMessage) -> EvidenceParameters:
        """A scanner may look strange for a while: over a bump, or past a bale."""
        p = self.parameters
        scans = isinstance(message, LidarScan)
        return replace(p.evidence, time_s=p.scan.time_s) if scans else p.evidence

    def _wrong(self, name: str, message: SensorMessage, ego: Ego) -> str | None:
        check = self._checks.get(name)
        if isinstance(message, LidarScan):
            height_m = self.mounts[name].position_m[2]
            check = check or self._checks.setdefault(name, Scans(self.parameters.scan, height_m))
            return check.wrong(message, ego)
        kind = CHECKS.get(type(message))
        if kind is None:
            return ""
        check = check or self._checks.setdefault(name, kind(self.parameters, Repeats()))
        return check.wrong(message, ego, self._others)

    def _witness(self, message: SensorMessage) -> None:
        if isinstance(message, GpsFix):
            self._others.fix = message
        elif isinstance(message, VehicleState):
            self._others.state = message
