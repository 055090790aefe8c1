"""What a failing sensor says instead of what it measured.

The usual sizes are estimated: large enough that a driver who believes them is in danger.
"""

from collections.abc import Callable
from dataclasses import replace
from math import cos, radians
from typing import Any, NamedTuple

import numpy as np

from nav.messages import (
    LIDAR_COUNT_M,
    LIDAR_NO_RETURN_COUNT,
    LIDAR_NO_RETURN_M,
    CompassHeading,
    GpsFix,
    ImuSample,
    LidarScan,
    RadarTracks,
    RoadEstimate,
    SensorMessage,
    SonarScan,
    VehicleState,
)

LATE_S = 1.0
"""Usual delay of what is late."""
PERIOD_S = 4.0
"""Usual period of what flaps."""
DEGREE_M = 111_320.0
"""A degree of latitude; the size of a fault need not be more exact."""
Errors = Callable[[int], Any]
"""Draws n errors in the unit of the quantity."""


class Spoils(NamedTuple):
    """How a kind of message is spoiled."""

    noise: float
    """Usual standard deviation ..."""
    offset: float
    """... and usual constant error, in the unit of what is spoiled."""
    add: Callable[[Any, Errors], SensorMessage]


def spoiled(message: SensorMessage, kind: str, size: float | None, rng: Any) -> SensorMessage:
    """The message of a sensor that is `noisy` or has an `offset`; `size` None: the usual one."""
    spoils = SPOILS[type(message)]
    if kind == "offset":
        constant = spoils.offset if size is None else size
        return spoils.add(message, lambda n: np.full(n, constant))
    sd = spoils.noise if size is None else size
    return spoils.add(message, lambda n: sd * rng.standard_normal(n))


def _ranges(message: Any, errors: Errors) -> Any:
    range_m = message.range_m
    return replace(message, range_m=np.maximum(range_m + errors(len(range_m)), 0.0))


def _scan(scan: LidarScan, errors: Errors) -> LidarScan:
    """In counts, as the scanner says it; what has no return has none."""
    counts = np.rint((scan.range_m + errors(len(scan.range_m))) / LIDAR_COUNT_M)
    counts = np.clip(counts, 0, LIDAR_NO_RETURN_COUNT - 1) + 0.0  # no -0
    none = scan.range_m >= LIDAR_NO_RETURN_M
    return replace(scan, range_m=np.where(none, scan.range_m, counts * LIDAR_COUNT_M))


def _echoes(scan: SonarScan, errors: Errors) -> SonarScan:
    """No echo stays none, which is the largest range of all."""
    heard = np.clip(scan.range_m + errors(len(scan.range_m)), 0.0, MOST_SONAR_M)
    return replace(scan, range_m=np.where(scan.range_m < MOST_SONAR_M, heard, scan.range_m))


MOST_SONAR_M = 4.0
"""See `max_range_m` of the sonars; of a robot's, which reach farther, the rest stays right."""


def _fix(fix: GpsFix, errors: Errors) -> GpsFix:
    east, north = errors(2)
    degree_m = DEGREE_M * cos(radians(fix.latitude_deg))
    return replace(
        fix,
        latitude_deg=float(fix.latitude_deg + north / DEGREE_M),
        longitude_deg=float(fix.longitude_deg + east / degree_m),
    )


def _rates(sample: ImuSample, errors: Errors) -> ImuSample:
    return replace(sample, angular_rate_radps=sample.angular_rate_radps + errors(3))


def _heading(heading: CompassHeading, errors: Errors) -> CompassHeading:
    turned = heading.heading_rad + float(errors(1)[0])
    return replace(heading, heading_rad=float(np.pi - (np.pi - turned) % (2.0 * np.pi)))


def _wheels(state: VehicleState, errors: Errors) -> VehicleState:
    return replace(state, wheel_speed_mps=np.abs(state.wheel_speed_mps + errors(6)))


def _road(road: RoadEstimate, errors: Errors) -> RoadEstimate:
    return replace(road, offset_m=road.offset_m + float(errors(1)[0]))


SPOILS: dict[type, Spoils] = {
    LidarScan: Spoils(0.5, 0.5, _scan),  # [m]
    SonarScan: Spoils(0.5, 0.5, _echoes),  # [m]
    RadarTracks: Spoils(5.0, 5.0, _ranges),  # [m]
    GpsFix: Spoils(3.0, 5.0, _fix),  # [m] east and north
    ImuSample: Spoils(0.2, 0.1, _rates),  # [rad/s]
    CompassHeading: Spoils(0.5, 0.5, _heading),  # [rad]
    VehicleState: Spoils(1.0, 1.0, _wheels),  # [m/s]
    RoadEstimate: Spoils(1.0, 1.0, _road),  # [m]
}
"""By the kind of message."""
