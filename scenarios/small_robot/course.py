"""The indoor test of section 6.5 (Fig. 6.13): a corridor, gates, a third obstacle behind each.

The paper says "an obstacle just behind a gate formed by two obstacles", in a corridor, and "over 20
times ... failed twice". All measures are ours. The gate's obstacles reach to the walls, so that
the opening is the only way.
"""

from importlib import resources
from math import pi, radians

import msgspec
import numpy as np

from nav.route import rddf
from scenarios.course import FOOT_M, Course, Gate, Patience, route_points_m
from scenarios.geometry import Pose
from scenarios.route.course import SKY
from scenarios.small_robot.placement import Placement, draw, leaves_room
from scenarios.things import Site, generator
from twin.earth import to_geodetic
from twin.terrain import RollingGround
from twin.world import Obstacle, World

ANCHOR_DEG = (40.0, -83.0)
"""Near the Ohio State University, Columbus (roughly)."""
LENGTH_M = 20.0
GATES_M = (5.0, 10.5, 16.0)
"""Where the gates stand along the corridor."""
HALF_WIDTH_FT = 6.0
HALF_WIDTH_M = HALF_WIDTH_FT * FOOT_M
SPEED_MPH = 1.5
SPACING_M = 4.0
"""Between waypoints."""
WALL_HALF_M, WALL_HEIGHT_M = 0.1, 1.2
BEYOND_M = 3.0
"""The walls begin so far before the start and end so far behind the finish."""
START_M = 1.0
START_ERROR_M, START_ERROR_RAD = 0.1, radians(3.0)
FRICTION = (0.6, 0.9)
FLOOR = RollingGround(0, octaves=())


class Scenario(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """`scenario.toml`."""

    title: str
    course: str
    time_limit_s: float
    stuck_s: float


def build(seed: int) -> Course:
    """The course as `seed` draws it; its direction too, so that no lattice suits it."""
    scenario, axis = _scenario(), _axis(seed)
    placed = [draw(generator(seed, f"gate_{k}"), HALF_WIDTH_M) for k in range(len(GATES_M))]
    gates = [axis.moved(at, 0.0) for at in GATES_M]
    text = _rddf(axis)
    route = rddf.parse(text, "small_robot.rddf")
    pairs = list(zip(placed, gates, strict=True))
    parts = [part for k, pair in enumerate(pairs) for part in _gate(k, *pair)]
    return Course(
        name="small_robot",
        title=scenario.title,
        seed=seed,
        world=World(
            terrain=FLOOR,
            obstacles=(*_walls(axis), *parts),
            friction=float(generator(seed, "friction").uniform(*FRICTION)),
            anchor=ANCHOR_DEG,
            start=_start(seed, axis),
            satellites=SKY,
        ),
        route_text=text,
        route_name=route.name,
        waypoint_m=route_points_m(route, ANCHOR_DEG),
        half_width_m=route.half_width_m,
        speed_mps=route.speed_mps,
        time_limit_s=scenario.time_limit_s,
        gates=tuple(_opening(*pair) for pair in pairs),
        vehicle="pioneer",
        patience=Patience(scenario.stuck_s),
        facts={"leaves_room": all(leaves_room(p, HALF_WIDTH_M) for p in placed)},
    )


def _scenario() -> Scenario:
    text = (resources.files("scenarios.small_robot") / "scenario.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=Scenario)


def _axis(seed: int) -> Pose:
    return Pose(0.0, 0.0, float(generator(seed, "axis").uniform(-pi, pi)))


def _start(seed: int, axis: Pose) -> tuple[float, float, float]:
    rng = generator(seed, "start")
    left = rng.uniform(-START_ERROR_M, START_ERROR_M)
    turn = rng.uniform(-START_ERROR_RAD, START_ERROR_RAD)
    x, y, heading = axis.moved(START_M, float(left), float(turn))
    return x, y, heading


def _walls(axis: Pose) -> list[Obstacle]:
    middle = axis.moved(0.5 * LENGTH_M, 0.0)
    half = (0.5 * LENGTH_M + BEYOND_M, WALL_HALF_M)
    left = HALF_WIDTH_M + WALL_HALF_M
    sides = (("left", left), ("right", -left))
    return [
        Site(f"wall_{word}", "wall", FLOOR, axis).box("", middle.moved(0.0, y), half, WALL_HEIGHT_M)
        for word, y in sides
    ]


def _gate(k: int, p: Placement, at: Pose) -> list[Obstacle]:
    """The two obstacles of a gate, each from the opening to its wall, and the third."""
    parts: list[Obstacle] = []
    for word, side in (("left", 1.0), ("right", -1.0)):
        inner = p.offset_m + side * 0.5 * p.opening_m
        half = (p.half_depth_m, 0.5 * abs(side * HALF_WIDTH_M - inner))
        middle = at.moved(0.0, 0.5 * (side * HALF_WIDTH_M + inner))
        site = Site(f"gate_{k}_{word}", "gate_flank", FLOOR, at)
        parts.append(site.box("", middle, half, p.height_m[0]))
    site, place = Site(f"third_{k}", "third", FLOOR, at), at.moved(p.third_x_m, p.third_y_m)
    half = p.third_half_m
    third = site.cylinder("", place, half, p.height_m[1])
    return [*parts, third if p.third_round else site.box("", place, (half, half), p.height_m[1])]


def _opening(p: Placement, at: Pose) -> Gate:
    half = 0.5 * p.opening_m
    return Gate(*(np.array(at.at(0.0, p.offset_m + y)) for y in (half, -half)))


def _rddf(axis: Pose) -> str:
    """The route file: the corridor's middle line; ten decimals are a hundredth of a millimetre."""
    points = [axis.at(s, 0.0) for s in np.arange(0.0, LENGTH_M + 0.1, SPACING_M).tolist()]
    lat, lon = to_geodetic(ANCHOR_DEG, *np.array(points).T)
    return "".join(
        f"{k + 1},{a:.10f},{b:.10f},{HALF_WIDTH_FT:g},{SPEED_MPH:g}\n"
        for k, (a, b) in enumerate(zip(lat.tolist(), lon.tolist(), strict=True))
    )
