"""What stands beside a desert track: rocks, brush, posts and bales, a few of them within reach.

Every thing either stays outside the corridor or leaves `FREE_M` of it on the other side.
"""

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from scenarios.chunks import Chunks
from scenarios.course import Floats
from scenarios.geometry import Pose
from scenarios.route.corridor import CHUNK_M, Corridor
from scenarios.things import Site, generator
from twin.world import Obstacle, Terrain

BESIDE_M = 3.0
"""Things stand up to so far beside the corridor."""
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


@dataclass(frozen=True, eq=False)
class Roadside:
    """Draws what stands along one stretch after the other."""

    seed: int
    terrain: Terrain
    corridor: Corridor
    reaches: bool = True
    """Whether a few of the things reach into the corridor."""

    def __call__(self, k: int) -> tuple[Obstacle, ...]:
        """All things of chunk k, in driving order."""
        rng = generator(self.seed, f"roadside {k}")
        first, last = k * CHUNK_M, min((k + 1) * CHUNK_M, self.corridor.way_m)
        drawn = rng.uniform(0.2 * SPACING_M, 1.8 * SPACING_M, int(CHUNK_M / SPACING_M))
        stations = max(first, CLEAR_START_M) + np.cumsum(drawn)
        share = REACHING_SHARE if self.reaches else 0.0
        parts: list[Obstacle] = []
        rest_until = first + REST_M  # of what may stand at the end of the chunk before
        for i, station in enumerate(stations[stations < last].tolist()):
            kind = str(rng.choice(list(SHARES), p=list(SHARES.values())))
            wants_in = station >= rest_until and rng.uniform() < share
            pose, inside = _place(rng, self.corridor, station, RADIUS_M[kind], wants_in)
            if inside:
                rest_until = station + REST_M
            if inside or self.corridor.outside(pose, RADIUS_M[kind]):
                parts += _thing(rng, Site(f"{kind}_{k:04d}_{i}", kind, self.terrain, pose))
        return tuple(parts)


def scenery(seed: int, terrain: Terrain, waypoint_m: Floats, half_width_m: Floats) -> Chunks:
    """All things beside the route, shape (n, 2) and (n,), world frame [m]."""
    corridor = Corridor.of(waypoint_m, half_width_m)
    middle_m, radius_m = corridor.chunk_circles(BESIDE_M)
    return Chunks(middle_m, radius_m, Roadside(seed, terrain, corridor))


def _place(
    rng: np.random.Generator, corridor: Corridor, station: float, radius: float, wants_in: bool
) -> tuple[Pose, bool]:
    """A place for a thing, and whether it reaches into the corridor."""
    k, along = corridor.place(station)
    width = float(corridor.half_width_m[k])
    side, depth = float(rng.choice((1.0, -1.0))), float(rng.uniform())
    reach = max(FREE_M - width, -0.5)  # from this far on its own side; negative: across the line
    calm = min(along, float(corridor.length_m[k]) - along) > CALM_M
    inside = wants_in and calm and reach < width - 0.2
    near = reach + depth * (width - reach) if inside else width + 0.3 + BESIDE_M * depth
    turn = float(rng.uniform(-pi, pi))
    pose = corridor.pose(station).moved(0.0, side * (near + radius), turn)
    return pose, inside and corridor.outside(pose, radius, but=k)


def _thing(rng: np.random.Generator, site: Site) -> list[Obstacle]:
    size, shape = float(rng.uniform(0.6, 1.0)), float(rng.uniform(0.6, 0.95))
    radius = RADIUS_M[site.kind] * size
    if site.kind == "rock":
        return [site.box("", site.pose, (radius * cos(shape), radius * sin(shape)), 0.8 * size)]
    if site.kind == "hay_bale":
        return site.bales(2)
    return [site.cylinder("", site.pose, radius, 1.2 * size)]
