"""A thing as a file plans it, and as it stands then on the ground."""

from dataclasses import replace
from math import radians
from typing import Literal

import msgspec

from scenarios.geometry import Point, Pose
from scenarios.things import SUNK_M, Site, generator
from twin.world import Obstacle, Terrain


class Thing(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """A box or a cylinder; the seed moves it."""

    kind: str
    at_m: Point
    half_m: Point
    """Half length and half width; of a cylinder its radius, twice."""
    height_m: float = 1.2
    bottom_m: float = -SUNK_M
    """Of a box: above 0 for what hangs."""
    yaw_deg: float = 0.0
    shape: Literal["box", "cylinder"] = "box"
    shift_m: float = 0.3
    """The seed moves it by at most this, along x and y."""
    seen_by: str = ""
    """Of a phantom: the one scanner that sees it."""

    def __post_init__(self) -> None:
        if min(self.half_m) <= 0.0:
            raise ValueError(f"expected half_m above 0, found {self.half_m}")
        if self.height_m <= self.bottom_m:
            raise ValueError(f"expected height_m above bottom_m, found {self.height_m:g}")


def obstacle(k: int, thing: Thing, ground: Terrain, seed: int) -> Obstacle:
    """The k-th thing of a file, as `seed` moves it."""
    east, north = generator(seed, f"thing_{k}").uniform(-thing.shift_m, thing.shift_m, 2)
    x, y = thing.at_m[0] + float(east), thing.at_m[1] + float(north)
    pose = Pose(x, y, radians(thing.yaw_deg))
    site = Site(f"{thing.kind}_{k}", thing.kind, ground, pose)
    if thing.shape == "cylinder":
        stands = site.cylinder("", pose, thing.half_m[0], thing.height_m)
    else:
        stands = site.box("", pose, thing.half_m, thing.height_m, thing.bottom_m)
    return replace(stands, seen_by=thing.seen_by)
