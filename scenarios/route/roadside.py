"""What stands beside a desert track: rocks, brush, posts and bales, a few of them within reach.

Every thing either stays outside the corridor or leaves `FREE_M` of it on the other side.
"""

from dataclasses import dataclass
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scenarios.chunks import Chunks
from scenarios.course import Floats
from scenarios.geometry import Pose
from scenarios.things import Site, generator
from twin.world import Obstacle, Terrain

CHUNK_M = 100.0
"""Of the route: what is drawn at once."""
BESIDE_M = 3.0
"""Things stand up to so far beside the corridor."""
THING_M = 8.0
"""No thing is larger, with half of the 5 m from one point of a chunk's circle to the next."""
SPACING_M = 14.0
"""Mean distance from one thing to the next, both sides together."""
REACHING_SHARE = 0.15
"""Of all things that may: these stand in the corridor."""
FREE_M = 2.9
"""Of the corridor, beside a thing that stands in it: nearly twice the vehicle's width."""
CLEAR_START_M = 25.0
CALM_M = 12.0
"""Nothing reaches in so near to a waypoint, where the track turns."""
REST_M = 30.0
"""From one thing that reaches in to the next."""
SHARES = {"rock": 0.4, "brush": 0.35, "post": 0.15, "hay_bale": 0.1}
RADIUS_M = {"rock": 0.75, "brush": 0.6, "post": 0.08, "hay_bale": 1.05}
"""Of the circle that holds it."""


class Corridor(NamedTuple):
    """Segments of the route, arrays of shape (n, 2) and (n,)."""

    start_m: Floats
    direction: Floats
    length_m: Floats
    half_width_m: Floats
    end_m: Floats
    """Station of each segment's end."""

    @property
    def way_m(self) -> float:
        """Length of the route."""
        return float(self.end_m[-1])

    def segment(self, station_m: Floats) -> NDArray[np.int64]:
        """On which segment stations lie, shape (k,)."""
        return np.minimum(np.searchsorted(self.end_m, station_m), len(self.end_m) - 1)

    def at(self, station_m: Floats) -> Floats:
        """Points of the route's line, shape (k, 2)."""
        k = self.segment(station_m)
        along = np.minimum(station_m, self.way_m) - (self.end_m - self.length_m)[k]
        return self.start_m[k] + along[:, None] * self.direction[k]


@dataclass(frozen=True, eq=False)
class Roadside:
    """Draws what stands along one stretch after the other."""

    seed: int
    terrain: Terrain
    corridor: Corridor

    def __call__(self, k: int) -> tuple[Obstacle, ...]:
        """All things of chunk k, in driving order."""
        rng = generator(self.seed, f"roadside {k}")
        first, last = k * CHUNK_M, min((k + 1) * CHUNK_M, self.corridor.way_m)
        drawn = rng.uniform(0.2 * SPACING_M, 1.8 * SPACING_M, int(CHUNK_M / SPACING_M))
        stations = max(first, CLEAR_START_M) + np.cumsum(drawn)
        parts: list[Obstacle] = []
        rest_until = first + REST_M  # of what may stand at the end of the chunk before
        for i, station in enumerate(stations[stations < last].tolist()):
            kind = str(rng.choice(list(SHARES), p=list(SHARES.values())))
            wants_in = station >= rest_until and rng.uniform() < REACHING_SHARE
            pose, inside = _place(rng, self.corridor, station, RADIUS_M[kind], wants_in)
            if inside:
                rest_until = station + REST_M
            if inside or _outside(self.corridor, pose, RADIUS_M[kind]):
                parts += _thing(rng, Site(f"{kind}_{k:04d}_{i}", kind, self.terrain, pose))
        return tuple(parts)


def scenery(seed: int, terrain: Terrain, waypoint_m: Floats, half_width_m: Floats) -> Chunks:
    """All things beside the route, shape (n, 2) and (n,), world frame [m]."""
    corridor = corridor_of(waypoint_m, half_width_m)
    middle_m, radius_m = chunk_circles(corridor)
    return Chunks(middle_m, radius_m, Roadside(seed, terrain, corridor))


def chunk_circles(corridor: Corridor) -> tuple[Floats, Floats]:
    """Circles that hold the chunks with all that may stand there: middles (n, 2), radii (n,)."""
    count = max(int(np.ceil(corridor.way_m / CHUNK_M)), 1)
    station = np.linspace(0.0, 1.0, 21) * CHUNK_M + np.arange(count)[:, None] * CHUNK_M
    point = corridor.at(station.ravel()).reshape(count, -1, 2)
    middle = point.mean(axis=1)
    radius = np.hypot(*np.moveaxis(point - middle[:, None], -1, 0)).max(axis=1)
    k = corridor.segment(station.ravel()).reshape(count, -1)
    return middle, radius + corridor.half_width_m[k].max(axis=1) + BESIDE_M + THING_M


def corridor_of(waypoint_m: Floats, half_width_m: Floats) -> Corridor:
    """The segments between waypoints."""
    span = np.diff(waypoint_m, axis=0)
    length = np.hypot(*span.T)
    ends = np.cumsum(length)
    return Corridor(waypoint_m[:-1], span / length[:, None], length, half_width_m[:-1], ends)


def _place(
    rng: np.random.Generator, corridor: Corridor, station: float, radius: float, wants_in: bool
) -> tuple[Pose, bool]:
    """A place for a thing, and whether it reaches into the corridor."""
    k = int(np.searchsorted(corridor.end_m, station))
    along = station - float(corridor.end_m[k] - corridor.length_m[k])
    width, (cx, cy) = float(corridor.half_width_m[k]), corridor.direction[k]
    side, depth = float(rng.choice((1.0, -1.0))), float(rng.uniform())
    reach = max(FREE_M - width, -0.5)  # from this far on its own side; negative: across the line
    calm = min(along, float(corridor.length_m[k]) - along) > CALM_M
    inside = wants_in and calm and reach < width - 0.2
    near = reach + depth * (width - reach) if inside else width + 0.3 + BESIDE_M * depth
    x, y = (float(v) for v in corridor.start_m[k])
    base = Pose(x, y, float(np.arctan2(cy, cx)))
    turn = float(rng.uniform(-pi, pi))
    pose = base.moved(along, side * (near + radius), turn)
    return pose, inside and _outside(corridor, pose, radius, but=k)


def _outside(corridor: Corridor, pose: Pose, radius: float, but: int = -1) -> bool:
    """Whether a circle touches no segment's corridor (except that of segment `but`)."""
    away = np.array((pose.x, pose.y)) - corridor.start_m
    along = np.clip((away * corridor.direction).sum(axis=1), 0.0, corridor.length_m)
    gap = np.hypot(*(away - along[:, None] * corridor.direction).T) - corridor.half_width_m - radius
    gap[but if but >= 0 else slice(0, 0)] = np.inf
    return bool((gap > 0.1).all())


def _thing(rng: np.random.Generator, site: Site) -> list[Obstacle]:
    size, shape = float(rng.uniform(0.6, 1.0)), float(rng.uniform(0.6, 0.95))
    radius = RADIUS_M[site.kind] * size
    if site.kind == "rock":
        return [site.box("", site.pose, (radius * cos(shape), radius * sin(shape)), 0.8 * size)]
    if site.kind == "hay_bale":
        return site.bales(2)
    return [site.cylinder("", site.pose, radius, 1.2 * size)]
