"""The course of a random field: its world, its route, and whether it can be crossed."""

from math import atan2
from typing import Any, NamedTuple

import numpy as np

from nav.route import rddf
from scenarios.course import FOOT_M, MPH_MPS, Course, Floats, route_points_m
from scenarios.random_field.draw import DENSITY, draw
from scenarios.random_field.feasibility import BEYOND_M, Task, feasible
from scenarios.random_field.field import DISC_M, SIDE_M, Field
from scenarios.scenario import load_scenario
from scenarios.things import generator
from scenarios.vehicles import DUBINS
from twin.dubins import dubins_parameters
from twin.earth import to_geodetic
from twin.world import Obstacle, World

V0_MPS = 8.0
"""The speed limit, V0 of (6.8)."""
GOAL_M = 4.0
CORRIDOR_M = 300.0
"""Half-width: the corridor does not confine."""
TOP_M = 2.0
"""Height of the circles' cylinders."""
START_ERROR_RAD = 0.05
ANCHOR_DEG = (40.0, -83.0)
"""Somewhere in Ohio."""


class Plain(NamedTuple):
    """Flat ground."""

    def height(self, x: Floats, y: Floats) -> Floats:
        """Zero everywhere."""
        return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))


def build(seed: int, field: str = "circles", density: int | None = None) -> Course:
    """The field as `seed` draws it.

    Args:
        seed: of the field and of the start's small error in heading.
        field: `circles`, `traps` or `forks`.
        density: how many circles lie about; by default that of the kind of field.
    """
    count = DENSITY[field] if density is None else density
    drawn, scenario = draw(seed, field, count), load_scenario("random_field")
    text = _rddf(drawn.way_m)
    route = rddf.parse(text, "random_field.rddf")
    start = _start(seed, drawn.way_m)
    world = World(Plain(), _cylinders(drawn.circles), 1.0, ANCHOR_DEG, start)
    return Course(
        name="random_field",
        title=f"{scenario.title} {_kind(field, count)}.",
        seed=seed,
        world=world,
        route_text=text,
        route_name=route.name,
        waypoint_m=route_points_m(route, ANCHOR_DEG),
        half_width_m=route.half_width_m,
        speed_mps=route.speed_mps,
        time_limit_s=scenario.time_limit_s,
        vehicle=DUBINS,
        goal_m=GOAL_M,
        facts=_facts(field, count, drawn, start),
    )


def _kind(field: str, count: int) -> str:
    """For a title: `80 circles`, `traps and 40 circles`."""
    return f"{count} circles" if field == "circles" else f"{field} and {count} circles".capitalize()


def _facts(
    kind: str, count: int, field: Field, start: tuple[float, float, float]
) -> dict[str, Any]:
    x, y = field.way_m[-1].tolist()
    task = Task(start, (x, y), GOAL_M, 0.5 * SIDE_M + BEYOND_M)
    radius_m = dubins_parameters().drive.minimum_radius_m
    return {
        "field": kind,
        "density": count,
        "feasible": feasible(field.circles, task, DISC_M, radius_m),
    }


def _start(seed: int, way_m: Floats) -> tuple[float, float, float]:
    """At the first point, about along the first leg."""
    east, north = (way_m[1] - way_m[0]).tolist()
    turn = float(generator(seed, "start").uniform(-START_ERROR_RAD, START_ERROR_RAD))
    x, y = way_m[0].tolist()
    return x, y, atan2(north, east) + turn


def _cylinders(circles: Floats) -> tuple[Obstacle, ...]:
    half = 0.5 * TOP_M
    return tuple(
        Obstacle(f"circle_{k:03d}", "circle", "cylinder", (x, y, half), (radius, radius, half))
        for k, (x, y, radius) in enumerate(circles.tolist())
    )


def _rddf(way_m: Floats) -> str:
    """The route file's text; ten decimals of a degree are a hundredth of a millimetre."""
    latitude, longitude = to_geodetic(ANCHOR_DEG, way_m[:, 0], way_m[:, 1])
    limits = f"{CORRIDOR_M / FOOT_M:.6g},{V0_MPS / MPH_MPS:.6g},####,####,####"
    rows = zip(latitude.tolist(), longitude.tolist(), strict=True)
    return "".join(f"{k},{a:.10f},{b:.10f},{limits}\n" for k, (a, b) in enumerate(rows, start=1))
