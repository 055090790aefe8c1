"""From cells to things, as a scenario file places them."""

from math import cos, degrees, sin

import numpy as np

from ion.reconstruct.groups import groups
from ion.reconstruct.rectangles import LEAST_M, Rectangle, pieces, smallest
from ion.reconstruct.standing import standing
from ion.reconstruct.tally import Ints, Tally
from nav.messages import Floats
from scenarios.planned import Thing

SEEN, SOFT = "seen", "brush"
"""What a thing is, nobody knows; that it was seen is sure. But what was driven through is soft."""
THROUGH_M = 0.4
"""The middle of the rear axle comes no nearer to what is hard: half the vehicle's width is 0.76 m,
and the estimate drifts by decimetres."""
NEAR_M = 10.0
"""From the driven way: what is farther off was seen by few beams, and stands in nobody's way."""
LEAST_RETURNS = 10
"""Of a whole thing: less is a bird, a leaf, or dust."""
LOW_M = 0.3
"""No thing is lower: the map would not have taken it for one."""
TOP_SHARE = 0.9
"""Of the cells of a thing that end below its top: the rest are beams that met it half."""
POST_M = 0.3
"""What is no longer is taken for round."""


def things(tally: Tally, held: Ints, way_m: Floats, cell_m: float) -> list[Thing]:
    """What stood near the way, as boxes and posts.

    Args:
        tally: where beams met obstacles.
        held: numbers of the cells that the map held when it saw them last.
        way_m: where the vehicle was, shape (n, 2), route frame N.
        cell_m: edge of a cell.
    """
    away_m = _away_m(tally, way_m)
    near = standing(tally.where(away_m < NEAR_M), held, away_m[away_m < NEAR_M])
    found: list[Thing] = []
    for group in groups(near.cell):
        if near.returns[group].sum() >= LEAST_RETURNS:
            parts = pieces(near.place_m[group], cell_m)
            found += [_thing(near.where(group[p]), way_m) for p in parts]
    return found


def _away_m(tally: Tally, way_m: Floats) -> Floats:
    """From the way, of each cell; one by one, as the whole table would not fit into memory."""
    nearest = [float(np.square(way_m - place).sum(axis=1).min()) for place in tally.place_m]
    return np.sqrt(np.array(nearest, dtype=np.float64))


def _thing(cells: Tally, way_m: Floats) -> Thing:
    rectangle = thickened(smallest(cells.place_m), way_m)
    height_m = max(float(np.quantile(cells.top_m, TOP_SHARE)), LOW_M)
    half = max(rectangle.half_length, LEAST_M / 2.0), rectangle.half_width
    soft = rectangle.distance_m(way_m).min() < THROUGH_M
    return Thing(
        kind=SOFT if soft else SEEN,
        at_m=(round(rectangle.x, 2), round(rectangle.y, 2)),
        half_m=(round(half[0], 2), round(half[1], 2)),
        height_m=round(height_m, 2),
        yaw_deg=round(degrees(rectangle.heading), 1),
        shape="cylinder" if 2.0 * rectangle.half_length <= POST_M else "box",
        shift_m=0.0,
    )


def thickened(face: Rectangle, way_m: Floats) -> Rectangle:
    """A thing of some thickness, of which a face was seen from the way (n, 2): it lies behind."""
    more = LEAST_M / 2.0 - face.half_width
    if more <= 0.0:
        return face
    nearest = way_m[np.hypot(*(way_m - (face.x, face.y)).T).argmin()]
    away = -1.0 if face.inside(nearest[None])[0, 1] > 0.0 else 1.0
    x, y = face.x - away * more * sin(face.heading), face.y + away * more * cos(face.heading)
    return face._replace(x=x, y=y, half_width=LEAST_M / 2.0)


def rectangle_of(thing: Thing) -> Rectangle:
    """Its outline in plan view; of a post the square around it."""
    x, y = thing.at_m
    length, width = thing.half_m
    return Rectangle(x, y, length, width, float(np.radians(thing.yaw_deg)))
