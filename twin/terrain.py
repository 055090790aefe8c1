"""Ground as a pure function of (seed, position), and the window of it around the vehicle."""

from dataclasses import dataclass
from functools import lru_cache
from math import floor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from twin.landforms import Landform, ridge
from twin.world import Floats, Terrain

Points = tuple[tuple[float, float], ...]

HEIGHT_STEP_M = 2.0**-19
"""Heights are whole multiples of this (2 um): exact in the float32 of a MuJoCo height field."""
Z_TOP_M = 32.0
"""Scale of the height field. A power of two, so that scaling changes no bit."""
LATTICE = 128
"""The noise repeats after this many cells of an octave."""


class Octave(NamedTuple):
    """One scale of the rolling ground."""

    wavelength_m: float
    amplitude_m: float


GENTLE = (Octave(96.0, 0.9), Octave(24.0, 0.10), Octave(4.0, 0.012))
"""Estimated: slopes of some 3 %, bumps of some millimetres. A level LIDAR 0.55 m above it meets the
ground only now and then."""


@dataclass(frozen=True)
class Banks:
    """Slopes on both sides of a track, as in a mountain pass."""

    line_m: Points
    """The middle of the track, at least two points."""
    inner_m: float
    """Half-width of the flat between the feet of the slopes."""
    slope: tuple[float, float]
    """Tangent of the slope on the left and on the right."""
    height_m: float
    taper_m: float = 10.0
    """Over this length the banks rise and end along the track."""

    def height(self, x: Floats, y: Floats) -> Floats:
        """What the banks add to the ground [m] at world positions x, y [m]."""
        added = np.zeros(np.broadcast(x, y).shape)
        near = self._near(x, y)
        if near.any():
            x, y = np.broadcast_arrays(x, y)
            added[near] = self._profile(*self._along(x[near], y[near]))
        return added

    def _near(self, x: Floats, y: Floats) -> NDArray[np.bool_]:
        line = np.array(self.line_m)
        reach = self.inner_m + 2.0 * self.height_m / min(self.slope)
        (west, south), (east, north) = line.min(axis=0) - reach, line.max(axis=0) + reach
        return (x > west) & (x < east) & (y > south) & (y < north)

    def _along(self, x: Floats, y: Floats) -> tuple[Floats, Floats, float]:
        """Station and signed offset (left positive) on the line, and the line's length."""
        station, offset = np.zeros(x.shape), np.full(x.shape, np.inf)
        length = 0.0
        for (ax, ay), (bx, by) in zip(self.line_m, self.line_m[1:], strict=False):
            span = float(np.hypot(bx - ax, by - ay))
            cx, cy = (bx - ax) / span, (by - ay) / span
            u = np.clip((x - ax) * cx + (y - ay) * cy, 0.0, span)
            distance = np.hypot(x - ax - u * cx, y - ay - u * cy)
            side = np.where(cx * (y - ay) - cy * (x - ax) >= 0.0, 1.0, -1.0)
            closer = distance < np.abs(offset)
            station = np.where(closer, length + u, station)
            offset = np.where(closer, side * distance, offset)
            length += span
        return station, offset, length

    def _profile(self, station: Floats, offset: Floats, length: float) -> Floats:
        slope = np.where(offset >= 0.0, self.slope[0], self.slope[1])
        out = np.abs(offset) - self.inner_m
        taper = np.clip(np.minimum(station, length - station) / self.taper_m, 0.0, 1.0)
        return ridge(out, self.height_m, slope, 0.0) * taper


@dataclass(frozen=True)
class RollingGround:
    """Value noise of a few octaves, and features on top. Only sums and products of floats: the
    same bits wherever and however many points are asked at once."""

    seed: int
    octaves: tuple[Octave, ...] = GENTLE
    features: tuple[Landform, ...] = ()

    def height(self, x: Floats, y: Floats) -> Floats:
        """Ground height [m] at world positions x, y [m]; any matching shapes."""
        lattice, origin = _lattice(self.seed)
        z = np.zeros(np.broadcast(x, y).shape)
        for octave, (u0, v0) in zip(self.octaves, origin, strict=False):
            u, v = x / octave.wavelength_m + u0, y / octave.wavelength_m + v0
            z = z + octave.amplitude_m * _noise(lattice, u, v)
        for feature in self.features:
            z = z + feature.height(x, y)
        return np.round(z / HEIGHT_STEP_M) * HEIGHT_STEP_M


@lru_cache(maxsize=8)
def _lattice(seed: int) -> tuple[Floats, Floats]:
    """Values in (-1, 1), shape (LATTICE * LATTICE,), and each octave's origin, shape (8, 2)."""
    entropy = np.random.SeedSequence(seed, spawn_key=tuple(b"terrain"))
    rng = np.random.default_rng(entropy)
    return rng.uniform(-1.0, 1.0, LATTICE * LATTICE), rng.uniform(0.0, LATTICE, (8, 2))


