"""Geodetic coordinates to a local east-north plane and back (WGS84, tangent plane through ECEF).

Points lie on the ellipsoid (height 0); their up component is dropped. A route frame shortens
distances by (d / 6371 km)^2 / 2 at the distance d from its anchor: 5e-5 at 66 km.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SEMI_MAJOR_M = 6378137.0
"""WGS84 semi-major axis a (NIMA TR8350.2, defining)."""
FLATTENING = 1.0 / 298.257223563
"""WGS84 flattening f (NIMA TR8350.2, defining)."""
ECCENTRICITY2 = FLATTENING * (2.0 - FLATTENING)
"""First eccentricity squared, e^2 = f (2 - f)."""


def ecef(latitude_deg: Floats, longitude_deg: Floats) -> Floats:
    """Earth-centred coordinates (n, 3) [m] of points (n,) [deg] on the ellipsoid."""
    lat, lon = np.radians(latitude_deg), np.radians(longitude_deg)
    normal = SEMI_MAJOR_M / np.sqrt(1.0 - ECCENTRICITY2 * np.sin(lat) ** 2)
    x = normal * np.cos(lat) * np.cos(lon)
    y = normal * np.cos(lat) * np.sin(lon)
    return np.column_stack([x, y, normal * (1.0 - ECCENTRICITY2) * np.sin(lat)])


@dataclass(frozen=True)
class Frame:
    """East-north frame whose plane touches the ellipsoid at its anchor, [deg]."""

    latitude_deg: float
    longitude_deg: float
    _origin: Floats = field(init=False, repr=False, compare=False)
    """Shape (3,): the anchor in ECEF, [m]."""
    _axes: Floats = field(init=False, repr=False, compare=False)
    """Shape (3, 3): rows east, north, up in ECEF."""

    def __post_init__(self) -> None:
        lat, lon = math.radians(self.latitude_deg), math.radians(self.longitude_deg)
        (sp, cp), (sl, cl) = (math.sin(lat), math.cos(lat)), (math.sin(lon), math.cos(lon))
        axes = np.array([[-sl, cl, 0.0], [-sp * cl, -sp * sl, cp], [cp * cl, cp * sl, sp]])
        origin = ecef(np.array([self.latitude_deg]), np.array([self.longitude_deg]))[0]
        object.__setattr__(self, "_axes", axes)
        object.__setattr__(self, "_origin", origin)

    def to_local(self, latitude_deg: Floats, longitude_deg: Floats) -> Floats:
        """East and north (n, 2) [m] of the points (n,) [deg]."""
        return (ecef(latitude_deg, longitude_deg) - self._origin) @ self._axes[:2].T

    def point(self, latitude_deg: float, longitude_deg: float) -> tuple[float, float]:
        """East and north [m] of one point [deg]: `to_local` without arrays, for each GPS fix."""
        lat, turn = math.radians(latitude_deg), math.radians(longitude_deg - self.longitude_deg)
        anchor = math.radians(self.latitude_deg)
        s, c, s0, c0 = math.sin(lat), math.cos(lat), math.sin(anchor), math.cos(anchor)
        normal = SEMI_MAJOR_M / math.sqrt(1.0 - ECCENTRICITY2 * s * s)
        normal0 = SEMI_MAJOR_M / math.sqrt(1.0 - ECCENTRICITY2 * s0 * s0)
        # In the anchor's meridian plane: `out` from the axis, `z` along it.
        out = normal * c * math.cos(turn) - normal0 * c0
        z = (1.0 - ECCENTRICITY2) * (normal * s - normal0 * s0)
        return normal * c * math.sin(turn), c0 * z - s0 * out

    def to_geodetic(self, xy: Floats) -> tuple[Floats, Floats]:
        """Latitude and longitude (n,), (n,) [deg] of local points (n, 2) [m]; exact, no iteration.

        The line from each point along "up" meets the ellipsoid, X^2 + Y^2 + Z^2 / (1 - e^2) = a^2.
        """
        scale = np.array([1.0, 1.0, 1.0 / math.sqrt(1.0 - ECCENTRICITY2)])
        foot, up = (self._origin + xy @ self._axes[:2]) * scale, self._axes[2] * scale
        a, b = float(up @ up), foot @ up
        c = np.sum(foot * foot, axis=1) - SEMI_MAJOR_M**2
        rise = -c / (b + np.sqrt(b * b - a * c))  # the root near 0
        X, Y, Z = ((foot + rise[:, None] * up) / scale).T
        latitude = np.arctan2(Z, (1.0 - ECCENTRICITY2) * np.hypot(X, Y))
        return np.degrees(latitude), np.degrees(np.arctan2(Y, X))
