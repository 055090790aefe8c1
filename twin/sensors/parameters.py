"""`sensors.toml`, and another vehicle's file, as frozen structs; unknown keys are refused."""

from pathlib import Path

import msgspec


class _Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    pass


class Timing(_Strict, frozen=True):
    """When a device measures and when its message arrives."""

    rate_hz: float
    phase_steps: int
    delay_steps: int


class MountingParameters(_Strict, frozen=True):
    """How far a device sits from where the drawing has it."""

    position_sd_m: float
    angle_sd_rad: float


class LidarParameters(Timing, frozen=True):
    """SICK LMS 221."""

    stagger_steps: int
    units: tuple[str, ...]
    beams: int
    half_fan_rad: float
    max_range_m: float
    noise_sd_m: float
    bias_sd_m: float
    turn_s: float
    """Of the mirror; it turns twice for a scan. 0: all beams at once."""
    beam_rad: float
    """Width of a beam: its divergence."""
    edge_m: float
    """A step from beam to beam that is larger than this is an edge."""
    pulse_m: float
    """Echoes of one beam that lie within this of each other melt into one."""
    share: float
    """Of a beam, that a near thing must fill to be heard before a far one."""
    tenth_range_m: float
    """Up to where a surface is seen that reflects a tenth."""
    reflectivity: dict[str, float]
    """By the kind of thing, with `ground` and `other`."""


class SonarParameters(Timing, frozen=True):
    """Massa M-5000/95."""

    units: tuple[str, ...]
    half_cone_rad: float
    min_range_m: float
    max_range_m: float
    noise_sd_m: float
    ground_echo_rad: float
    mirror_rad: float
    """A smooth face that is met at a flatter angle mirrors the sound away."""
    cross_talk: float
    """How often a unit hears another's pulse."""


class RadarParameters(Timing, frozen=True):
    """Eaton VORAD EVT-300."""

    half_beam_rad: float
    rows_rad: tuple[float, ...]
    """Elevations of the rays."""
    rays: int
    """In each row."""
    max_range_m: float
    max_tracks: int
    min_rate_mps: float
    """What comes or goes more slowly is not heard."""
    range_error_m: float
    range_error_share: float
    """The larger of the two bounds the error."""
    rate_error_share: float
    azimuth_error_rad: float
    bound_sigmas: float
    """So many sigma are those bounds; what is drawn beyond ends there."""


class GpsParameters(Timing, frozen=True):
    """NovAtel ProPak-LB with OmniSTAR HP."""

    sky_interval: int
    sky_range_m: float
    horizon_m: float
    """Beyond that range the ground hides satellites as far as this."""
    min_satellites: int
    max_hdop: float
    bias_sd_m: float
    bias_time_s: float
    noise_sd_m: float
    vertical_factor: float
    velocity_sd_mps: float
    reacquire_s: tuple[float, float]
    outage_sd_m: float
    outage_time_s: float
    converged_sd_m: float
    sd_scale_sd: float


class ImuParameters(Timing, frozen=True):
    """Crossbow VG700."""

    gyro_bias_sd_radps: float
    gyro_noise_radps: float
    gyro_walk_radps: float
    """By so much the bias walks in a second, as the square root of time."""
    gyro_scale_sd: float
    accelerometer_bias_sd_mps2: float
    accelerometer_noise_mps2: float
    accelerometer_walk_mps2: float
    accelerometer_scale_sd: float
    tilt_bias_max_rad: float
    tilt_noise_rad: float
    erection_time_s: float


class CompassParameters(Timing, frozen=True):
    """A digital compass."""

    bias_sd_rad: float
    noise_sd_rad: float
    metal_range_m: float
    """Steel farther away turns it no more."""
    metal_share: float
    """Radius of the ball that disturbs the field like a thing of steel, as a share of the cube root
    of its volume."""
    metal_limit: float
    """Of the disturbance, as a share of the Earth's field."""


class OdometryParameters(Timing, frozen=True):
    """Drive-by-wire unit."""

    wheel_radius_m: float
    scale_sd: float
    noise_sd_mps: float
    steering_bias_sd_rad: float
    steering_noise_rad: float
    steering_count_rad: float
    """Of the converter behind the potentiometer."""
    pedal_noise: float
    pedal_count: float
    linkage_noise: float
    """In positions of the linkage ..."""
    linkage_window: float
    """... and how near to one the linkage must be for the gear to be in."""


class RoadCameraParameters(Timing, frozen=True):
    """What the image-processing module makes of its cameras."""

    offset_sd_m: float
    heading_sd_rad: float
    width_sd_m: float
    confidence: float
    blind_confidence: float
    """Where the road cannot be seen."""
    glare_rad: float
    """It is blind when it looks so near to a low sun."""
    glare_elevation_rad: float
    """Higher than this no sun glares."""
    blind_factor: float
    """So much larger are its errors there."""


class SensorParameters(_Strict, frozen=True):
    """The whole file."""

    mounting: MountingParameters
    lidar: LidarParameters
    sonar: SonarParameters
    gps: GpsParameters
    imu: ImuParameters
    compass: CompassParameters
    odometry: OdometryParameters
    radar: RadarParameters | None = None
    """None for a vehicle without."""
    road_camera: RoadCameraParameters | None = None
    """None for a vehicle without."""


def sensor_parameters(name: str = "sensors.toml") -> SensorParameters:
    """Parameters from a file beside this one.

    Raises:
        msgspec.ValidationError: an unknown or missing key or a wrong type; names its path.
    """
    text = Path(__file__).with_name(name).read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=SensorParameters)
