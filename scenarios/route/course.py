"""A stretch of any route definition file, with ground and obstacles that the seed draws."""

from math import atan2
from typing import NamedTuple

import numpy as np

from nav.route import rddf
from scenarios.course import Course, Floats, route_points_m
from scenarios.planned import Thing
from scenarios.route.placed import joined, moved, placed, room
from scenarios.route.roadside import scenery
from scenarios.things import generator
from twin.terrain import Octave, RollingGround
from twin.world import ROOM, Scenery, Terrain, World

DESERT = (Octave(160.0, 2.0), Octave(32.0, 0.16), Octave(6.0, 0.02))
"""Estimated: rougher than the NQE's ground."""
FRICTION = (0.5, 0.9)
TIME_FACTOR, TIME_EXTRA_S = 3.0, 120.0
"""The time limit: so many times the time at the speed limits, and something for the start."""
WALKING_MPS = 1.0
"""Taken for a limit that is lower."""
SKY = np.radians(
    [(20, 62), (75, 35), (110, 18), (150, 48), (200, 25), (235, 70), (280, 16), (300, 41)]
)
"""Azimuth counter-clockwise from east and elevation: a GPS sky."""


class Surroundings(NamedTuple):
    """What is given of the world along a route; the seed draws the rest."""

    things: tuple[Thing, ...] = ()
    """Placed in metres east and north of the file's first waypoint."""
    roadside: bool = True
    """Whether the seed puts rocks, brush, posts and bales beside the track."""
    bumps: float = 1.0
    """Factor on the height of the rolling ground; 0 is a plane."""


DRAWN = Surroundings()
"""All by the seed."""


def build(
    text: str,
    name: str,
    first: int | None,
    last: int | None,
    seed: int,
    given: Surroundings = DRAWN,
) -> Course:
    """A stretch of a route file, as `seed` draws the world there.

    Args:
        text: the route file's text.
        name: the route file's name, for messages.
        first: waypoint number where the stretch begins; None is the route's first.
        last: waypoint number where it ends; None is the route's last.
        seed: draws what is not given.
        given: what is.

    Raises:
        RouteError: not a route file, or a stretch that it does not have.
    """
    whole = rddf.parse(text, name)
    first = int(whole.number[0]) if first is None else first
    last = int(whole.number[-1]) if last is None else last
    route = whole.stretch(first, last)
    anchor = route.first_deg
    waypoint_m = route_points_m(route, anchor)
    things = moved(given.things, whole.first_deg, anchor)
    corridor = waypoint_m, route.half_width_m
    return Course(
        name="route",
        title=f"{name}, waypoints {first} to {last}.",
        seed=seed,
        world=_world(seed, anchor, corridor, given._replace(things=things)),
        route_text=_lines(text, first, last),
        route_name=name,
        waypoint_m=waypoint_m,
        half_width_m=route.half_width_m,
        speed_mps=route.speed_mps,
        time_limit_s=_time_limit_s(waypoint_m, route.speed_mps),
    )


def _world(
    seed: int, anchor: tuple[float, float], corridor: tuple[Floats, Floats], given: Surroundings
) -> World:
    """Ground, things and sky along a corridor: waypoints and half widths, [m] from the anchor."""
    waves = tuple(Octave(o.wavelength_m, o.amplitude_m * given.bumps) for o in DESERT)
    ground = RollingGround(seed, waves)
    return World(
        terrain=ground,
        obstacles=(),
        friction=float(generator(seed, "friction").uniform(*FRICTION)),
        anchor=anchor,
        start=_start(corridor[0]),
        satellites=SKY,
        scenery=_scenery(seed, ground, given.things, corridor if given.roadside else None),
        room=_room(given.things, given.roadside),
    )


def _scenery(
    seed: int, ground: Terrain, things: tuple[Thing, ...], corridor: tuple[Floats, Floats] | None
) -> Scenery:
    """What is placed there, and, along a corridor, what the seed draws."""
    if corridor is None:
        return placed(seed, ground, things)
    drawn = scenery(seed, ground, *corridor)
    return joined(drawn, placed(seed, ground, things)) if things else drawn


def _room(things: tuple[Thing, ...], roadside: bool) -> dict[str, int]:
    """For what is placed, and for what the seed draws."""
    return {shape: count + roadside * ROOM[shape] for shape, count in room(things).items()}


def _start(waypoint_m: Floats) -> tuple[float, float, float]:
    """At the first waypoint, along the first segment."""
    east, north = waypoint_m[1] - waypoint_m[0]
    return float(waypoint_m[0, 0]), float(waypoint_m[0, 1]), atan2(north, east)


def _lines(text: str, first: int, last: int) -> str:
    """The lines of the stretch, as they are in the file."""
    lines = [line for line in text.splitlines() if line.strip()]
    return "".join(f"{line}\n" for line in lines if first <= int(line.split(",")[0]) <= last)


def _time_limit_s(waypoint_m: Floats, speed_mps: Floats) -> float:
    length = np.hypot(*np.diff(waypoint_m, axis=0).T)
    least = length / np.maximum(speed_mps[:-1], WALKING_MPS)
    return float(TIME_FACTOR * least.sum() + TIME_EXTRA_S)
