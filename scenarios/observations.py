"""What an agent observes: the newest message of each device, as arrays of fixed shape.

Nothing is added to what the navigator hears: rates, delays, noise and faults are the sensors' own.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.messages import (
    RadarTracks,
    SensorMessage,
    device,
)
from nav.parameters.vehicle import VehicleParameters

Floats = NDArray[np.float64]
Observation = dict[str, Floats]
MOST_TRACKS = 7
NEVER_S = 1e6
"""The age of what has not been heard yet."""


class Kind(NamedTuple):
    """How one kind of message becomes an array."""

    shape: tuple[int, ...]
    array: Callable[[Any], Any]
    says: str
    """What stands in it."""


def kinds(vehicle: VehicleParameters) -> dict[str, Kind]:
    """What is observed, by the name of the device."""
    beams, sonars = vehicle.lidar.count, len(vehicle.sonar_mounts)
    scan = Kind((beams,), lambda m: m.range_m, "ranges [m], first beam to the right")
    found = dict.fromkeys(vehicle.lidar_mounts, scan)
    if sonars:
        found["sonar"] = Kind((sonars,), lambda m: m.range_m, "ranges [m], in their order")
    for name in vehicle.radars:
        found[name] = Kind((MOST_TRACKS, 3), _tracks, "range [m], azimuth [rad], rate [m/s], or 0")
    return found | OTHERS


def _tracks(tracks: RadarTracks) -> Floats:
    table = np.zeros((MOST_TRACKS, 3))
    rows = np.stack([tracks.range_m, tracks.azimuth_rad, tracks.range_rate_mps], axis=1)
    table[: len(rows)] = rows[:MOST_TRACKS]
    return table


OTHERS = {
    "gps": Kind(
        (8,),
        lambda m: (
            m.latitude_deg, m.longitude_deg, m.altitude_m, *m.velocity_mps, m.sd_m, m.quality,
        ),
        "latitude, longitude [deg], altitude [m], velocity east, north, up [m/s], sd [m], quality",
    ),
    "imu": Kind(
        (8,),
        lambda m: (*m.angular_rate_radps, *m.acceleration_mps2, m.roll_rad, m.pitch_rad),
        "rates [rad/s], specific force [m/s^2], roll, pitch [rad]",
    ),
    "compass": Kind((1,), lambda m: (m.heading_rad,), "heading [rad]"),
    "odometry": Kind(
        (11,),
        lambda m: (*m.wheel_speed_mps, m.steering_rad, m.throttle, m.brake, m.gear, m.shifting),
        "six wheels [m/s], steering [rad], throttle, brake, gear, shifting",
    ),
    "road_camera": Kind(
        (4,),
        lambda m: (m.offset_m, m.heading_rad, m.width_m, m.confidence),
        "offset [m], heading [rad], width [m], confidence",
    ),
}  # fmt: skip


class Heard:
    """The newest message of each device, as an array that is never changed afterwards."""

    def __init__(self, vehicle: VehicleParameters) -> None:
        self._vehicle = vehicle
        self._values = {name: np.zeros(kind.shape) for name, kind in kinds(vehicle).items()}
        self._heard_ns: dict[str, int] = {}

    def take(self, messages: list[SensorMessage]) -> None:
        """Remember messages, in order of delivery."""
        known = kinds(self._vehicle)
        for name, message in {device(m): m for m in messages}.items():
            self._values[name] = np.array(known[name].array(message), np.float64)
            self._heard_ns[name] = message.time_ns

    def observation(self, now_ns: int) -> Observation:
        """Each device's array, and `NAME_age_s`: since its measurement; zeros, and `NEVER_S`, of
        what has not been heard yet."""
        seen: Observation = {}
        for name, values in self._values.items():
            heard_ns = self._heard_ns.get(name)
            age_s = NEVER_S if heard_ns is None else (now_ns - heard_ns) * 1e-9
            seen[name], seen[f"{name}_age_s"] = values, np.array(age_s)
        return seen
