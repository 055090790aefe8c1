"""From a thing of the layout to what stands in the world: one draw of the seed each."""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi, radians

import numpy as np

from scenarios.course import Gate
from scenarios.geometry import Piece, Pose
from scenarios.nqe.layout import Thing
from scenarios.things import BALE_HALF_M, BEAM_HALF_M, CAR_HALF_M, TIRE_RADIUS_M, Site, extent_m
from twin.world import Obstacle, Terrain

SHIFT_M = 5.0
"""Things stand anywhere in 10 m along the track."""
YAW_RAD = radians(15.0)
GATE_YAW_RAD = radians(8.0)
GATE_WIDTH_M = (3.2, 4.5)
GATE_OFFSET_M = {True: (0.8, 1.5), False: (0.0, 0.3)}
CAR_COVER_M = (0.55, 0.9)
"""How far a car reaches across the route line."""
COVER_M = (0.1, 0.5)
"""The same of smaller things."""
PAIR_M = (28.5, 32.5)
"""From one car of the two-car section to the other: about 100 ft."""
POST_RADIUS_M, POST_HEIGHT_M = 0.08, 1.3
WALL_HALF_THICKNESS_M = 0.2
"""Of a jersey barrier."""
WALL_HEIGHT_M = (0.8, 1.0)
WALL_BEYOND_M = 0.4
"""The flanks end this far outside the corridor."""


@dataclass(frozen=True)
class Draw:
    """What it takes to place one thing."""

    name: str
    thing: Thing
    straight: Piece
    half_width_m: float
    """Of the corridor there."""
    terrain: Terrain
    rng: np.random.Generator

    def uniform(self, low: float, high: float) -> float:
        """A number from the thing's own generator."""
        return float(self.rng.uniform(low, high))

    def side(self) -> float:
        """1 for left or -1 for right."""
        return float(self.rng.choice((1.0, -1.0)))

    def site(self, pose: Pose, suffix: str = "") -> Site:
        """The place `pose`, under this thing's name and kind."""
        return Site(self.name + suffix, self.thing.kind, self.terrain, pose)

    def beside(self, station_m: float, side: float, half_m: tuple[float, float],
               cover_m: tuple[float, float]) -> Pose:  # fmt: skip
        """Where a thing stands on one `side`, turned a little, and reaches across the line."""
        turn = self.uniform(-YAW_RAD, YAW_RAD)
        left = side * (extent_m(half_m, turn) - self.uniform(*cover_m))
        return self.straight.pose(station_m).moved(0.0, left, turn)

    def shifted_m(self) -> float:
        """The thing's station, moved."""
        return self.thing.at_m + self.uniform(-SHIFT_M, SHIFT_M)


def gate(draw: Draw) -> tuple[list[Obstacle], Gate]:
    """Two posts, and walls from them to beyond the corridor's edges: the opening is the only way.

    The width is measured between the posts' faces, along the gate.
    """
    width, turn = draw.uniform(*GATE_WIDTH_M), draw.uniform(-GATE_YAW_RAD, GATE_YAW_RAD)
    left = draw.side() * draw.uniform(*GATE_OFFSET_M[draw.thing.offset])
    pose = draw.straight.pose(draw.thing.at_m).moved(0.0, left, turn)
    height = draw.uniform(*WALL_HEIGHT_M)
    opening, parts = Gate(*(np.array(pose.at(0.0, e * width / 2.0)) for e in (1, -1))), []
    for side, word in ((1.0, "left"), (-1.0, "right")):
        post = width / 2.0 + POST_RADIUS_M
        end = (draw.half_width_m + WALL_BEYOND_M - side * left) / cos(turn)
        half = ((end - post) / 2.0, WALL_HALF_THICKNESS_M)
        wall = pose.moved(0.0, side * (post + end + POST_RADIUS_M) / 2.0, pi / 2.0)
        site = draw.site(pose)
        parts += [
            site._replace(kind="gate_post").cylinder(
                f"post_{word}", pose.moved(0.0, side * post), POST_RADIUS_M, POST_HEIGHT_M
            ),
            site._replace(kind="gate_flank").box(f"flank_{word}", wall, half, height),
        ]
    return parts, opening


def car(draw: Draw) -> list[Obstacle]:
    """A parked car that covers the route line."""
    pose = draw.beside(draw.shifted_m(), draw.side(), CAR_HALF_M, CAR_COVER_M)
    return draw.site(pose).car()


def two_cars(draw: Draw) -> list[Obstacle]:
    """Two cars about 100 ft apart, one on each side, both across the route line."""
    middle, apart, side = draw.shifted_m(), draw.uniform(*PAIR_M), draw.side()
    first = draw.beside(middle - apart / 2.0, side, CAR_HALF_M, CAR_COVER_M)
    second = draw.beside(middle + apart / 2.0, -side, CAR_HALF_M, CAR_COVER_M)
    sites = draw.site(first, "_first"), draw.site(second, "_second")
    return [part for site in sites for part in site._replace(kind="car").car()]


def hay_bale(draw: Draw) -> list[Obstacle]:
    """Two bales end to end, in one or two layers."""
    half = BALE_HALF_M[1], 2.0 * BALE_HALF_M[0]
    pose = draw.beside(draw.shifted_m(), draw.side(), half, COVER_M)
    return draw.site(pose).bales(draw.thing.layers)


def tires(draw: Draw) -> list[Obstacle]:
    """Stacks of tires."""
    half = TIRE_RADIUS_M, 0.7 + TIRE_RADIUS_M
    return draw.site(draw.beside(draw.shifted_m(), draw.side(), half, COVER_M)).tires()


def tank_trap(draw: Draw) -> list[Obstacle]:
    """Crossed steel beams."""
    half = BEAM_HALF_M[0], BEAM_HALF_M[0]
    return draw.site(draw.beside(draw.shifted_m(), draw.side(), half, COVER_M)).tank_trap()


def rumble_strip(draw: Draw) -> list[Obstacle]:
    """Bars across the track."""
    return draw.site(draw.straight.pose(draw.shifted_m())).rumble_strips()


PLACE: dict[str, Callable[[Draw], list[Obstacle]]] = {
    f.__name__: f for f in (car, two_cars, hay_bale, tires, tank_trap, rumble_strip)
}
