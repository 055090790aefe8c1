"""How far the ego state trusts each sensor, and how it starts."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Motion:
    """What dead reckoning gets wrong: densities of white noise."""

    acceleration_mps2: float
    """Unknown acceleration, [m/s^2 / sqrt(Hz)]."""
    brisk_mps2: float
    """As much is felt along the vehicle on slopes and bumps; what is more, adds to it ..."""
    braking_share: float
    """... or this share of it under hard brakes, when the IMU tells how fast the speed falls."""
    hard_brake: float
    """More than this of the brake's travel can let the wheels slide."""
    slip_m: float
    """Position error by slip and ground, [m / sqrt(m)] of way."""
    gyro_radps: float
    """[rad/s / sqrt(Hz)]."""
    gyro_bias_radps: float
    """Drift of the gyro's bias, [rad/s / sqrt(s)]."""
    gyro_bias_start_radps: float
    steering_per_m: float
    """Without an IMU: error of the curvature that the steering angle gives, [1/m / sqrt(Hz)]."""


@dataclass(frozen=True)
class Wheels:
    """The wheels' speed."""

    sd_mps: float
    sd_share: float
    """Added, as a share of the speed."""
    slide_sd_mps: float
    """Added under hard brakes, where the wheels turn slower than the vehicle drives."""
    scale_start: float
    """Standard deviation of the unknown scale (rolling radius, slip) at the start."""
    scale_drift: float
    """[1 / sqrt(s)]."""
    still_mps: float
    """Slower wheels stand still: then the gyro shows its bias."""
    still_sd_mps: float
    """What the speed may be then, one sigma."""
    still_gyro_sd_radps: float


@dataclass(frozen=True)
class Gps:
    """Its error is a slow offset of the size that the receiver states, and a little white noise."""

    offset_s: float
    """Correlation time of the offset."""
    white_m: float
    white_share: float
    """Added, as a share of the stated standard deviation."""
    redraw_ratio: float
    """A stated standard deviation that changes by more from one fix to the next: a new offset."""
    redraw_s: float
    """A gap in the fixes after which the offset is another."""
    velocity_sd_mps: float
    sideslip_rad: float
    """Of the course against the heading."""
    course_mps: float
    """Slower than this, the course says nothing."""
    rock_share: float
    """Share of the antenna's rocking speed that latency leaves unexplained."""


@dataclass(frozen=True)
class Compass:
    """Its error is a slow bias and noise, taken large because neighbours are alike."""

    bias_start_rad: float
    bias_drift_rad: float
    """[rad / sqrt(s)]."""
    sd_rad: float


@dataclass(frozen=True)
class Gate:
    """Which measurements are outliers."""

    sd: float
    """Innovations beyond this many standard deviations are refused ..."""
    patience_s: float
    """... unless they have been refused for this long: then the estimate was wrong."""


@dataclass(frozen=True)
class Start:
    """When the ego state is ready."""

    settle_s: float
    """From the first heading and position to `ready`."""
    compass_wait_s: float
    """How long to wait for a compass that does not speak before other headings are taken."""
    course_sd_rad: float
    crew_sd_rad: float
    """Of the heading that the crew states."""


@dataclass(frozen=True)
class EgoParameters:
    """`ego_state.toml`."""

    imu_patience_s: float
    """An IMU silent for longer is missing: the steering angle stands in."""
    erection_s: float
    """Time in which the vertical gyro erects its vertical."""
    motion: Motion
    wheels: Wheels
    gps: Gps
    compass: Compass
    gate: Gate
    start: Start
