"""Where the waypoints lie: around a large ring, with turns on the way."""

from math import pi, radians

import numpy as np

from nav.route.rddf import MILE_M
from scenarios.course import Floats
from scenarios.gc05_route.plan import Plan, Robotic, Stretch
from scenarios.things import generator

SPREAD = 0.45
"""Of the logarithm of the distance between waypoints (measured on GC04: up to 70 times; estimated:
less, since a shorter segment is a turn's)."""
CLOSE_SHARE = 0.35
"""Waypoints around a sharp turn are as much closer than elsewhere."""
KEEPS = 0.75
"""Of the heading beside the ring's, from waypoint to waypoint."""
HAIRPIN = ((0.5, 1.2), (0.5, 1.2), (0.16, 0.4), (0.16, -0.4), (0.5, -1.2), (0.5, -1.2))
"""Relative distances and headings beside the ring's [rad]: out to one side, around, and back, by
three turns within 25 m (GC04: 164 degrees within 40 m)."""
APART = 7
"""So many waypoints at least from one sharp turn to the next."""


def positions_m(plan: Plan) -> Floats:
    """Shape (n, 2), east and north of the first waypoint, [m]; of about the plan's length."""
    rng = generator(plan.seed, "line")
    spacing, turn = (np.concatenate(parts) for parts in zip(
        *(_stretch(rng, plan, stretch) for stretch in plan.stretches), strict=True
    ))  # fmt: skip
    _turn_back(plan.robotic, spacing, turn)
    spacing *= plan.miles * MILE_M / spacing[:-1].sum()
    ring = np.cumsum(spacing) * 2.0 * pi / (plan.ring_miles * MILE_M)
    heading = radians(90.0 - plan.first_mile_heading_deg) - ring + turn
    step = spacing[:, None] * np.stack([np.cos(heading), np.sin(heading)], axis=1)
    return np.vstack([np.zeros(2), np.cumsum(step[:-1], axis=0)])


def _turn_back(robotic: Robotic, spacing: Floats, beside: Floats) -> None:
    """Lay the two turns into distances and headings beside the ring's."""
    first, last = robotic.waypoints
    one, other = (radians(turn) for turn in robotic.turn_deg)
    side = np.copysign(1.0, beside[robotic.segments.start - 1])
    spacing[robotic.segments] = robotic.spacing
    beside[robotic.segments] = side * one / 2.0
    beside[first - 1 : last - 1] = -side * one / 2.0
    beside[last - 1 : robotic.segments.stop] = side * (other - one / 2.0)
    beside[robotic.segments.stop] = side * (other - one / 2.0) / 2.0


def _stretch(rng: np.random.Generator, plan: Plan, stretch: Stretch) -> tuple[Floats, Floats]:
    """Distances to the next waypoint, relative, and headings beside the ring's [rad], (n,) each."""
    n = stretch.waypoints
    spacing = stretch.spacing * np.exp(SPREAD * rng.standard_normal(n))
    beside, sharp, side = np.zeros(n), _sharp_turns(rng, stretch), 1.0
    spacing[[k + i for k in sharp for i in (-1, 0, 1)]] *= CLOSE_SHARE
    around = {k + i: i for k in _hairpins(stretch) for i in range(len(HAIRPIN))}
    size = 0.12 * plan.wander_rad * (1.2 - stretch.ease)
    for k in range(1, n):
        before = beside[k - 1]
        if k in around:
            side = np.copysign(1.0, before) if around[k] == 0 else side
            spacing[k], beside[k] = np.array(HAIRPIN[around[k]]) * (1.0, side)
        elif k in sharp:
            beside[k] = before - np.copysign(radians(rng.uniform(*plan.sharp_deg)), before)
        else:
            drift = KEEPS * before if abs(before) > plan.wander_rad else before
            beside[k] = drift + size * rng.standard_normal()
    return spacing, beside


def _hairpins(stretch: Stretch) -> list[int]:
    """Where they begin: in the second half, behind one another."""
    first, apart = stretch.waypoints // 2, stretch.waypoints // (2 * max(stretch.hairpins, 1))
    return [first + apart * k for k in range(stretch.hairpins)]


def _sharp_turns(rng: np.random.Generator, stretch: Stretch) -> set[int]:
    """Where: evenly, and each somewhere in its share."""
    if not stretch.sharp:
        return set()
    share = (stretch.waypoints - 2 * APART) / stretch.sharp
    return {int(APART + share * (k + rng.uniform(0.2, 0.8))) for k in range(stretch.sharp)}
