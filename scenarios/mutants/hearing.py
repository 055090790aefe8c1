"""Mutants that mishear: the messages change before the healthy navigator gets them."""

from collections import deque
from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from nav.messages import (
    LIDAR_NO_RETURN_M,
    CompassHeading,
    Gear,
    GpsFix,
    GpsQuality,
    ImuSample,
    LidarScan,
    Outputs,
    SensorMessage,
    SonarScan,
    VehicleState,
)
from nav.navigator import IonNavigator
from scenarios.mutants.mutant import Mutant, remade

Hear = Callable[[int, Sequence[SensorMessage]], Sequence[SensorMessage]]
"""From the time of a call and its messages to those that are heard."""

NO_ECHO_M = 100.0
"""Farther than any sonar hears."""
NEAR_M = 8.0
LONGER = 1.25
MILE = 0.621
"""A kilometre is so much of it."""
FREEZES_NS = 10_000_000_000
LATE_NS = 400_000_000
"""Less than what the navigator takes for stale."""
SIDES = {"lidar_left": "lidar_right", "lidar_right": "lidar_left"}


class Mishearing(IonNavigator):
    """Healthy, but for its ears."""

    hear: Hear

    def step(self, time_ns: int, messages: Sequence[SensorMessage]) -> Outputs:
        """As `nav.messages.Navigator` says."""
        return super().step(time_ns, self.hear(time_ns, messages))


@dataclass(frozen=True)
class Each:
    """Every message of one kind is changed, and nothing is remembered."""

    kind: type[Any]
    change: Callable[[Any], SensorMessage]

    def __call__(self, time_ns: int, messages: Sequence[SensorMessage]) -> list[SensorMessage]:
        """The messages, those of the kind changed."""
        del time_ns
        return [self.change(m) if isinstance(m, self.kind) else m for m in messages]


@dataclass
class FrozenGps:
    """A receiver that says its position of the tenth second for ever, as if it were new."""

    held: GpsFix | None = None

    def __call__(self, time_ns: int, messages: Sequence[SensorMessage]) -> list[SensorMessage]:
        """The messages, with fixes of long ago."""
        return [self._said(m) if isinstance(m, GpsFix) else m for m in messages]

    def _said(self, fix: GpsFix) -> GpsFix:
        if self.held is None and fix.time_ns >= FREEZES_NS:
            self.held = fix
        return replace(self.held, time_ns=fix.time_ns) if self.held else fix


@dataclass
class LateScans:
    """Scans lie in a queue, and bear the time at which they leave it."""

    waiting: deque[LidarScan] = field(default_factory=deque[LidarScan])

    def __call__(self, time_ns: int, messages: Sequence[SensorMessage]) -> list[SensorMessage]:
        """The messages, with the scans that were measured `LATE_NS` ago."""
        self.waiting.extend(m for m in messages if isinstance(m, LidarScan))
        heard: list[SensorMessage] = [m for m in messages if not isinstance(m, LidarScan)]
        while self.waiting and self.waiting[0].time_ns + LATE_NS <= time_ns:
            scan = self.waiting.popleft()
            heard.append(replace(scan, time_ns=scan.time_ns + LATE_NS))
        return heard


def _deaf(echoes: SonarScan) -> SonarScan:
    return replace(echoes, range_m=np.full_like(echoes.range_m, NO_ECHO_M))


def _blind_roof(scan: LidarScan) -> LidarScan:
    far = np.full_like(scan.range_m, LIDAR_NO_RETURN_M)
    return replace(scan, range_m=far) if scan.sensor == "lidar_roof" else scan


def _far(scan: LidarScan) -> LidarScan:
    return replace(scan, range_m=np.where(scan.range_m < NEAR_M, LIDAR_NO_RETURN_M, scan.range_m))


def _longer(scan: LidarScan) -> LidarScan:
    return replace(scan, range_m=np.minimum(LONGER * scan.range_m, LIDAR_NO_RETURN_M))


def _mirrored(scan: LidarScan) -> LidarScan:
    return replace(scan, range_m=scan.range_m[::-1])


def _swapped(scan: LidarScan) -> LidarScan:
    return replace(scan, sensor=SIDES.get(scan.sensor, scan.sensor))


def _never_lost(fix: GpsFix) -> GpsFix:
    lost = fix.quality is GpsQuality.NONE
    return replace(fix, quality=GpsQuality.CONVERGED) if lost else fix


def _clockwise(heading: CompassHeading) -> CompassHeading:
    return replace(heading, heading_rad=-heading.heading_rad)


def _turned_over(sample: ImuSample) -> ImuSample:
    return replace(sample, angular_rate_radps=sample.angular_rate_radps * (1.0, -1.0, -1.0))


def _in_miles(state: VehicleState) -> VehicleState:
    return replace(state, wheel_speed_mps=MILE * state.wheel_speed_mps)


def _right_is_left(state: VehicleState) -> VehicleState:
    return replace(state, steering_rad=-state.steering_rad)


def _high_gear(state: VehicleState) -> VehicleState:
    return replace(state, gear=Gear.HIGH)


_EARS: dict[str, tuple[str, Hear]] = {
    "deaf_sonar": ("The sonars hear no echo.", Each(SonarScan, _deaf)),
    "blind_roof": ("For the roof scanner nothing returns.", Each(LidarScan, _blind_roof)),
    "farsighted_scanners": ("No scanner sees what is nearer than 8 m.", Each(LidarScan, _far)),
    "long_ranges": ("All LIDAR ranges are a quarter too long.", Each(LidarScan, _longer)),
    "mirrored_scans": ("The first beam is taken for the left one.", Each(LidarScan, _mirrored)),
    "swapped_scanners": ("The left scanner is taken for the right.", Each(LidarScan, _swapped)),
    "late_scans": ("Scans are 0.4 s old and are taken for new.", LateScans()),
    "frozen_gps": ("After ten seconds GPS says the same position again and again.", FrozenGps()),
    "gps_never_lost": ("A lost GPS is believed where it was last.", Each(GpsFix, _never_lost)),
    "clockwise_compass": ("The compass counts clockwise.", Each(CompassHeading, _clockwise)),
    "gyro_turned_over": ("The gyro is mounted upside down.", Each(ImuSample, _turned_over)),
    "wheels_in_miles": ("Wheel speeds are miles, not kilometres.", Each(VehicleState, _in_miles)),
    "steering_reads_mirrored": (
        "The steering angle that is read back has the opposite sign.",
        Each(VehicleState, _right_is_left),
    ),
    "gear_reads_high": (
        "The linkage says that it is in the high gear, wherever it is.",
        Each(VehicleState, _high_gear),
    ),
}


def _mishears(hear: Hear, navigator: IonNavigator) -> IonNavigator:
    """Each with ears of its own, for some remember."""
    return remade(Mishearing, navigator, hear=deepcopy(hear))


HEARING = {name: Mutant(why, partial(_mishears, hear)) for name, (why, hear) in _EARS.items()}
"""By name."""
