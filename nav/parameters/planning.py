"""Parameters of the high-level controller's path planning."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Footprint:
    """The vehicle as discs along its axis, so that paths are checked with its whole length."""

    disc_x_m: tuple[float, ...]
    """Centres, vehicle frame."""
    touch_radius_m: float
    """Covers the outline and nothing more."""
    real_radius_m: float
    """Half the vehicle (section 6.4.2.1), plus a cell of the map."""
    safe_radius_m: float
    """The further enlargement."""
    corridor_touch_m: float
    """A disc's centre this far inside the corridor's edge keeps the tires inside ..."""
    corridor_real_m: float
    """... and this far is aimed at."""
    corridor_safe_m: float
    escape_m: float
    """A vehicle that stands inside a boundary may take this far to leave it ..."""
    escape_slack_m: float
    """... inside the real one not this much longer than the direction that leaves it soonest ..."""
    escape_touch_m: float
    """... and this far where the outline itself seems to touch, for the map is not exact."""


@dataclass(frozen=True)
class Scanning:
    """The fan of directions of Fig. 6.6."""

    directions: int
    """Odd, so that straight ahead is one of them."""
    half_angle_rad: float
    max_distance_m: float
    """d_max."""
    step_m: float
    lateral_mps2: float
    """A turn towards a direction keeps below this."""
    radius_margin: float
    """Its radius is this much larger than the smallest that the vehicle can turn."""
    slowest_mps: float
    """Steering is taken to wind up at least at this speed: near standstill it has all the time."""


@dataclass(frozen=True)
class LocalPathParameters:
    """The ten pathpoints of section 6.4."""

    look_ahead_m: float
    """The route is looked at this far ahead."""
    shortest_m: float
    """A path is at least this long, however near the obstacle ..."""
    answer_s: float
    """... and where the outline has room, this long in time: until the steering has answered."""
    horizon_s: float
    min_length_m: float
    max_length_m: float
    join_stretch: float
    """A lateral offset is taken back over this much more than the shortest way that the
    steering's rate allows."""
    join_min_m: float
    join_offset_m: float
    """Below this offset the path is the smooth path itself."""
    arrival_m: float
    """The end of the route is reached no farther beside it than this."""
    turn_rad: float
    """In Obstacle Avoidance a decision this far off the local path's end makes a new one."""
    goal_s: float
    """The goal point lies this far ahead on the smooth path, in seconds ..."""
    goal_min_m: float
    """... and at least this far, in metres."""


@dataclass(frozen=True)
class SpeedProfileParameters:
    """Speed along the route before any obstacle is known."""

    lateral_mps2: float
    braking_mps2: float
    cap_mps: float
    """The vehicle's own limit ..."""
    open_mps: float
    """... and the one on an open track: its limit is at least ..."""
    open_limit_mps: float
    """... this, and its corridor ..."""
    open_half_width_m: float
    """... narrower than this: few things leave a way past them. Those are seen at 11 to 12 m."""
    wide_mps: float
    """Where the limit is as high, and the corridor wider."""
    limit_factor: float
    """Share of the speed limit that is aimed at, so that control errors stay below it."""
    avoid_mps: float
    """While an obstacle is on the smooth path: slow enough to swerve."""
    narrow_mps: float
    """Where the path runs inside a safe boundary."""
    settle_mps: float
    """Off the smooth path ..."""
    settle_m: float
    """... by so much to the side, or ..."""
    settle_rad: float
    """... in heading, where ..."""
    settle_half_width_m: float
    """... the corridor is narrower than this to each side, ..."""
    settle_ahead_m: float
    """... here or within this way."""


@dataclass(frozen=True)
class Operations:
    """Robotic unit operations: arcs back and forth (section 6.3)."""

    lengths_m: tuple[float, ...]
    """An operation is as long as one of these, ascending, multiples of 0.25 m."""
    radius_margin: float
    """Arcs have the smallest turning radius times this."""
    margin_m: float
    """An arc ends this far before what it would touch."""
    shift_cost_m: float
    """A change between forwards and reverse costs as much as this way."""
    tight_cost: float
    """A metre inside the real boundary costs so many metres more."""
    turn_cost_m: float
    """Guess of what a radian off the goal's direction will still cost."""
    exit_m: float
    """A forward path is free when it is so for this far ..."""
    exit_rad: float
    """... in a direction this near to the goal's."""
    exit_directions: int
    most_way_m: float
    """All operations together are no longer: what is farther back is for Rollback."""
    most_poses: int
    """The search gives up after so many poses."""
    poses_a_decision: int
    speed_mps: float

    @property
    def longest_m(self) -> float:
        """The longest arc that must be looked at."""
        return self.lengths_m[-1] + self.margin_m


@dataclass(frozen=True)
class PlanningParameters:
    """`planning.toml`."""

    footprint: Footprint
    scanning: Scanning
    local_path: LocalPathParameters
    speed: SpeedProfileParameters
    operations: Operations
