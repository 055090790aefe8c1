"""`plan.toml` as data."""

from functools import cache
from importlib.resources import files
from typing import NamedTuple

import msgspec

Range = tuple[float, float]


class Stretch(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Waypoints of one kind of country, in driving order."""

    kind: str
    waypoints: int
    spacing: float
    """Relative to that of the others."""
    sharp: int
    """How many turns above 30 degrees, but for those of hairpins."""
    hairpins: int = 0
    ease: float = 0.5
    """0 for what is driven slowly in a narrow corridor, 1 for a dry lake."""


class Speeds(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Speed limits, and the share of the route's length that has each."""

    mph: list[float]
    share: list[float]


class Widths(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Half-widths of the corridor, and the share of the waypoints that has each."""

    ft: list[float]
    share: list[float]


class Robotic(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Two turns that no forward path can take, one to each side."""

    waypoints: tuple[int, int]
    """Numbers of the corners."""
    turn_deg: tuple[float, float]
    spacing: float
    """Of the waypoints around them, relative."""
    half_width_ft: float
    mph: float

    @property
    def segments(self) -> slice:
        """From two waypoints before the first corner to two behind the second."""
        first, last = self.waypoints
        return slice(first - 3, last + 1)


class Beside(NamedTuple):
    """Least and most that the ground rises, or falls, beside the track, [m]."""

    left: Range
    right: Range


class Drop(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Where the ground falls away on the right of the track."""

    waypoints: tuple[int, int]
    """First and last."""
    depth_m: float


class Washouts(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Where the old road has been washed away, straight on behind the corner of a turn."""

    waypoints: tuple[int, ...]
    """Numbers of the corners."""
    behind_m: float
    """From the edge of the corridor to the edge of the gully."""
    half_width_m: float
    half_length_m: float
    depth_m: float


class BlindCorner(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """A tank trap behind a corner, and boulders on the inside of the turn that hide it."""

    waypoint: int
    """Number of the corner."""
    beyond_m: float
    cover_m: float
    boulders_m: tuple[float, ...]
    """From the corner, between the two legs."""
    boulder_half_m: tuple[float, float]
    boulder_top_m: float


class Plan(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """See `plan.toml`."""

    seed: int
    anchor_deg: tuple[float, float]
    miles: float
    first_mile_heading_deg: float
    ring_miles: float
    wander_rad: float
    sharp_deg: tuple[float, float]
    robotic: Robotic
    washouts: Washouts
    blind_corner: BlindCorner
    beside: dict[str, Beside]
    """By kind of stretch."""
    drop: Drop
    stretches: list[Stretch]
    speeds: Speeds
    widths: Widths

    @property
    def waypoints(self) -> int:
        """Of the whole route."""
        return sum(stretch.waypoints for stretch in self.stretches)


@cache
def load_plan() -> Plan:
    """The plan that comes with the scenario."""
    text = (files(__package__ or "") / "plan.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=Plan)