def _noise(lattice: Floats, u: Floats, v: Floats) -> Floats:
    """Value noise: lattice values blended with the quintic fade (Perlin 2002)."""
    i, j = np.floor(u), np.floor(v)
    s, t = _fade(u - i), _fade(v - j)
    west, south = i.astype(np.int64) % LATTICE, j.astype(np.int64) % LATTICE * LATTICE
    east, north = (west + 1) % LATTICE, (south + LATTICE) % (LATTICE * LATTICE)
    a, b = lattice[south + west], lattice[south + east]
    c, d = lattice[north + west], lattice[north + east]
    low, high = a + s * (b - a), c + s * (d - c)
    return low + t * (high - low)


def _fade(s: Floats) -> Floats:
    return s * s * s * (s * (s * 6.0 - 15.0) + 10.0)


class TerrainWindow:
    """A square lattice of heights around the vehicle, scrolled in whole cells.

    `z[row, column]` is the height [m] at (x0 + column * spacing, y0 + row * spacing): exactly what
    MuJoCo sees of its central part, so that LIDAR and contact agree to the bit.
    """

    spacing = 0.5
    """[m]"""
    size = 360
    """Points a side: 90 m each way, farther than a LIDAR reaches."""
    contact_size = 65
    """Points a side of MuJoCo's height field: 16 m each way."""
    slack_m = 8.0
    """How far the vehicle may go from the centre before the window scrolls."""

    _margin = (size - contact_size) // 2
    _middle = _margin + contact_size // 2

    def __init__(self, terrain: Terrain, x: float, y: float) -> None:
        self.terrain = terrain
        self._column, self._row = self._corner(x, y)
        self.z: Floats = np.empty((self.size, self.size))
        self._compute(slice(0, self.size), slice(0, self.size))

    @property
    def x0(self) -> float:
        """World x of column 0, [m]."""
        return self._column * self.spacing

    @property
    def y0(self) -> float:
        """World y of row 0, [m]."""
        return self._row * self.spacing

    @property
    def contact_origin_m(self) -> tuple[float, float, float]:
        """Where the height field `terrain` stands: its middle, and the height that is its zero."""
        return *self._middle_m, float(floor(self._contact_z.min()))

    @property
    def _middle_m(self) -> tuple[float, float]:
        """World x and y of the middle."""
        x = self.x0 + self._middle * self.spacing
        y = self.y0 + self._middle * self.spacing
        return x, y

    def recenter(self, x: float, y: float) -> bool:
        """Scroll so that (x, y) [m] is at the centre, if it is farther than the slack from it.

        Returns:
            True when the window has moved; then `write_hfield` is due.
        """
        middle_x, middle_y = self._middle_m
        if max(abs(x - middle_x), abs(y - middle_y)) <= self.slack_m:
            return False
        column, row = self._corner(x, y)
        right, up = column - self._column, row - self._row
        self._column, self._row = column, row
        self._scroll(right, up)
        return True

    def write_hfield(self, model: Any, data: Any) -> None:
        """Give MuJoCo the central part: the heights to the model, the place to the mocap body.

        Raises:
            ValueError: the ground within reach is higher than the height field can be.
        """
        self.write_heights(model)
        body = model.body("terrain_window").mocapid[0]
        data.mocap_pos[body] = self.contact_origin_m

    def write_heights(self, model: Any) -> None:
        """The part of `write_hfield` that changes the model."""
        relief = self._contact_z - self.contact_origin_m[2]
        if relief.max() > Z_TOP_M:
            raise ValueError(f"relief of {relief.max():.0f} m in 32 m, expected at most {Z_TOP_M}")
        start = model.hfield_adr[model.hfield("terrain").id]
        model.hfield_data[start : start + relief.size] = relief.ravel() / Z_TOP_M

    @property
    def _contact_z(self) -> Floats:
        inner = slice(self._margin, self._margin + self.contact_size)
        return self.z[inner, inner]

    def _corner(self, x: float, y: float) -> tuple[int, int]:
        """Lattice column and row of the corner when (x, y) is at the centre."""
        return round(x / self.spacing) - self._middle, round(y / self.spacing) - self._middle

    def _scroll(self, right: int, up: int) -> None:
        n = self.size
        if max(abs(right), abs(up)) >= n:
            self._compute(slice(0, n), slice(0, n))
            return
        self.z[:] = np.roll(self.z, (-up, -right), axis=(0, 1))
        rows, columns = _entering(up, n), _entering(right, n)
        self._compute(rows, slice(0, n))
        kept = slice(0, rows.start) if up > 0 else slice(rows.stop, n)
        self._compute(kept, columns)

    def _compute(self, rows: slice, columns: slice) -> None:
        y = (self._row + np.arange(rows.start, rows.stop)) * self.spacing
        x = (self._column + np.arange(columns.start, columns.stop)) * self.spacing
        self.z[rows, columns] = self.terrain.height(x[None, :], y[:, None])


def _entering(step: int, n: int) -> slice:
    """The lines that are new after scrolling by `step` of n."""
    return slice(n - step, n) if step > 0 else slice(0, -step)
