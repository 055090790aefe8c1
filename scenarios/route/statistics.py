"""What a route file amounts to: lengths, limits, turns."""

from typing import NamedTuple

import numpy as np

from nav.route.geodesy import ecef
from nav.route.rddf import FOOT_M, MILE_M, MPH_MPS, Route
from nav.route.waypoints import route_frame, waypoints_of
from scenarios.course import Floats

SHARP_RAD = float(np.radians(30.0))
"""Turns above it are called sharp."""
SWITCHBACK_M = 40.0


class Statistics(NamedTuple):
    """Of one route."""

    waypoints: int
    miles: float
    mean_spacing_m: float
    half_width_ft: tuple[float, float, float, float]
    """Least, median, mean and greatest."""
    speed_share: dict[float, float]
    """Share of the length by speed limit, [mph]."""
    sharpest_turn_rad: float
    sharp_turns: int
    """Above 30 degrees at one waypoint."""
    switchback_rad: float
    """The largest change of heading within 40 m."""
    at_limits_s: float
    """Time at the speed limits."""


def statistics(route: Route) -> Statistics:
    """All of them."""
    length = lengths_m(route)
    turn = turns_rad(route)
    feet = route.half_width_m / FOOT_M
    return Statistics(
        waypoints=len(route),
        miles=float(length.sum()) / MILE_M,
        mean_spacing_m=float(length.mean()),
        half_width_ft=tuple(float(f(feet)) for f in (np.min, np.median, np.mean, np.max)),  # pyright: ignore
        speed_share=speed_share(route, length),
        sharpest_turn_rad=float(np.abs(turn).max(initial=0.0)),
        sharp_turns=int((np.abs(turn) > SHARP_RAD).sum()),
        switchback_rad=switchback_rad(length, turn),
        at_limits_s=float((length / np.maximum(route.speed_mps[:-1], 1e-9)).sum()),
    )


def lengths_m(route: Route) -> Floats:
    """From each waypoint to the next, shape (n - 1,)."""
    return np.linalg.norm(np.diff(ecef(route.latitude_deg, route.longitude_deg), axis=0), axis=1)


def length_m(route: Route) -> float:
    """Of the whole route."""
    return float(lengths_m(route).sum())


def miles_at(route: Route) -> Floats:
    """Miles from the start to each waypoint, shape (n,)."""
    return np.concatenate([[0.0], np.cumsum(lengths_m(route))]) / MILE_M


def turns_rad(route: Route) -> Floats:
    """Change of heading at each inner waypoint, shape (n - 2,), left positive, [rad]."""
    return turns_of(waypoints_of(route, route_frame(route)).position_m)


def turns_of(position_m: Floats) -> Floats:
    """The same of points (n, 2)."""
    step = np.diff(position_m, axis=0)
    heading = np.arctan2(step[:, 1], step[:, 0])
    return (np.diff(heading) + np.pi) % (2.0 * np.pi) - np.pi


def speed_share(route: Route, length: Floats) -> dict[float, float]:
    """Share of the length by speed limit, [mph], slowest first."""
    mph = np.round(route.speed_mps[:-1] / MPH_MPS, 3)
    return {float(v): float(length[mph == v].sum() / length.sum()) for v in np.unique(mph)}


def switchback_rad(length: Floats, turn: Floats) -> float:
    """The largest change of heading between waypoints at most 40 m apart, [rad]."""
    best, at = 0.0, np.concatenate([[0.0], np.cumsum(length)])
    summed = np.concatenate([[0.0], np.cumsum(turn)])
    for k in range(len(turn)):
        end = int(np.searchsorted(at, at[k + 1] + SWITCHBACK_M, side="right")) - 1
        reach = summed[k + 1 : max(end, k + 1) + 1] - summed[k]
        best = max(best, float(np.abs(reach).max(initial=0.0)))
    return best
