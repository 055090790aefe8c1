"""The metal tunnel: 100 ft long, with a roof, bent in its middle, beside the route line."""

from math import pi, radians, tan

import numpy as np

from scenarios.course import Floats
from scenarios.geometry import Leg, Pose
from scenarios.nqe.placing import Draw
from scenarios.things import Site
from twin.world import Obstacle

HALF_LENGTH_M = 50.0 * 0.3048
WIDTH_M = (3.0, 3.6)
BEND_RAD = (radians(2.0), radians(4.0))
MISS_M = (0.3, 0.6)
"""Distance of the axis from the route line, everywhere between the mouths."""
OVERLAP_M = 0.08
"""The two halves overlap at the bend, so that no ray slips out."""


def tunnel(draw: Draw, before: Leg, after: Leg) -> tuple[list[Obstacle], Floats]:
    """Walls and roof of two straight halves, and the axis, shape (3, 2), world frame [m].

    The route line bends at the same place by an angle of its own.
    """
    route_bend = after.straight.start.heading - before.straight.start.heading
    width, bend = draw.uniform(*WIDTH_M), draw.uniform(*BEND_RAD) * np.sign(route_bend)
    middle = Pose(*after.straight.start[:2], before.straight.start.heading + route_bend / 2.0)
    axis = middle.moved(0.0, _miss(draw, bend - route_bend))
    into, out = axis.moved(0.0, 0.0, pi - bend / 2.0), axis.moved(0.0, 0.0, bend / 2.0)
    parts = _half(draw.site(axis, "_in"), into, width) + _half(draw.site(axis, "_out"), out, width)
    mouths = into.at(HALF_LENGTH_M, 0.0), out.at(HALF_LENGTH_M, 0.0)
    return parts, np.array([mouths[0], (axis.x, axis.y), mouths[1]])


def _miss(draw: Draw, excess_bend: float) -> float:
    """Offset of the bend to the left [m] that keeps bend and mouths within `MISS_M`.

    At the mouths the axis lies farther left by what it bends more than the route line.
    """
    side = draw.side()
    spread = side * HALF_LENGTH_M * tan(excess_bend / 2.0)
    return side * draw.uniform(MISS_M[0] + max(0.0, -spread), MISS_M[1] - max(0.0, spread))


def _half(site: Site, start: Pose, width: float) -> list[Obstacle]:
    """Two walls and a roof from the bend outwards."""
    half_length = (HALF_LENGTH_M + OVERLAP_M) / 2.0
    middle = start.moved(half_length - OVERLAP_M, 0.0)
    return site.passage(middle, half_length, width)
