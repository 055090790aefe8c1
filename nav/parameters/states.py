"""Parameters of the state machine (Fig. 6.3)."""

from dataclasses import dataclass


@dataclass(frozen=True)
class TunnelParameters:
    """Tunnel Mode: GPS gone and a wall on either side."""

    gps_lost_s: float
    wall_max_m: float
    """A side sonar that reads less than this sees a wall."""
    leave_open_s: float
    """Both sides open for this long: out of the tunnel, even without GPS."""
    gps_back_s: float
    """GPS present for this long: out of the tunnel, once the sides are open."""
    axis_gain: float
    """Share by which a new measurement of the centre line moves the old one, per decision."""
    speed_mps: float


@dataclass(frozen=True)
class StateParameters:
    """`states.toml`."""

    warm_up_s: float
    """Stand still this long after the ego state is ready, so that the map fills."""
    tunnel: TunnelParameters
