"""Parameters of the environment sensor fusion: the ground profile and the obstacle map."""

from dataclasses import dataclass


@dataclass(frozen=True)
class GroundParameters:
    """How ground is told from obstacles: see `nav.fusion.ground_profile`."""

    cell_m: float
    step_m: float
    """A point this high above the ground's bound is no ground, at the vehicle."""
    tilt_rad: float
    """What attitude and mounting errors add to `step_m`, a metre of distance."""
    slope: float
    """Steepest ground between neighbouring known cells."""
    curvature_pm: float
    """Sharpest bend of ground that has not been seen yet, [1/m]."""
    reach_m: float
    """How far known ground says something about its surroundings."""
    teaching_slope: float
    """Only scanners mounted to fall at least this much per metre teach the ground ..."""
    spare_slope: float
    """... or, when all of those are lost, this much."""
    teaching_range_m: float
    bump_m: float
    """What stands this high out of its own scan is no ground, however the scan is tilted."""
    flat_m: float
    """What stands out no higher is bare ground: the foot of a bale is none."""
    bump_beams: int
    """To either side of a beam: a bump is narrower than these."""
    doubt_m: float
    """How far a known height may exceed what the ground around it lets expect."""
    gain: float
    """Weight of a new height against the known one."""
    clearance_m: float
    """What hangs higher does not stand in the way."""

    def __post_init__(self) -> None:
        _positive(self)


@dataclass(frozen=True)
class ConfidenceParameters:
    """How confidence in a cell, 0 to 1, comes and goes: see `nav.fusion.obstacle_map`."""

    hit: float
    """One return; at most two count at once."""
    occupied: float
    """From here on a cell is an obstacle."""
    clear_ps: float
    """Loss where a beam passes through the cell, [1/s]."""
    fade_ps: float
    """Loss where a beam ends at the cell's distance and never in it, [1/s]."""
    margin_m: float
    """How far a beam must go on beyond a cell to have passed it."""
    low_m: float
    """What is lower than this lies below the beams of all level scanners."""
    radar: float
    """So much more a return counts where a radar's track agrees."""
    sonar: float
    """One echo."""
    sonar_limit: float
    """Echoes alone never lift a cell beyond this."""

    def __post_init__(self) -> None:
        _positive(self)
        if self.hit >= self.occupied:
            raise ValueError(f"hit is {self.hit}; must be below occupied, {self.occupied}")


@dataclass(frozen=True)
class NegativeParameters:
    """How drops are found: see `nav.fusion.negative_obstacles`."""

    enabled: bool
    drop_m: float
    """So far below the floor a beam must have passed."""
    doubt_m: float
    """What lies so far below the floor, or below and above its neighbours in a scan, is no
    continuation of the known ground and teaches nothing."""
    low_m: float
    """Where there is no floor, what is near teaches down to this far below the plane."""
    curvature_pm: float
    """Sharpest bend downwards of ground that has not been seen yet, [1/m]."""
    near_m: float
    """How far known ground says how low its surroundings may lie."""
    frontier_m: tuple[float, float]
    """The known ground from the first distance ahead says how it goes on, if some of it lies beyond
    the second."""
    reach_m: float
    """Beams that cross the plane farther away say nothing."""
    fall_min: float
    """Beams that fall less against the ground, for each metre, say nothing."""
    fan_rad: float
    """Beams farther from the middle of their fan say nothing."""
    least_beams: int
    """So many beams side by side have to show a drop."""
    gain: float
    """Confidence that a tick adds where it shows a drop."""
    clear: float
    """Confidence that a drop loses, a tick, where a steep beam meets ground in its cell."""
    remember_m: float
    """A drop is forgotten so far behind the map's edge."""

    def __post_init__(self) -> None:
        _positive(self)


@dataclass(frozen=True)
class ObstacleMapParameters:
    """`obstacle_map.toml`."""

    cell_m: float
    size_m: float
    scroll_m: float
    """The map moves when the vehicle is farther than this from its middle."""
    max_range_m: float
    """Returns from beyond are left out."""
    scans_per_sensor: int
    """The newest scans of each scanner that one tick takes in."""
    sonar_range_m: float
    """Echoes from beyond are left out."""
    confidence: ConfidenceParameters
    ground: GroundParameters
    negative: NegativeParameters

    def __post_init__(self) -> None:
        _positive(self)
        if self.size_m % (2 * self.ground.cell_m) or not self.scroll_m < self.size_m / 4:
            raise ValueError(
                "size_m must be a multiple of two ground cells, scroll_m a quarter of it"
            )


def _positive(parameters: object) -> None:
    for name, value in vars(parameters).items():
        if isinstance(value, int | float) and not isinstance(value, bool) and not value > 0:
            raise ValueError(f"{name} is {value}; must be positive")
