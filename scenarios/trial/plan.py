"""`scenario.toml` of a trial: one short course that puts the navigator to one test."""

from importlib import resources

import msgspec

from scenarios.planned import Point, Thing


class _Strict(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    pass


class Hole(_Strict, frozen=True):
    """See `twin.landforms.Pit`."""

    at_m: Point
    radius_m: float
    depth_m: float


class Edge(_Strict, frozen=True):
    """See `twin.landforms.DropOff`."""

    from_m: Point
    to_m: Point
    depth_m: float
    shift_m: float = 0.0
    """The seed moves it sideways by at most this."""


class RoadPlan(_Strict, frozen=True):
    """See `twin.world.Road`."""

    line_m: list[Point]
    width_m: float
    unseen_m: list[Point] = []
    sun_deg: Point | None = None
    """Azimuth, counter-clockwise from east, and elevation."""


class Waypoint(_Strict, frozen=True, array_like=True):
    """x, y [m], half-width of the corridor [m], and the speed limit [mph] from here on."""

    x_m: float
    y_m: float
    half_width_m: float
    speed_mph: float


class Trial(_Strict, frozen=True):
    """The whole file, but for what every scenario has; see `scenarios.scenario_file`."""

    title: str
    course: str
    time_limit_s: float
    waypoints: list[Waypoint]
    stuck_s: float = 150.0
    friction: float = 0.8
    bumps: float = 1.0
    """Factor on the height of the rolling ground."""
    things: list[Thing] = []
    holes: list[Hole] = []
    edges: list[Edge] = []
    faults: list[str] = []
    """See `twin.faults.parse`."""
    road: RoadPlan | None = None


def load(package: str) -> Trial:
    """The trial that belongs to a package.

    Raises:
        msgspec.ValidationError: an unknown or missing key or a wrong type; names its path.
    """
    text = (resources.files(package) / "scenario.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=Trial)
