"""What the point-mass simulator lets be heard: a scan, a GPS fix, a compass, the drive's report.

Each sensor has a generator of its own. Nothing is delayed: the paper's simulator knows no delays.
"""

from math import cos, pi, sin
from typing import Protocol

import numpy as np

from nav.messages import (
    LIDAR_COUNT_M,
    LIDAR_NO_RETURN_COUNT,
    CompassHeading,
    Gear,
    GpsFix,
    GpsQuality,
    LidarScan,
    SensorMessage,
    VehicleState,
    lidar_range_m,
)
from twin.dubins.circles import Floats, ranges_m
from twin.dubins.kinematics import State
from twin.dubins.parameters import (
    DubinsParameters,
    FixParameters,
    HeadingParameters,
    ScanParameters,
    StateParameters,
)
from twin.earth import to_geodetic
from twin.sensors.sensor import generator
from twin.truth import Applied


class DubinsSensor(Protocol):
    """One device."""

    name: str
    every_ticks: int

    def measure(self, time_ns: int, state: State, applied: Applied) -> SensorMessage:
        """The message that says what `state` looks like at `time_ns`."""
        ...


class FieldScan:
    """A level fan: circles hide what is behind them."""

    name = "lidar_field"

    def __init__(self, circles: Floats, seed: int, p: ScanParameters) -> None:
        self.every_ticks = p.every_ticks
        self._p, self._circles = p, circles
        self._rng = generator(seed, self.name)
        self._bias_m = p.bias_sd_m * self._rng.standard_normal()
        self._step_rad = 2.0 * p.half_fan_rad / (p.beams - 1)

    def measure(self, time_ns: int, state: State, applied: Applied) -> LidarScan:
        """The scan of this instant, in counts of a centimetre."""
        del applied  # Unused.
        p = self._p
        fan = (-p.half_fan_rad, self._step_rad, p.beams)
        true_m = ranges_m(self._circles, state[:3], *fan, p.max_range_m)
        error_m = self._bias_m + p.noise_sd_m * self._rng.standard_normal(p.beams)
        counts = np.rint(np.maximum(true_m + error_m, 0.0) / LIDAR_COUNT_M)
        counts[true_m >= p.max_range_m] = LIDAR_NO_RETURN_COUNT
        return LidarScan(time_ns, self.name, lidar_range_m(counts.astype(np.uint16)))


class FieldGps:
    """A fix with an offset that stays and noise that does not."""

    name = "gps"

    def __init__(self, anchor: tuple[float, float], seed: int, p: FixParameters) -> None:
        self.every_ticks = p.every_ticks
        self._p, self._anchor = p, anchor
        self._rng = generator(seed, self.name)
        self._bias_m = (p.bias_sd_m * self._rng.standard_normal(2)).tolist()

    def measure(self, time_ns: int, state: State, applied: Applied) -> GpsFix:
        """The fix of this instant."""
        del applied  # Unused.
        p, n = self._p, self._rng.standard_normal(7).tolist()
        east = state.x_m + self._bias_m[0] + p.noise_sd_m * n[0]
        north = state.y_m + self._bias_m[1] + p.noise_sd_m * n[1]
        latitude, longitude = to_geodetic(self._anchor, east, north)
        u, heading = state.speed_mps, state.heading_rad
        velocity = (u * cos(heading), u * sin(heading), 0.0)
        return GpsFix(
            time_ns,
            GpsQuality.CONVERGED,
            p.satellites,
            float(latitude),
            float(longitude),
            p.altitude_sd_m * n[5],
            p.bias_sd_m * (1.0 + 0.1 * n[6]),
            np.array([v + p.velocity_sd_mps * e for v, e in zip(velocity, n[2:5], strict=True)]),
        )


class FieldCompass:
    """The heading with a bias and noise."""

    name = "compass"

    def __init__(self, seed: int, p: HeadingParameters) -> None:
        self.every_ticks = p.every_ticks
        self._p = p
        self._rng = generator(seed, self.name)
        self._bias_rad = p.bias_sd_rad * self._rng.standard_normal()

    def measure(self, time_ns: int, state: State, applied: Applied) -> CompassHeading:
        """The heading of this instant."""
        del applied  # Unused.
        error = self._bias_rad + self._p.noise_sd_rad * self._rng.standard_normal()
        heading = state.heading_rad + error
        return CompassHeading(time_ns, float(pi - (pi - heading) % (2.0 * pi)))


class FieldOdometry:
    """Six counters that know no sign and stand at one point, and where the actuators are."""

    name = "odometry"

    def __init__(self, seed: int, p: StateParameters) -> None:
        self.every_ticks = p.every_ticks
        self._p = p
        self._rng = generator(seed, self.name)
        self._scale = 1.0 + p.scale_sd * self._rng.standard_normal(6)

    def measure(self, time_ns: int, state: State, applied: Applied) -> VehicleState:
        """The report of this instant."""
        p, n = self._p, self._rng.standard_normal(9)
        steering, throttle, brake = n[6:].tolist()
        return VehicleState(
            time_ns,
            np.abs(state.speed_mps * self._scale + p.noise_sd_mps * n[:6]),
            applied.steering_rad + p.steering_noise_rad * steering,
            applied.throttle + p.pedal_noise * throttle,
            applied.brake + p.pedal_noise * brake,
            Gear(applied.gear),
            applied.shifting,
        )


def sensors(
    circles: Floats, anchor: tuple[float, float], seed: int, p: DubinsParameters
) -> list[DubinsSensor]:
    """All of them, in the order in which simultaneous messages are heard."""
    return [
        FieldScan(circles, seed, p.scan),
        FieldGps(anchor, seed, p.gps),
        FieldCompass(seed, p.compass),
        FieldOdometry(seed, p.odometry),
    ]
