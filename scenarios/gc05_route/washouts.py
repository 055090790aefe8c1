"""Gullies in which the old road ends, where the route turns off."""

from math import pi

from scenarios.gc05_route.plan import Washouts
from scenarios.route.corridor import Corridor
from twin.landforms import Gully


def gullies(plan: Washouts, corridor: Corridor) -> list[Gully]:
    """One across the way straight on behind each corner."""
    return [_gully(plan, corridor, number) for number in plan.waypoints]


def _gully(plan: Washouts, corridor: Corridor, number: int) -> Gully:
    station = corridor.waypoint(number) - 1e-6  # still on the segment that leads to the corner
    corner = corridor.pose(station)
    edge_m = float(corridor.half_width_m[corridor.place(station)[0]])
    middle = corner.moved(edge_m + plan.behind_m + plan.half_width_m, 0.0, pi / 2.0)
    size = plan.half_length_m, plan.half_width_m, plan.depth_m
    return Gully((middle.x, middle.y), middle.heading, *size)
