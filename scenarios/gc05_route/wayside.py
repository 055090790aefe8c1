"""What stands beside the track, on it, and over it, chunk by chunk."""

from dataclasses import dataclass
from math import atan2, copysign, cos, pi, radians, sin

import numpy as np

from scenarios.gc05_route.plan import BlindCorner, load_plan
from scenarios.geometry import Pose
from scenarios.route.corridor import CHUNK_M, Corridor
from scenarios.route.roadside import FREE_M, Roadside
from scenarios.things import BALE_HALF_M, BEAM_HALF_M, CAR_HALF_M, Site, extent_m, generator
from twin.world import Obstacle, Terrain

WIDE_M = 3.5
"""Half-width of a corridor in which something stands on the line itself."""
COVER_M = (0.5, 0.9)
"""How far it reaches across the line."""
CALM_M = 18.0
"""From it to where the track turns."""
SLOTS_M = ((18.0, 36.0), (66.0, 82.0))
"""Of a chunk, for one thing each: at least 30 m apart, as the two cars of the NQE."""
ACROSS_SHARE = 0.8
"""Of the slots that have room for it."""
TRIES = 4
LEAST_M, RUBBLE_HALF_M = 0.2, 0.4
"""Rubble closes the side on which the thing stands: there is one way around it, at least FREE_M
wide, and no second one that is nearly wide enough."""
SHARES = {"rock": 0.45, "car": 0.2, "tank_trap": 0.15, "hay_bale": 0.2}
TRAP_M = 0.7 * BEAM_HALF_M[0]
"""Of three beams, a third of a circle apart, two reach at least so far to the sides."""
HALF_M = {
    "rock": (0.8, 1.0), "car": CAR_HALF_M, "tank_trap": (TRAP_M, TRAP_M),
    "hay_bale": (BALE_HALF_M[1], 2.0 * BALE_HALF_M[0]),
}  # fmt: skip
YAW_RAD = {kind: radians(3.0 if kind == "tank_trap" else 20.0) for kind in HALF_M}
GUARD_SHARE = 0.012
"""Of the chunks: a cattle guard, two posts and bars on the ground between them."""
GUARD_M = (3.4, 4.4)
"""From post to post: between the vehicle's width and the corridor's (estimated)."""
UNDERPASS_M = (3.2, 3.8)
UNDERPASS_HALF_LENGTH_M = 14.0
"""Estimated: under a road of two lanes."""
MISS_M = 0.3
"""Of the route's line beside the middle between the walls."""
CLEAR_M = 30.0
"""Around the place where the drive begins."""


