"""Equations (6.9) and (6.10): Dubins' car, with reverse."""

from math import cos, sin
from typing import NamedTuple

STRAIGHT_RAD = 1e-6
"""A turn below this is driven straight: the chord differs from the arc by less than 1e-13."""


class State(NamedTuple):
    """x, y, theta and u of (6.9)."""

    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    """u, signed: the paper takes it to be positive, we also go backwards."""


def advance(state: State, a_mps2: float, curvature_per_m: float, dt_s: float) -> State:
    """(6.9) solved exactly for constant a and omega / u over `dt_s`.

    The way is u dt + a dt^2 / 2, the heading turns by the way's share of the circle, and the place
    moves along the arc's chord.
    """
    x, y, heading, u = state
    way = (u + 0.5 * a_mps2 * dt_s) * dt_s
    half = 0.5 * way * curvature_per_m
    chord = way if abs(half) < STRAIGHT_RAD else 2.0 * sin(half) / curvature_per_m
    x += chord * cos(heading + half)
    y += chord * sin(heading + half)
    return State(x, y, heading + 2.0 * half, u + a_mps2 * dt_s)


def limited(curvature_per_m: float, minimum_radius_m: float) -> float:
    """(6.10): |omega / u| is at most 1 / R."""
    most = 1.0 / minimum_radius_m
    return min(max(curvature_per_m, -most), most)
