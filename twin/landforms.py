"""Things of the ground itself: holes, and edges where it falls away."""

from dataclasses import dataclass
from math import cos, sin
from typing import Protocol

import numpy as np

from twin.world import Floats


class Landform(Protocol):
    """A pure function of position, added to the ground."""

    def height(self, x: Floats, y: Floats) -> Floats:
        """What it adds to the ground [m] at world positions x, y [m]."""
        ...


def ridge(out_m: Floats, height_m: Floats | float, slope: Floats | float, crest_m: float) -> Floats:
    """Heights of a ridge `out_m` behind its foot: up by `slope`, flat for `crest_m`, and down; none
    in front of it and behind it, [m]."""
    back_m = 2.0 * height_m / slope + crest_m - out_m
    return np.clip(np.minimum(out_m, back_m) * slope, 0.0, height_m)


@dataclass(frozen=True)
class Pit:
    """A round hole with a flat bottom and a wall a lattice cell wide."""

    center_m: tuple[float, float]
    radius_m: float
    depth_m: float

    def height(self, x: Floats, y: Floats) -> Floats:
        """Minus the depth inside."""
        inside = np.hypot(x - self.center_m[0], y - self.center_m[1]) <= self.radius_m
        return np.where(inside, -self.depth_m, 0.0)


@dataclass(frozen=True)
class DropOff:
    """On the right of a line, seen from its start, the ground falls away."""

    start_m: tuple[float, float]
    end_m: tuple[float, float]
    depth_m: float
    reach_m: float = 40.0
    """The low ground is as wide as this."""

    def height(self, x: Floats, y: Floats) -> Floats:
        """Minus the depth beyond the line."""
        (ax, ay), (bx, by) = self.start_m, self.end_m
        length = float(np.hypot(bx - ax, by - ay))
        cx, cy = (bx - ax) / length, (by - ay) / length
        along = (x - ax) * cx + (y - ay) * cy
        right = (x - ax) * cy - (y - ay) * cx
        low = (along >= 0.0) & (along <= length) & (right >= 0.0) & (right <= self.reach_m)
        return np.where(low, -self.depth_m, 0.0)


@dataclass(frozen=True)
class Gully:
    """A trench along a line, with sides a lattice cell wide."""

    middle_m: tuple[float, float]
    heading_rad: float
    half_length_m: float
    half_width_m: float
    depth_m: float

    def height(self, x: Floats, y: Floats) -> Floats:
        """Minus the depth inside."""
        c, s = cos(self.heading_rad), sin(self.heading_rad)
        along = c * (x - self.middle_m[0]) + s * (y - self.middle_m[1])
        left = c * (y - self.middle_m[1]) - s * (x - self.middle_m[0])
        inside = (np.abs(along) <= self.half_length_m) & (np.abs(left) <= self.half_width_m)
        return np.where(inside, -self.depth_m, 0.0)