@dataclass(frozen=True, eq=False)
class Wayside:
    """Draws chunk after chunk of the route."""

    seed: int
    terrain: Terrain
    corridor: Corridor
    underpasses_m: tuple[float, ...]
    """Stations of their middles."""
    start_m: tuple[float, float]
    """Where the drive begins, world frame."""

    def __call__(self, k: int) -> tuple[Obstacle, ...]:
        """All things of chunk k."""
        special = self._underpass(k) or self._blind_corner(k) or self._guard(k) or [
            part for slot in range(len(SLOTS_M)) for part in self._across(k, slot)
        ]  # fmt: skip
        roadside = Roadside(self.seed, self.terrain, self.corridor, reaches=not special)
        return tuple(thing for thing in (*roadside(k), *special) if not self._at_start(thing))

    def _at_start(self, thing: Obstacle) -> bool:
        x, y, _ = thing.center_m
        return np.hypot(x - self.start_m[0], y - self.start_m[1]) < CLEAR_M

    def _underpass(self, k: int) -> list[Obstacle]:
        """Walls and a roof over the track."""
        here = [s for s in self.underpasses_m if k * CHUNK_M <= s < (k + 1) * CHUNK_M]
        if not here:
            return []
        rng = generator(self.seed, f"underpass {k}")
        middle = self.corridor.pose(here[0]).moved(0.0, float(rng.uniform(-MISS_M, MISS_M)))
        site = Site(f"underpass_{k:04d}", "tunnel", self.terrain, middle)
        return site.passage(middle, UNDERPASS_HALF_LENGTH_M, float(rng.uniform(*UNDERPASS_M)))

    def _blind_corner(self, k: int) -> list[Obstacle]:
        plan = load_plan().blind_corner
        corner_m = self.corridor.waypoint(plan.waypoint)
        station = corner_m + plan.beyond_m
        if not k * CHUNK_M <= station < (k + 1) * CHUNK_M:
            return []
        come, go = self.corridor.pose(corner_m - 1e-6), self.corridor.pose(station)
        outside = -copysign(1.0, sin(go.heading - come.heading))
        left = outside * (TRAP_M - plan.cover_m)
        trap = Site(f"trap_across_{plan.waypoint}", "tank_trap", self.terrain, go.moved(0.0, left))
        between = come._replace(heading=_between(come.heading + pi, go.heading))
        return trap.tank_trap() + self._boulders(plan, between)

    def _boulders(self, plan: BlindCorner, corner: Pose) -> list[Obstacle]:
        """In a row along the heading."""
        site = Site(f"boulder_{plan.waypoint}", "rock", self.terrain, corner)
        return [
            site.box(f"{i}", corner.moved(away, 0.0), plan.boulder_half_m, plan.boulder_top_m)
            for i, away in enumerate(plan.boulders_m)
        ]

    def _guard(self, k: int) -> list[Obstacle]:
        rng = generator(self.seed, f"guard {k}")
        place = self._straight(k, rng, SLOTS_M[0])
        if rng.uniform() > GUARD_SHARE or place is None:
            return []
        pose, width = self.corridor.pose(place), float(rng.uniform(*GUARD_M))
        site = Site(f"guard_{k:04d}", "post", self.terrain, pose)
        posts = [
            site.cylinder(word, pose.moved(0.0, side * width / 2.0), 0.08, 1.2)
            for word, side in (("left", 1.0), ("right", -1.0))
        ]
        return posts + site._replace(kind="rumble_strip").rumble_strips()

    def _across(self, k: int, slot: int) -> list[Obstacle]:
        """Something on the line itself, where the corridor is wide enough to pass it."""
        rng = generator(self.seed, f"across {k} {slot}")
        place = self._straight(k, rng, SLOTS_M[slot])
        if rng.uniform() > ACROSS_SHARE or place is None:
            return []
        half_width = float(self.corridor.half_width_m[self.corridor.place(place)[0]])
        if half_width < WIDE_M:
            return []
        kind = str(rng.choice(list(SHARES), p=list(SHARES.values())))
        turn = float(rng.uniform(-1.0, 1.0)) * YAW_RAD[kind]
        side = float(rng.choice((1.0, -1.0)))
        extent = extent_m(HALF_M[kind], turn)
        cover = float(rng.uniform(COVER_M[0], min(COVER_M[1], half_width - FREE_M, extent)))
        left = side * (extent - cover)
        line = self.corridor.pose(place)
        pose = line.moved(0.0, left, turn)
        site = Site(f"{kind}_across_{k:04d}_{slot}", kind, self.terrain, pose)
        taken = 2.0 * extent - cover
        rest = (half_width - taken) / 2.0
        beside = line.moved(0.0, side * (taken + rest))
        return _stands(site) + (_rubble(site, beside, rest) if rest > LEAST_M else [])

    def _straight(
        self, k: int, rng: np.random.Generator, slot_m: tuple[float, float]
    ) -> float | None:
        """A station in a slot of chunk k that is far from where the track turns."""
        for place in rng.uniform(*slot_m, TRIES).tolist():
            station = k * CHUNK_M + place
            segment, along = self.corridor.place(min(station, self.corridor.way_m))
            rest = float(self.corridor.length_m[segment]) - along
            if min(along, rest) > CALM_M:
                return station
        return None


def _between(one_rad: float, other_rad: float) -> float:
    """The direction in the middle between two."""
    return atan2(sin(one_rad) + sin(other_rad), cos(one_rad) + cos(other_rad))


def _rubble(site: Site, pose: Pose, half_m: float) -> list[Obstacle]:
    """What lies between a thing and the corridor's edge on its own side."""
    return [site._replace(kind="rock").box("rubble", pose, (RUBBLE_HALF_M, half_m), 0.8)]


def _stands(site: Site) -> list[Obstacle]:
    if site.kind == "car":
        return site.car()
    if site.kind == "tank_trap":
        return site.tank_trap()
    if site.kind == "hay_bale":
        return site.bales(2)
    return [site.box("", site.pose, HALF_M["rock"], 0.9)]
