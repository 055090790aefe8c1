"""Speed limits and half-widths, distributed as in the real file of GC04."""

import numpy as np

from scenarios.course import Floats
from scenarios.gc05_route import underpasses
from scenarios.gc05_route.plan import Plan
from scenarios.things import generator

BLOCK = 8
"""Waypoints with limits of their own: real limits change every few hundred metres."""
UNDERPASS_MPH, UNDERPASS_FT = 5.0, 7.0
"""Estimated: as in the tunnel of the NQE; walls stand just inside the corridor."""
CHANCE = 0.35
"""How much chance has a say beside the country and its turns."""


def speeds_mph(plan: Plan, position_m: Floats) -> Floats:
    """Speed limit from each waypoint to the next, shape (n,); 0 at the finish."""
    length = np.append(np.hypot(*np.diff(position_m, axis=0).T), 0.0)
    block = np.arange(plan.waypoints) // BLOCK
    rank = _ease(plan, position_m, "speed")[block]
    order = np.argsort(rank, kind="stable")
    share = np.cumsum(length[order]) / length.sum()
    at = np.searchsorted(np.cumsum(plan.speeds.share), share).clip(max=len(plan.speeds.mph) - 1)
    mph = np.empty(plan.waypoints)
    mph[order] = np.array(plan.speeds.mph)[at]
    for k in underpasses.segments(position_m):
        mph[k] = UNDERPASS_MPH
    mph[plan.robotic.segments] = plan.robotic.mph
    mph[-1] = 0.0
    return mph


def half_widths_ft(plan: Plan, position_m: Floats) -> Floats:
    """Half-width of the corridor from each waypoint to the next, shape (n,)."""
    rank = _ease(plan, position_m, "width")[np.arange(plan.waypoints) // BLOCK]
    order = np.argsort(rank, kind="stable")
    share = (np.arange(plan.waypoints) + 0.5) / plan.waypoints
    at = np.searchsorted(np.cumsum(plan.widths.share), share).clip(max=len(plan.widths.ft) - 1)
    feet = np.empty(plan.waypoints)
    feet[order] = np.array(plan.widths.ft)[at]
    for k in underpasses.segments(position_m):
        feet[k] = UNDERPASS_FT
    feet[plan.robotic.segments] = plan.robotic.half_width_ft
    return feet


def _ease(plan: Plan, position_m: Floats, name: str) -> Floats:
    """How easy each block is, (b,): its country, less its turns, and chance."""
    rng = generator(plan.seed, name)
    ease = np.repeat([s.ease for s in plan.stretches], [s.waypoints for s in plan.stretches])
    heading = np.unwrap(np.arctan2(*np.diff(position_m, axis=0).T[::-1]))
    turn = np.concatenate([[0.0], np.abs(np.diff(heading)), [0.0]])
    blocks = -(-plan.waypoints // BLOCK)
    chance = CHANCE * rng.standard_normal(blocks)
    parts = [slice(b * BLOCK, (b + 1) * BLOCK) for b in range(blocks)]
    return np.array([ease[p].mean() - 2.0 * turn[p].max() for p in parts]) + chance
