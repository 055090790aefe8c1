"""`dubins.toml` as frozen structs; unknown keys are refused."""

from functools import cache
from pathlib import Path

import msgspec


class _Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    pass


class DriveParameters(_Strict, frozen=True):
    """The limits of the point, and its ideal drive-by-wire."""

    minimum_radius_m: float
    """R of (6.10)."""
    disc_radius_m: float
    """Contact is a circle's centre nearer than its radius and this."""
    steering_limit_rad: float
    throttle_mps2: float
    brake_mps2: float
    shift_s: float
    timeout_s: float


class ScanParameters(_Strict, frozen=True):
    """A level fan of beams."""

    every_ticks: int
    beams: int
    half_fan_rad: float
    max_range_m: float
    noise_sd_m: float
    bias_sd_m: float


class FixParameters(_Strict, frozen=True):
    """A GPS receiver in the open."""

    every_ticks: int
    bias_sd_m: float
    noise_sd_m: float
    velocity_sd_mps: float
    altitude_sd_m: float
    satellites: int


class HeadingParameters(_Strict, frozen=True):
    """A compass."""

    every_ticks: int
    bias_sd_rad: float
    noise_sd_rad: float


class StateParameters(_Strict, frozen=True):
    """What the drive-by-wire unit reports."""

    every_ticks: int
    scale_sd: float
    noise_sd_mps: float
    steering_noise_rad: float
    pedal_noise: float


class DubinsParameters(_Strict, frozen=True):
    """The whole file."""

    drive: DriveParameters
    scan: ScanParameters
    gps: FixParameters
    compass: HeadingParameters
    odometry: StateParameters


@cache
def dubins_parameters() -> DubinsParameters:
    """The parameters of the file beside this one.

    Raises:
        msgspec.ValidationError: an unknown or missing key or a wrong type; names its path.
    """
    text = Path(__file__).with_name("dubins.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=DubinsParameters)
