"""The race as a course: the whole of it, or a stretch on which the same things stand."""

from dataclasses import replace

from nav.route import rddf
from scenarios.chunks import Chunks
from scenarios.course import Course, Patience, route_points_m
from scenarios.failing import failing
from scenarios.gc05_route import underpasses
from scenarios.gc05_route.ground import ground
from scenarios.gc05_route.plan import load_plan
from scenarios.gc05_route.route import NAME, text
from scenarios.gc05_route.shoulders import shoulders
from scenarios.gc05_route.washouts import gullies
from scenarios.gc05_route.wayside import UNDERPASS_HALF_LENGTH_M, Wayside
from scenarios.route.corridor import CHUNK_M, Corridor
from scenarios.route.course import FRICTION, SKY
from scenarios.route.roadside import BESIDE_M
from scenarios.scenario import load_scenario
from scenarios.things import generator
from twin.landforms import Landform
from twin.world import SIGHT_M, World

PATIENCE = Patience(300.0, 3.0, "terminated")
"""Of the officials (estimated: nobody has said how long they waited for ION)."""


def build(seed: int, first: int | None = None, last: int | None = None) -> Course:
    """The course as `seed` draws it, from one waypoint to another.

    Raises:
        RouteError: a stretch that the route does not have.
    """
    scenario, whole = load_scenario("gc05_route"), rddf.parse(text(), NAME)
    first, last = first or 1, last or len(whole)
    route = whole.stretch(first, last)
    anchor = whole.first_deg
    waypoint_m = route_points_m(whole, anchor)
    corridor = Corridor.of(waypoint_m, whole.half_width_m)
    start_m, end_m = corridor.waypoint(first), corridor.waypoint(last)
    pose, terrain = corridor.pose(start_m + 1e-6), ground(seed, _forms(seed, corridor))
    tunnels = [_middle_m(corridor, k) for k in underpasses.segments(waypoint_m)]
    wayside = Wayside(seed, terrain, corridor, tuple(tunnels), (pose.x, pose.y))
    world = World(
        terrain=terrain,
        obstacles=(),
        friction=float(generator(seed, "friction").uniform(*FRICTION)),
        anchor=anchor,
        start=(pose.x, pose.y, pose.heading),
        satellites=SKY,
        scenery=_chunks(wayside, start_m, end_m),
    )
    course = Course(
        name="gc05_route",
        title=scenario.title,
        seed=seed,
        world=world,
        route_text=_lines(first, last),
        route_name=NAME,
        waypoint_m=waypoint_m[first - 1 : last],
        half_width_m=route.half_width_m,
        speed_mps=route.speed_mps,
        time_limit_s=scenario.time_limit_s,
        patience=PATIENCE,
    )
    return _from_there(failing(course, scenario.faults), start_m)


def _forms(seed: int, corridor: Corridor) -> tuple[Landform, ...]:
    plan = load_plan()
    return (shoulders(plan, seed, corridor), *gullies(plan.washouts, corridor))


def _chunks(wayside: Wayside, start_m: float, end_m: float) -> Chunks:
    """Those of the stretch, and of what is in sight at its ends."""
    middle_m, radius_m = wayside.corridor.chunk_circles(BESIDE_M + UNDERPASS_HALF_LENGTH_M)
    first = max(int((start_m - SIGHT_M) // CHUNK_M), 0)
    part = slice(first, int((end_m + SIGHT_M) // CHUNK_M) + 1)
    return Chunks(middle_m[part], radius_m[part], wayside, first)


def _middle_m(corridor: Corridor, k: int) -> float:
    return float(corridor.end_m[k] - corridor.length_m[k] / 2.0)


def _lines(first: int, last: int) -> str:
    return "".join(text().splitlines(keepends=True)[first - 1 : last])


def _from_there(course: Course, start_m: float) -> Course:
    """With the faults that are still to come, by the way from where the drive begins."""
    ahead = [fault for fault in course.world.faults if fault.begins >= start_m]
    faults = tuple(replace(f, begins=float(round(f.begins - start_m))) for f in ahead)
    return replace(course, world=replace(course.world, faults=faults))
