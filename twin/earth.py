"""The world frame W and the Earth: ENU tangent plane of WGS 84 at an anchor.

A point on the ground has ellipsoid height 0; its x and y are the east and north components in
the anchor's tangent plane, its up component is dropped. Both directions are closed forms.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

A_M = 6378137.0
"""Semi-major axis of WGS 84, [m] (published: NIMA TR8350.2)."""
E2 = 6.69437999014e-3
"""First eccentricity squared of WGS 84 (published: NIMA TR8350.2)."""


class _Frame(NamedTuple):
    """Origin (3,) in ECEF [m] and the east, north and up axes (3,) there."""

    origin: Floats
    east: Floats
    north: Floats
    up: Floats


def to_world(
    anchor: tuple[float, float], latitude_deg: Floats | float, longitude_deg: Floats | float
) -> tuple[Floats, Floats]:
    """East and north [m] of points on the ellipsoid in the tangent plane at `anchor` [deg]."""
    frame = _frame(anchor)
    offset = _ecef(np.radians(latitude_deg), np.radians(longitude_deg)) - frame.origin
    return offset @ frame.east, offset @ frame.north


def to_geodetic(
    anchor: tuple[float, float], x: Floats | float, y: Floats | float
) -> tuple[Floats, Floats]:
    """Latitude and longitude [deg] of the points of the ellipsoid above or below x, y [m].

    The up component solves the quadratic "this point lies on the ellipsoid".
    """
    frame = _frame(anchor)
    plane = (
        frame.origin
        + np.asarray(x, dtype=float)[..., None] * frame.east
        + np.asarray(y, dtype=float)[..., None] * frame.north
    )
    point = plane + _up_to_ellipsoid(plane, frame.up)[..., None] * frame.up
    distance = np.hypot(point[..., 0], point[..., 1])
    latitude = np.arctan2(point[..., 2], (1.0 - E2) * distance)
    return np.degrees(latitude), np.degrees(np.arctan2(point[..., 1], point[..., 0]))


def _up_to_ellipsoid(plane: Floats, up: Floats) -> Floats:
    """The smaller root u of |plane + u up| = A in coordinates where the ellipsoid is a sphere."""
    scale = np.array([1.0, 1.0, 1.0 / np.sqrt(1.0 - E2)])
    p, d = plane * scale, up * scale
    a, b, c = d @ d, p @ d, np.square(p).sum(axis=-1) - A_M**2
    return -c / (b + np.sqrt(b * b - a * c))  # the form that does not cancel


def _ecef(latitude: Floats, longitude: Floats) -> Floats:
    """Earth-centred position [m], shape (..., 3), of a point at ellipsoid height 0; [rad] in."""
    normal = A_M / np.sqrt(1.0 - E2 * np.sin(latitude) ** 2)
    return np.stack(
        np.broadcast_arrays(
            normal * np.cos(latitude) * np.cos(longitude),
            normal * np.cos(latitude) * np.sin(longitude),
            normal * (1.0 - E2) * np.sin(latitude),
        ),
        axis=-1,
    )


@lru_cache(maxsize=8)
def _frame(anchor: tuple[float, float]) -> _Frame:
    latitude, longitude = np.radians(anchor)
    s, c = np.sin(latitude), np.cos(latitude)
    sl, cl = np.sin(longitude), np.cos(longitude)
    return _Frame(
        _ecef(latitude, longitude),
        np.array([-sl, cl, 0.0]),
        np.array([-s * cl, -s * sl, c]),
        np.array([c * cl, c * sl, s]),
    )
