"""Plane geometry of courses: a centre line of straights and arcs, and places beside it."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, cos, hypot, pi, sin, tan
from typing import NamedTuple

Point = tuple[float, float]


class Pose(NamedTuple):
    """A place on the ground and a heading, [m] and [rad]."""

    x: float
    y: float
    heading: float

    def at(self, forward: float, left: float) -> Point:
        """The point that lies so far [m] ahead and to the left."""
        c, s = cos(self.heading), sin(self.heading)
        return self.x + c * forward - s * left, self.y + s * forward + c * left

    def moved(self, forward: float, left: float, turn_rad: float = 0.0) -> "Pose":
        """The pose that lies so far [m] ahead and to the left, turned to the left."""
        return Pose(*self.at(forward, left), self.heading + turn_rad)


class Piece(NamedTuple):
    """A straight or an arc of the centre line."""

    start: Pose
    length_m: float
    curvature: float
    """[1/m], left positive; 0 on a straight."""

    def pose(self, station_m: float) -> Pose:
        """The pose `station_m` along this piece."""
        if self.curvature == 0.0:
            return self.start.moved(station_m, 0.0)
        turn = self.curvature * station_m
        return self.start.moved(sin(turn) / self.curvature, (1 - cos(turn)) / self.curvature, turn)


@dataclass(frozen=True)
class Leg:
    """One straight of a centre line and the turn at its end (of length 0 where there is none)."""

    straight: Piece
    turn: Piece


def center_line(corners: Sequence[Point], radii_m: Sequence[float]) -> list[Leg]:
    """Legs through n corners, each inner one rounded by an arc.

    Args:
        corners: n points, start and end included, [m].
        radii_m: n - 2 radii of the inner corners; 0 leaves a corner as it is.

    Raises:
        ValueError: a leg too short for the arcs at its ends.
    """
    headings = [atan2(b[1] - a[1], b[0] - a[0]) for a, b in pairwise(corners)]
    turns = [_wrap(b - a) for a, b in pairwise(headings)]
    cuts = [0.0, *(r * tan(abs(t) / 2.0) for r, t in zip(radii_m, turns, strict=True)), 0.0]
    legs: list[Leg] = []
    for k, (a, b) in enumerate(pairwise(corners)):
        length = hypot(b[0] - a[0], b[1] - a[1]) - cuts[k] - cuts[k + 1]
        if length < 0.0:
            raise ValueError(f"leg to {b}: {-length:.1f} m too short for the arcs at its ends")
        straight = Piece(Pose(*a, headings[k]).moved(cuts[k], 0.0), length, 0.0)
        turn, radius = [*turns, 0.0][k], [*radii_m, 0.0][k]
        curvature = (1.0 if turn > 0.0 else -1.0) / radius if radius else 0.0
        legs.append(Leg(straight, Piece(straight.pose(length), radius * abs(turn), curvature)))
    return legs


def _wrap(angle: float) -> float:
    return (angle + pi) % (2.0 * pi) - pi
