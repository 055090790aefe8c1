"""Angles on the circle."""

from math import pi


def wrapped(angle_rad: float) -> float:
    """The same angle in (-pi, pi]."""
    return pi - (pi - angle_rad) % (2.0 * pi)
