"""Parameters of the plausibility of what sensors say."""

from dataclasses import dataclass


@dataclass(frozen=True)
class EvidenceParameters:
    """How much speaks for a doubt."""

    time_s: float
    """Time constant of the share of messages that are implausible."""
    doubt: float
    """A device is doubted once that share exceeds this ..."""
    believe: float
    """... until it has fallen below this."""


@dataclass(frozen=True)
class StepParameters:
    """An offset of a LIDAR comes, or goes."""

    beams: int
    """Of so many beams, ..."""
    span: int
    """... over so many, ..."""
    sway_rad: float
    """... that a pitch of so much between two scans would not move as far, ..."""
    least_m: float
    """... the ranges change from one scan to the next by more ..."""
    alike_m: float
    """... within this of each other ..."""
    alike_share: float
    """... for this share of the beams, ..."""
    quiet_scans: int
    """... and among so many scans before it, and as many after it, ..."""
    quiet_m: float
    """... they change by less."""


@dataclass(frozen=True)
class ScanParameters:
    """LIDAR scans."""

    time_s: float
    """Time constant of the evidence, instead of that of other devices."""
    every_s: float
    """So often one scan of each scanner is looked at."""
    near_m: float
    """Of beams nearer than this, ..."""
    rocking_radps: float
    """... unless the vehicle rolls and pitches faster, ..."""
    steady_m: float
    """... what changes as the neighbour's within this ..."""
    steady_share: float
    """... is a larger share, but for noise ..."""
    least: int
    """... if so many can be judged."""
    step: StepParameters


@dataclass(frozen=True)
class PlausibilityParameters:
    """`plausibility.toml`."""

    evidence: EvidenceParameters
    scan: ScanParameters
    moving_mps: float
    """Faster than this, what a sensor says changes."""
    gps_m: float
    """A fix is this far from where dead reckoning has the antenna, beside what both allow."""
    gps_sd: float
    """So many standard deviations both are allowed."""
    gps_outage_s: float
    """After an outage a receiver may be anywhere, for so long."""
    wheels_mps: float
    """Wheels against the speed of the last fix."""
    sliding_brake: float
    """Wheels that are braked harder may be slower."""
    wheel_step_mps: float
    """Most wheels do not change so fast from one message to the next."""
    compass_rad: float
    """Compass against the estimated heading."""
    gyro_step_radps: float
    """A yaw rate does not change so fast from sample to sample."""
    gyro_radps: float
    """Gyro against steering: so much, and ..."""
    gyro_share: float
    """... this share of what the steering gives."""
    gyro_still_radps: float
    """At a stand."""
    steady_rad: float
    """Steering that moves more within half a second gives no yaw rate to compare with."""
    sonar_step_m: float
    """Half of the sonars do not jump so far from round to round, beside ..."""
    sonar_round_s: float
    """... what the vehicle drives in so long."""
