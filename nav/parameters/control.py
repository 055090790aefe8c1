"""Parameters of the low-level controller."""

from dataclasses import dataclass


@dataclass(frozen=True)
class PathFollowing:
    """Feedback on the pose that the vehicle will have when steering answers."""

    length_m: float
    """An offset decays over this length ..."""
    length_s: float
    """... or this time at higher speed."""
    damping: float
    preview_s: float
    """The path's curvature is averaged over this time ahead: steering winds up slowly."""
    heading_limit_rad: float
    """Offset never asks for a larger approach angle than this."""


@dataclass(frozen=True)
class SpeedControl:
    """PI control of speed on throttle, proportional on brake."""

    feedforward_per_mps: float
    feedforward: float
    feedforward_per_mps2: float
    """While the set point rises."""
    proportional: float
    integral: float
    integral_limit: float
    brake_proportional: float
    brake_band_mps: float
    """Overspeed below this is left to engine braking."""
    acceleration_mps2: float
    """The set point rises no faster than this."""
    hold_brake: float
    stop_mps: float
    """A set point below this means: stand still."""
    stand_mps: float
    """Below this speed the vehicle counts as standing."""


@dataclass(frozen=True)
class OperationControl:
    """Robotic unit operations."""

    steered_rad: float
    """The vehicle starts when the road wheels are this near to their target ..."""
    rolling_mps: float
    """... and once it is faster than this it goes on."""
    braking_mps2: float
    """Towards the end of the operation."""


@dataclass(frozen=True)
class ControlParameters:
    """`control.toml`."""

    path: PathFollowing
    speed: SpeedControl
    operations: OperationControl
    steering_lag_rad: float
    """While the road wheels are farther than this from their target ..."""
    steering_lag_mps: float
    """... the vehicle gets no faster than it is, or than this: it would leave its path."""
    command_timeout_s: float
    """Without a fresh command of the high-level controller the vehicle stops."""
