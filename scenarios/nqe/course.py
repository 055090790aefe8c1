"""The National Qualification Event: 2.7 miles, 51 gates, a tunnel, parked cars.

True to what is known (facts.md): the numbers, and the order of cattle crossing, tunnel, parked cars
and tank trap. The plan is ours, in `layout.toml`.
"""

from dataclasses import dataclass, field
from math import radians

import numpy as np

from nav.route import rddf
from scenarios.course import Course, Floats, Gate, route_points_m
from scenarios.failing import failing
from scenarios.geometry import Leg as Line
from scenarios.nqe import track
from scenarios.nqe.layout import Layout, Thing, load_layout
from scenarios.nqe.placing import PLACE, Draw, gate
from scenarios.nqe.tunnel import tunnel
from scenarios.scenario import load_scenario
from scenarios.things import generator
from twin.terrain import Banks, RollingGround
from twin.world import Obstacle, World

DATUM_M, DATUM_RAD = 0.5, radians(1.0)
START_M = 2.0
"""The reference point starts this far past the first waypoint."""
START_ERROR_M, START_ERROR_RAD = 0.3, radians(3.0)
FRICTION = (0.5, 0.9)
PASS_FLAT_HALF_M = 1.9
PASS_SLOPE = (0.40, 0.55)
"""Tangent of 22 to 29 degrees."""
PASS_HEIGHT_M = 2.5


@dataclass
class _Built:
    """What the things of the layout come to."""

    obstacles: list[Obstacle] = field(default_factory=list)
    gates: list[Gate] = field(default_factory=list)
    tunnel_axis_m: Floats | None = None


def build(seed: int) -> Course:
    """The course as `seed` draws it."""
    layout, scenario = load_layout(), load_scenario("nqe")
    lines = track.lines(layout, _datum(seed))
    ground = RollingGround(seed, features=_banks(seed, layout, lines))
    built = _build_things(seed, layout, lines, ground)
    text = track.rddf(track.waypoints(layout, lines), layout.anchor_deg)
    route = rddf.parse(text, "nqe.rddf")
    world = World(
        terrain=ground,
        obstacles=tuple(built.obstacles),
        friction=float(generator(seed, "friction").uniform(*FRICTION)),
        anchor=layout.anchor_deg,
        start=_start(seed, lines[0]),
        satellites=np.radians(layout.satellites),
    )
    course = Course(
        name="nqe",
        title=scenario.title,
        seed=seed,
        world=world,
        route_text=text,
        route_name=route.name,
        waypoint_m=route_points_m(route, layout.anchor_deg),
        half_width_m=route.half_width_m,
        speed_mps=route.speed_mps,
        time_limit_s=scenario.time_limit_s,
        gates=tuple(built.gates),
        tunnel_center_line_m=built.tunnel_axis_m,
    )
    return failing(course, scenario.faults)


def _datum(seed: int) -> track.Datum:
    rng = generator(seed, "datum")
    distance, direction = DATUM_M * np.sqrt(rng.uniform()), rng.uniform(0.0, 2.0 * np.pi)
    turn = rng.uniform(-DATUM_RAD, DATUM_RAD)
    east, north = distance * np.cos(direction), distance * np.sin(direction)
    return track.Datum(float(east), float(north), float(turn))


def _start(seed: int, first: Line) -> tuple[float, float, float]:
    rng = generator(seed, "start")
    left = rng.uniform(-START_ERROR_M, START_ERROR_M)
    turn = rng.uniform(-START_ERROR_RAD, START_ERROR_RAD)
    x, y, heading = first.straight.pose(START_M).moved(0.0, float(left), float(turn))
    return x, y, heading


def _build_things(seed: int, layout: Layout, lines: list[Line], ground: RollingGround) -> _Built:
    built, count = _Built(), dict[str, int]()
    for k, (leg, line) in enumerate(zip(layout.legs, lines, strict=True)):
        for thing in leg.things:
            count[thing.kind] = count.get(thing.kind, 0) + 1
            name = f"{thing.kind}_{count[thing.kind]:02d}"
            width = track.half_width_m(leg, thing.at_m)
            rng = generator(seed, name)
            draw = Draw(name, thing, line.straight, width, ground, rng)
            _add(built, draw, lines[k : k + 2])
    return built


def _add(built: _Built, draw: Draw, lines: list[Line]) -> None:
    if draw.thing.kind == "gate":
        parts, opening = gate(draw)
        built.gates.append(opening)
    elif draw.thing.kind == "tunnel":
        parts, built.tunnel_axis_m = tunnel(draw, *lines)
    elif draw.thing.kind == "pass":
        parts = []  # its slopes are a part of the ground
    else:
        parts = PLACE[draw.thing.kind](draw)
    built.obstacles += parts


def _banks(seed: int, layout: Layout, lines: list[Line]) -> tuple[Banks, ...]:
    return tuple(
        _bank(seed, thing, line)
        for leg, line in zip(layout.legs, lines, strict=True)
        for thing in leg.things
        if thing.kind == "pass"
    )


def _bank(seed: int, thing: Thing, line: Line) -> Banks:
    rng = generator(seed, "pass")
    left, right = (float(rng.uniform(*PASS_SLOPE)) for _ in range(2))
    ends = (line.straight.pose(thing.at_m + e * thing.length_m / 2.0) for e in (-1.0, 1.0))
    points = tuple((end.x, end.y) for end in ends)
    return Banks(points, PASS_FLAT_HALF_M, (left, right), PASS_HEIGHT_M)
