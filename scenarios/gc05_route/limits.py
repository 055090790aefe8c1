"""Speed limits and half-widths, distributed as in the real file of GC04."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scenarios.course import Floats
from scenarios.gc05_route import underpasses
from scenarios.gc05_route.plan import Plan
from scenarios.route.statistics import SHARP_RAD, turns_of
from scenarios.things import generator

Ints = NDArray[np.int64]

BLOCK = 8
"""Waypoints with limits of their own: real limits change every few hundred metres."""
SHARP_FT = 12.0
"""Measured on GC04: the median half-width beside sharp turns; of all it is 8 ft."""
UNDERPASS_MPH, UNDERPASS_FT = 5.0, 7.0
"""Estimated: as in the tunnel of the NQE; walls stand just inside the corridor."""
CHANCE = 0.35
"""How much chance has a say beside the country and its turns."""


def speeds_mph(plan: Plan, position_m: Floats) -> Floats:
    """Speed limit from each waypoint to the next, shape (n,); 0 at the finish."""
    length = np.append(np.hypot(*np.diff(position_m, axis=0).T), 0.0)
    order = _order(plan, position_m, "speed")
    mph = np.empty(plan.waypoints)
    mph[order] = _dealt(np.cumsum(length[order]) / length.sum(), plan.speeds.mph, plan.speeds.share)
    mph[underpasses.segments(position_m)] = UNDERPASS_MPH
    mph[plan.robotic.segments] = plan.robotic.mph
    mph[-1] = 0.0
    return mph


def half_widths_ft(plan: Plan, position_m: Floats) -> Floats:
    """Half-width of the corridor from each waypoint to the next, shape (n,)."""
    order = _order(plan, position_m, "width")
    order = order[~np.isin(order, _beside_sharp_turns(position_m))]
    feet = np.full(plan.waypoints, SHARP_FT)
    share = (np.arange(len(order)) + 0.5) / len(order)
    feet[order] = _dealt(share, plan.widths.ft, plan.widths.share)
    feet[underpasses.segments(position_m)] = UNDERPASS_FT
    feet[plan.robotic.segments] = plan.robotic.half_width_ft
    return feet


def _beside_sharp_turns(position_m: Floats) -> Ints:
    """The segments that lead to sharp turns and away from them."""
    corner = np.flatnonzero(np.abs(turns_of(position_m)) > SHARP_RAD)
    return np.union1d(corner, corner + 1)


def _dealt(share: Floats, values: Sequence[float], shares: Sequence[float]) -> Floats:
    """Values dealt out in order (k,), the first of them up to the first of `shares`, where each
    place ends a `share` (k,) of the whole."""
    at = np.searchsorted(np.cumsum(shares), share).clip(max=len(values) - 1)
    return np.array(values)[at]


def _order(plan: Plan, position_m: Floats, name: str) -> Ints:
    """The waypoints (n,), the least easy first."""
    ease = _ease(plan, position_m, name)[np.arange(plan.waypoints) // BLOCK]
    return np.argsort(ease, kind="stable")


def _ease(plan: Plan, position_m: Floats, name: str) -> Floats:
    """How easy each block is, (b,): its country, less its turns, and chance."""
    rng = generator(plan.seed, name)
    ease = np.repeat([s.ease for s in plan.stretches], [s.waypoints for s in plan.stretches])
    turn = np.concatenate([[0.0], np.abs(turns_of(position_m)), [0.0]])
    blocks = -(-plan.waypoints // BLOCK)
    chance = CHANCE * rng.standard_normal(blocks)
    parts = [slice(b * BLOCK, (b + 1) * BLOCK) for b in range(blocks)]
    return np.array([ease[p].mean() - 2.0 * turn[p].max() for p in parts]) + chance
