"""The vehicle as the navigator knows it: outline, axles, steering, and where sensors sit."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Outline:
    """The vehicle's rectangle in the vehicle frame, [m]."""

    front_m: float
    rear_m: float
    """Negative: behind the reference point."""
    half_width_m: float


@dataclass(frozen=True)
class Steering:
    """Road-wheel angle for a path curvature k: limit * (linear * k + quadratic * k^2)."""

    limit_rad: float
    rate_radps: float
    delay_s: float
    """Targets take effect this late."""
    linear_m: float
    quadratic_m2: float
    minimum_radius_m: float


@dataclass(frozen=True)
class LidarMount:
    """Pose of a scanner in the vehicle frame; positive pitch looks down."""

    position_m: tuple[float, float, float]
    yaw_rad: float
    pitch_rad: float
    roll_rad: float = 0.0


@dataclass(frozen=True)
class Lidar:
    """The fan of one scanner."""

    first_rad: float
    step_rad: float
    count: int
    max_range_m: float
    turn_s: float = 0.0
    """Of the mirror, which turns twice for a scan: every second beam, then those in between. A
    scan bears the time of its last beam. 0: all beams at once."""


@dataclass(frozen=True)
class SonarMount:
    """A sonar looks along `yaw_rad` in the plane of the vehicle."""

    position_m: tuple[float, float, float]
    yaw_rad: float


@dataclass(frozen=True)
class Sonar:
    """What all sonars have in common."""

    half_cone_rad: float
    min_range_m: float
    max_range_m: float


@dataclass(frozen=True)
class Radar:
    """A radar looks along `yaw_rad` in the plane of the vehicle."""

    position_m: tuple[float, float, float]
    yaw_rad: float
    range_error_m: float
    range_error_share: float
    """The larger of the two bounds the error of its ranges."""
    azimuth_error_rad: float
    """Bounds the error of a track's direction in N: of the unit, its bracket, and the estimate."""


@dataclass(frozen=True)
class VehicleParameters:
    """`vehicle.toml`. The twin's MJCF is held against it by a test."""

    outline: Outline
    wheelbase_m: float
    track_m: float
    wheel_radius_m: float
    steering: Steering
    lidar: Lidar
    lidar_mounts: dict[str, LidarMount]
    sonar: Sonar
    sonar_mounts: dict[str, SonarMount]
    """In the order of `SonarScan.range_m`."""
    radars: dict[str, Radar]
    """By the names of `nav.messages.device`: one or none."""
    gps_position_m: tuple[float, float, float]
    imu_position_m: tuple[float, float, float]
