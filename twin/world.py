"""What surrounds the vehicle: terrain, things that stand on it, sky, and where it starts."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from twin.faults import Fault

Floats = NDArray[np.float64]

OPACITY = {"brush": 0.5, "grass": 0.35, "dust": 0.15, "phantom": 1.0}
"""Kinds of obstacle that hold nothing back but beams, and the share of beams (estimated)."""
SIGHT_M = 110.0
"""Nothing is seen or touched from farther away: the corners of the window of ground are 127 m off,
but a LIDAR sees 82 m, from at most 12 m beside the window's middle."""
SILENT = frozenset({"dust"})
"""Kinds that sound passes."""
METAL = frozenset({"car", "tunnel", "tank_trap"})
"""Kinds of steel: they turn a compass."""
SOFT = frozenset({"rumble_strip", *OPACITY})
"""Kinds of obstacle that a vehicle may touch."""
ROOM: Mapping[str, int] = {"box": 24, "cylinder": 16}
"""How many of a shape are near at most, where a seed draws them along a way."""


class Scenery(Protocol):
    """What stands along a way that is too long to hold all of it: a pure function of position."""

    def around(self, x_m: float, y_m: float) -> "tuple[Obstacle, ...]":
        """All that stands within `SIGHT_M` of a place, and perhaps more; the same object as the
        last time where nothing has come or gone."""
        ...

    def everything(self) -> "tuple[Obstacle, ...]":
        """For pictures."""
        ...


class Terrain(Protocol):
    """A pure function of position: the same height for the same place, whenever it is asked."""

    def height(self, x: Floats, y: Floats) -> Floats:
        """Ground height [m] at world positions x, y [m]; any matching shapes."""
        ...


@dataclass(frozen=True)
class Obstacle:
    """A rigid thing: a box with half sizes, or an upright cylinder with radius, -, half height."""

    name: str
    kind: str
    """`gate_post`, `gate_flank`, `tunnel`, `car`, `hay_bale`, `tires`, `rumble_strip`, ..."""
    shape: str
    """`box` or `cylinder`."""
    center_m: tuple[float, float, float]
    half_size_m: tuple[float, float, float]
    quat: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    """Orientation, w x y z."""
    owner: str = ""
    """The thing it is a part of: two boxes make one car. Contacts are counted per owner."""
    seen_by: str = ""
    """Of a phantom: the one scanner that sees it."""


@dataclass(frozen=True)
class Road:
    """What the image-processing module can see: a road on the ground."""

    line_m: tuple[tuple[float, float], ...]
    """Its middle, at least two points."""
    width_m: float
    unseen_m: tuple[tuple[float, float], ...] = ()
    """Stretches, from station to station, on which nothing can be made out."""
    sun_rad: tuple[float, float] | None = None
    """Azimuth, counter-clockwise from east, and elevation: towards a low sun the camera sees
    glare."""


@dataclass(frozen=True)
class World:
    """Everything outside the vehicle, as one episode's seed drew it. World frame: ENU, metres."""

    terrain: Terrain
    obstacles: tuple[Obstacle, ...]
    """All that stands there; none where there is a `scenery`."""
    friction: float
    """Coefficient of the ground."""
    anchor: tuple[float, float]
    """Latitude and longitude of the world's origin, [deg]."""
    start: tuple[float, float, float]
    """x, y [m] and heading [rad] of the reference point."""
    satellites: Floats = field(repr=False, default_factory=lambda: np.zeros((0, 2)))
    """Shape (n, 2): azimuth counter-clockwise from east and elevation, [rad]."""
    faults: tuple[Fault, ...] = ()
    road: Road | None = None
    scenery: Scenery | None = None
    room: Mapping[str, int] = field(default_factory=lambda: dict(ROOM))
    """How many of each shape of the scenery can be near at once."""

    def around(self, x_m: float, y_m: float) -> tuple[Obstacle, ...]:
        """All that can be seen or touched from near a place; the same object as the last time where
        nothing has come or gone."""
        return self.scenery.around(x_m, y_m) if self.scenery else self.obstacles

    def everything(self) -> tuple[Obstacle, ...]:
        """All that stands anywhere."""
        return self.scenery.everything() if self.scenery else self.obstacles
