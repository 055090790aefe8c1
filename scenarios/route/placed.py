"""What a file places along a route, tile by tile, as `scenarios.chunks` wants it."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from math import floor, hypot

import msgspec
import numpy as np

from scenarios.chunks import Chunks
from scenarios.geometry import Point
from scenarios.planned import Thing, obstacle
from twin.earth import to_geodetic, to_world
from twin.pool import REACH_M
from twin.world import ROOM, Obstacle, Terrain

TILE_M = 100.0


@dataclass(frozen=True, eq=False)
class Tiles:
    """Puts up what stands in one tile after the other."""

    seed: int
    terrain: Terrain
    things: Sequence[Thing]
    tiles: Sequence[Sequence[int]]
    """Of each tile, which of the things stand in it."""

    def __call__(self, k: int) -> tuple[Obstacle, ...]:
        """All things of tile k."""
        return tuple(obstacle(n, self.things[n], self.terrain, self.seed) for n in self.tiles[k])


@dataclass(frozen=True, eq=False)
class Both:
    """Draws the chunks of one scenery, then those of another."""

    one: Chunks
    other: Chunks

    def __call__(self, k: int) -> tuple[Obstacle, ...]:
        """All things of chunk k."""
        count = len(self.one.radius_m)
        return self.one.draw(k) if k < count else self.other.draw(k - count)


def placed(seed: int, terrain: Terrain, things: Sequence[Thing]) -> Chunks:
    """The things of a file, at their places in the world frame."""
    numbers = sorted(range(len(things)), key=lambda n: _tile(things[n]))
    tiles = [list(group) for _, group in groupby(numbers, key=lambda n: _tile(things[n]))]
    first = [things[tile[0]].at_m for tile in tiles]
    radius = [max(_reach_m(things[n], first[k]) for n in tile) for k, tile in enumerate(tiles)]
    middle = np.array(first, dtype=float).reshape(-1, 2)
    return Chunks(middle, np.array(radius), Tiles(seed, terrain, things, tiles))


def room(things: Sequence[Thing]) -> dict[str, int]:
    """How many of each shape can be near at once: no more than are near one of them."""
    return {shape: _crowd([t for t in things if t.shape == shape]) for shape in ROOM}


def joined(one: Chunks, other: Chunks) -> Chunks:
    """All of both."""
    middle_m = np.concatenate([one.middle_m, other.middle_m])
    return Chunks(middle_m, np.concatenate([one.radius_m, other.radius_m]), Both(one, other))


def moved(things: Sequence[Thing], origin: Point, anchor: Point) -> tuple[Thing, ...]:
    """Things placed east and north of `origin` [deg], in the plane at `anchor` [deg]."""
    if origin == anchor:
        return tuple(things)
    at_m = np.array([thing.at_m for thing in things], dtype=float).reshape(-1, 2)
    x, y = to_world(anchor, *to_geodetic(origin, *at_m.T))
    return tuple(
        msgspec.structs.replace(thing, at_m=place)
        for thing, place in zip(things, zip(x.tolist(), y.tolist(), strict=True), strict=True)
    )


def _crowd(things: Sequence[Thing]) -> int:
    """What is within reach of one place is not farther from each other than twice the reach."""
    at_m = np.array([thing.at_m for thing in things], dtype=float).reshape(-1, 2)
    own_m = np.array([_reach_m(thing, thing.at_m) for thing in things])
    gaps = (np.hypot(*(at_m - at).T) - own_m - own for at, own in zip(at_m, own_m, strict=True))
    return max((int(np.count_nonzero(gap < 2.0 * REACH_M)) for gap in gaps), default=0)


def _tile(thing: Thing) -> tuple[int, int]:
    return floor(thing.at_m[0] / TILE_M), floor(thing.at_m[1] / TILE_M)


def _reach_m(thing: Thing, middle: Point) -> float:
    """How far from a place a thing can reach."""
    away = hypot(thing.at_m[0] - middle[0], thing.at_m[1] - middle[1])
    return away + hypot(*thing.half_m) + 2.0 * thing.shift_m
