"""Round the corners of the waypoint polyline inside the corridor, before (6.4) interpolates.

Points stand about evenly along the polyline. Where three neighbours bend tighter than the wanted
radius, the middle one moves inwards and, less so, its neighbours outwards, as a driver swings
out before a narrow bend; then all are held inside the corridor less the vehicle's half-width.
What is still too tight afterwards is a corner that no forward path of this kind can take.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nav.route.corridor import foot
from nav.route.geodesy import Floats
from nav.route.waypoints import Waypoints

SETTLED_M = 1e-4
"""Where no point moves farther than this in a step, none is worth making."""


@dataclass(frozen=True)
class Rounding:
    """How corners are rounded."""

    spacing_m: float = 2.0
    """Between points; the design allows 10 m, (6.4) wants them even."""
    radius_m: float = 15.0
    """Wanted where there is room; the vehicle can turn on 5.8 m."""
    clearance_m: float = 1.2
    """From the corridor's edge: 0.76 m of vehicle, 0.44 m for tracking and the front's swing."""
    clearance_share: float = 0.3
    """Of a wide corridor's half-width: where there is room, the estimate may err more."""
    reach_m: float = 24.0
    """How far from a corner points may move, along the route."""
    steps: int = 300
    """At most."""
    give: float = 0.6
    """Share of a correction that the neighbours take the other way, 0 to 1."""


def rounded(waypoints: Waypoints, rounding: Rounding) -> tuple[Floats, Floats]:
    """Points (k, 2) [m] along the route, corners rounded; their arcs (k,) [m] on the polyline."""
    P = waypoints.position_m
    corner = arc_of(P)
    arc = even_arcs(corner[-1], rounding.spacing_m)
    points = interpolate(arc, corner, P)
    segment = np.minimum(np.searchsorted(corner, arc, side="right") - 1, waypoints.segments - 1)
    active = _active(points, float(arc[1]), rounding)
    points[active] = _relax(points[active], _fixed(active), segment[active], waypoints, rounding)
    return points, arc


def arc_of(points: Floats) -> Floats:
    """Length of the polyline (k, 2) up to each of its points, (k,), [m]."""
    step = np.diff(points, axis=0)
    return np.concatenate([[0.0], np.cumsum(np.hypot(step[:, 0], step[:, 1]))])


def even_arcs(length_m: float, spacing_m: float) -> Floats:
    """Arcs (k,) [m] from 0 to `length_m`, evenly spaced, at most `spacing_m` apart."""
    count = max(int(np.ceil(length_m / spacing_m)), 1)
    return np.arange(count + 1, dtype=np.float64) * float(length_m / count)


def interpolate(at: Floats, arc: Floats, points: Floats) -> Floats:
    """Points (m, 2) at the arcs `at` (m,) of a polyline (k, 2)."""
    return np.column_stack([np.interp(at, arc, points[:, 0]), np.interp(at, arc, points[:, 1])])


def _sag(points: Floats) -> Floats:
    """(k - 2, 2): from each inner point to the middle of its neighbours."""
    return 0.5 * (points[:-2] + points[2:]) - points[1:-1]


def _active(points: Floats, spacing: float, rounding: Rounding) -> NDArray[np.bool_]:
    """Which points lie within reach of one that bends tighter than wanted."""
    tight = np.zeros(len(points) + 1)
    reach = int(np.ceil(rounding.reach_m / spacing))
    limit = spacing**2 / (2.0 * rounding.radius_m)
    for k in 1 + np.flatnonzero(np.hypot(*_sag(points).T) > limit):
        tight[max(k - reach, 0)] += 1.0
        tight[min(k + reach + 1, len(points))] -= 1.0
    return np.cumsum(tight[:-1]) > 0.0


def _fixed(active: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The ends of each run of active points, which stay where they are."""
    edge = np.flatnonzero(np.diff(active.astype(np.int8), prepend=0, append=0))
    fixed = np.zeros(len(active), dtype=np.bool_)
    fixed[edge[::2]] = True
    fixed[edge[1::2] - 1] = True
    return fixed[active]


def _relax(
    points: Floats,
    fixed: NDArray[np.bool_],
    segment: NDArray[np.int64],
    waypoints: Waypoints,
    rounding: Rounding,
) -> Floats:
    if len(points) < 3:
        return points
    points = points.copy()
    still = fixed[1:-1]
    for _ in range(rounding.steps):
        sag = _sag(points)
        size = np.hypot(sag[:, 0], sag[:, 1])
        chord = points[2:] - points[:-2]
        limit = (chord * chord).sum(1) / (8.0 * rounding.radius_m)
        size[still] = 0.0
        excess = sag * (np.maximum(size - limit, 0.0) / np.maximum(size, 1e-12))[:, None]
        move = 0.5 * excess
        move[1:] -= 0.25 * rounding.give * excess[:-1]
        move[:-1] -= 0.25 * rounding.give * excess[1:]
        move[still] = 0.0
        before = points.copy()
        points[1:-1] += move
        points = _held(points, segment, waypoints, rounding)
        if np.abs(points - before).max() < SETTLED_M:
            break
    return points


def _held(
    points: Floats, segment: NDArray[np.int64], waypoints: Waypoints, rounding: Rounding
) -> Floats:
    """Points pulled back to where the corridor of the segments around them leaves clearance."""
    P = waypoints.position_m
    near = np.clip(segment + np.array([[0], [-1], [1]]), 0, waypoints.segments - 1)  # (3, k)
    centre = foot(points, P[near], P[near + 1])
    offset = points - centre
    distance = np.sqrt((offset * offset).sum(-1))
    half = waypoints.half_width_m[near]
    clearance = np.maximum(rounding.clearance_m, rounding.clearance_share * half)
    room = np.maximum(half - clearance, 0.0)
    best = (distance - room).argmin(axis=0), np.arange(len(points))
    share = np.minimum(room[best] / np.maximum(distance[best], 1e-12), 1.0)
    return centre[best] + offset[best] * share[:, None]
