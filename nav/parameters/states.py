"""Parameters of the state machine (Fig. 6.3)."""

from dataclasses import dataclass

from nav.errors import NavError


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
class HealthParameters:
    """When a sensor has failed."""

    devices: tuple[str, ...]
    """What the vehicle should have besides its scanners, by the names of `nav.messages.device`."""
    silent_s: float
    """Silent for longer than this."""
    patience_s: float
    """Failed for longer than this, it is given up."""
    vital: tuple[str, ...]
    """Without these the vehicle stands until they are back."""
    often: int
    """Failed so many times ..."""
    often_s: float
    """... within this, it is given up at once ..."""
    steady_s: float
    """... until it has been good for so long; and so must be what is vital before it is trusted."""


@dataclass(frozen=True)
class AlarmParameters:
    """Alarm: resets of failed sensors, and what a lost one means."""

    reset_every_s: float
    lost_mps: float
    """The speed limit with a sensor lost."""


@dataclass(frozen=True)
class RoadParameters:
    """Road Following: when the road is worth following."""

    enter_confidence: float
    leave_confidence: float
    wide_m: float
    """The corridor's half-width must be at least this: a narrow corridor is the road."""
    join_m: float
    """Way over which the offset from the road's middle is taken back."""


@dataclass(frozen=True)
class RollbackParameters:
    """Rollback: back along the recorded trajectory."""

    close_m: float
    """Stopped with the way free for less than this is dangerously close."""
    back_off_m: float
    """From what was dangerously close it drives back this far."""
    longest_m: float
    """As much of the trajectory is remembered."""
    speed_mps: float
    look_m: float
    """It steers for the point of the trajectory that is this far behind."""


@dataclass(frozen=True)
class StuckParameters:
    """When a vehicle that does not move needs more than patience."""

    stand_s: float
    """Stopped by the rules for this long."""
    behind_rad: float
    """The goal lies this far off the heading, or more ..."""
    behind_s: float
    """... for this long: no forward path leads there."""
    tries: int
    """Sets of robotic operations at one place (six in the paper)."""
    same_tries: int
    """After so many sets at one place, the next goes back for another path."""
    progress_m: float
    """Farther along the route than where it was stuck by this: the trouble is over."""
    detour_reach_m: float
    """The goal point of a way around lies at most this far ahead."""


@dataclass(frozen=True)
class WatchdogParameters:
    """The watchdog of section 6.3."""

    override: str
    """`paper`: regardless of obstacles. `guarded`: over cells of the map, but never into what two
    sensors confirm to be nearer than D_safe."""
    counts_shift_time: bool
    """Whether its timers run while the gear is shifted."""
    still_s: float
    """The position has not changed for this long ..."""
    still_m: float
    """... by this much."""
    outside_s: float
    """In other states than the two main ones for this long."""
    distance_m: float
    """It lets go when the vehicle has come this far ..."""
    longest_s: float
    """... or after this time without success."""
    speed_mps: float
    throttle: float
    """The high value, 0 to 1."""
    answer_s: float
    """The guard reckons with this time before the brakes answer ..."""
    braking_mps2: float
    """... and with this deceleration."""

    def __post_init__(self) -> None:
        if self.override not in ("paper", "guarded"):
            raise NavError(f"override: {self.override!r}; expected paper or guarded")


@dataclass(frozen=True)
class StateParameters:
    """`states.toml`."""

    warm_up_s: float
    """Stand still this long after the ego state is ready, so that the map fills."""
    tunnel: TunnelParameters
    health: HealthParameters
    alarm: AlarmParameters
    road: RoadParameters
    rollback: RollbackParameters
    stuck: StuckParameters
    watchdog: WatchdogParameters
