"""The route line: from legs to stations, limits and waypoints."""

from dataclasses import dataclass
from itertools import pairwise
from math import cos, sin

import numpy as np

from nav.route.rddf import FOOT_M
from scenarios.geometry import Leg as Line
from scenarios.geometry import Pose, center_line
from scenarios.nqe.layout import Layout, Leg, Limit
from twin.earth import to_geodetic

FILL_M = 20.0
"""Longest spacing of waypoints on a straight."""
LEAD_M = (6.0, 15.0)
"""Waypoints this far from an arc, so that the cubic (6.4) meets it gently. From the farther one on
the limit of the turn holds."""


@dataclass(frozen=True)
class Waypoint:
    """One line of the route file before it is written."""

    pose: Pose
    half_width_ft: float
    speed_mph: float


@dataclass(frozen=True)
class Datum:
    """Where the whole course lies in the world: turned about its start, then moved."""

    east_m: float
    north_m: float
    turn_rad: float

    def place(self, point: tuple[float, float], start: tuple[float, float]) -> tuple[float, float]:
        """World position [m] of a point of the layout."""
        x, y = point[0] - start[0], point[1] - start[1]
        c, s = cos(self.turn_rad), sin(self.turn_rad)
        return start[0] + self.east_m + c * x - s * y, start[1] + self.north_m + s * x + c * y


def lines(layout: Layout, datum: Datum) -> list[Line]:
    """The route line in the world frame, leg by leg."""
    corners = [layout.start_m, *(leg.to_m for leg in layout.legs)]
    radii = [leg.turn_radius_m for leg in layout.legs[:-1]]
    return center_line([datum.place(corner, layout.start_m) for corner in corners], radii)


def limit_at(leg: Leg, station_m: float) -> Limit:
    """What holds `station_m` along the leg's straight."""
    return [limit for limit in leg.limits if limit.from_m <= station_m + 1e-6][-1]


def half_width_m(leg: Leg, station_m: float) -> float:
    """The corridor's half-width `station_m` along the leg's straight."""
    return limit_at(leg, station_m).half_width_ft * FOOT_M


def waypoints(layout: Layout, track: list[Line]) -> list[Waypoint]:
    """All waypoints, the start and the finish included."""
    found: list[Waypoint] = []
    arc_before = False
    for leg, line in zip(layout.legs, track, strict=True):
        arc_after = line.turn.length_m > 0.0
        for s in _stations(leg, line.straight.length_m, arc_before, arc_after)[:-1]:
            limit = limit_at(leg, s)
            braking = arc_after and s >= line.straight.length_m - LEAD_M[1]
            speed = min(limit.speed_mph, leg.turn_mph) if braking else limit.speed_mph
            found.append(Waypoint(line.straight.pose(s), limit.half_width_ft, speed))
        found += _arc(leg, line) if arc_after else []
        arc_before = arc_after
    last = track[-1].straight
    end = layout.legs[-1].limits[-1]
    return [*found, Waypoint(last.pose(last.length_m), end.half_width_ft, end.speed_mph)]


def _stations(leg: Leg, length: float, arc_before: bool, arc_after: bool) -> list[float]:
    """Where waypoints stand on a straight: at its ends, where limits change, before arcs."""
    fixed = [0.0, *(limit.from_m for limit in leg.limits[1:]), length]
    if length > 3.0 * LEAD_M[1]:
        fixed += [lead for lead in LEAD_M if arc_before]
        fixed += [length - lead for lead in LEAD_M if arc_after]
        return _filled(_spaced(sorted(fixed)), FILL_M)
    return _filled(fixed, 0.5 * LEAD_M[1])


def _spaced(stations: list[float], least_m: float = 3.0) -> list[float]:
    """Without those that come too soon after another; the last one stays."""
    kept = stations[:1]
    kept += [b for a, b in pairwise(stations[:-1]) if b - a >= least_m]
    return [*kept, stations[-1]]


def _filled(stations: list[float], most_m: float) -> list[float]:
    """With points added so that none are farther apart than `most_m`."""
    filled: list[float] = []
    for a, b in pairwise(stations):
        count = max(1, int(np.ceil((b - a) / most_m)))
        filled += [a + (b - a) * k / count for k in range(count)]
    return [*filled, stations[-1]]


def _arc(leg: Leg, line: Line) -> list[Waypoint]:
    """Waypoints on the arc, its beginning included, its end not."""
    arc = line.turn
    spacing = float(np.clip(0.45 * leg.turn_radius_m, 4.0, 8.0))
    count = max(1, int(arc.length_m / spacing))
    width = leg.limits[-1].half_width_ft
    return [Waypoint(arc.pose(arc.length_m * k / count), width, leg.turn_mph) for k in range(count)]


def rddf(track: list[Waypoint], anchor: tuple[float, float]) -> str:
    """The route file's text; ten decimals of a degree are a hundredth of a millimetre."""
    lat, lon = to_geodetic(
        anchor, np.array([w.pose.x for w in track]), np.array([w.pose.y for w in track])
    )
    rows = zip(track, lat, lon, strict=True)
    return "".join(
        f"{k},{a:.10f},{b:.10f},{w.half_width_ft:g},{w.speed_mph:g},####,####,####\n"
        for k, (w, a, b) in enumerate(rows, start=1)
    )
