"""A trial as a course: flat rolling ground, what its plan puts there, and a sky."""

from collections.abc import Callable
from math import atan2, radians

import numpy as np

from nav.route import rddf
from scenarios.course import FOOT_M, Course, Patience, route_points_m
from scenarios.failing import failing
from scenarios.planned import obstacle
from scenarios.route.course import SKY
from scenarios.things import generator
from scenarios.trial.plan import Edge, Trial, load
from twin.earth import to_geodetic
from twin.landforms import DropOff, Landform, Pit
from twin.terrain import GENTLE, Octave, RollingGround
from twin.world import Road, World

ANCHOR_DEG = (34.05, -117.6)
"""Somewhere in the desert (estimated: any place would do)."""
FLAT_M = 0.3
"""Share of the NQE's long waves: a trial is about its own difficulty."""


def builder(package: str) -> Callable[[int], Course]:
    """What draws the course of a scenario's folder, given its package's name."""

    def build(seed: int) -> Course:
        """The course as `seed` draws it."""
        return course_of(package.rsplit(".", 1)[-1], load(package), seed)

    return build


def course_of(name: str, trial: Trial, seed: int) -> Course:
    """The course of a plan as `seed` draws it."""
    text = _rddf(trial)
    route = rddf.parse(text, f"{name}.rddf")
    ground = _ground(trial, seed)
    world = World(
        terrain=ground,
        obstacles=tuple(obstacle(k, t, ground, seed) for k, t in enumerate(trial.things)),
        friction=trial.friction,
        anchor=ANCHOR_DEG,
        start=_start(trial),
        satellites=SKY,
        road=_road(trial),
    )
    course = Course(
        name=name,
        title=trial.title,
        seed=seed,
        world=world,
        route_text=text,
        route_name=route.name,
        waypoint_m=route_points_m(route, ANCHOR_DEG),
        half_width_m=route.half_width_m,
        speed_mps=route.speed_mps,
        time_limit_s=trial.time_limit_s,
        patience=Patience(trial.stuck_s),
    )
    return failing(course, trial.faults)


def _rddf(trial: Trial) -> str:
    points = trial.waypoints
    x, y = np.array([p.x_m for p in points]), np.array([p.y_m for p in points])
    rows = zip(points, *to_geodetic(ANCHOR_DEG, x, y), strict=True)
    return "".join(
        f"{k},{lat:.10f},{lon:.10f},{p.half_width_m / FOOT_M:.9g},{p.speed_mph:g}\n"
        for k, (p, lat, lon) in enumerate(rows, start=1)
    )


def _ground(trial: Trial, seed: int) -> RollingGround:
    pits = [Pit(hole.at_m, hole.radius_m, hole.depth_m) for hole in trial.holes]
    edges = [_drop(k, edge, seed) for k, edge in enumerate(trial.edges)]
    features: tuple[Landform, ...] = (*pits, *edges)
    waves = tuple(Octave(o.wavelength_m, o.amplitude_m * FLAT_M * trial.bumps) for o in GENTLE)
    return RollingGround(seed, waves, features)


def _drop(k: int, edge: Edge, seed: int) -> DropOff:
    shift = float(generator(seed, f"edge_{k}").uniform(-edge.shift_m, edge.shift_m))
    (ax, ay), (bx, by) = edge.from_m, edge.to_m
    length = float(np.hypot(bx - ax, by - ay))
    left = -(by - ay) / length * shift, (bx - ax) / length * shift
    start, end = ((x + left[0], y + left[1]) for x, y in (edge.from_m, edge.to_m))
    return DropOff(start, end, edge.depth_m)


def _start(trial: Trial) -> tuple[float, float, float]:
    first, second = trial.waypoints[:2]
    return first.x_m, first.y_m, atan2(second.y_m - first.y_m, second.x_m - first.x_m)


def _road(trial: Trial) -> Road | None:
    plan = trial.road
    if plan is None:
        return None
    sun = plan.sun_deg and (radians(plan.sun_deg[0]), radians(plan.sun_deg[1]))
    return Road(tuple(plan.line_m), plan.width_m, tuple(plan.unseen_m), sun)
