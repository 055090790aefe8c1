"""`layout.toml` as data: the legs of the course, their limits, and what stands on them."""

from importlib import resources

import msgspec


class Thing(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Something on a leg. Its place is nominal: the seed moves it."""

    kind: str
    at_m: float
    """From the beginning of the leg's straight."""
    offset: bool = False
    """Of a gate: the opening lies well off the route line."""
    layers: int = 2
    """Of hay bales."""
    length_m: float = 0.0
    """Of a pass: along the track."""


class Limit(msgspec.Struct, forbid_unknown_fields=True, frozen=True, array_like=True):
    """Speed limit and corridor from a place on the leg onwards."""

    from_m: float
    speed_mph: float
    half_width_ft: float


class Leg(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """A straight to a corner, and the turn there."""

    to_m: tuple[float, float]
    limits: list[Limit]
    things: list[Thing] = []
    turn_radius_m: float = 0.0
    turn_mph: float = 10.0


class Layout(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """The whole file."""

    anchor_deg: tuple[float, float]
    start_m: tuple[float, float]
    satellites: list[tuple[float, float]]
    """Azimuth, counter-clockwise from east, and elevation."""
    legs: list[Leg]


def load_layout() -> Layout:
    """The layout that belongs to this package."""
    text = (resources.files("scenarios.nqe") / "layout.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=Layout)
