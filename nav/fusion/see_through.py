"""What scanners say of cells that they did not hit: passed through, ended beside, or not seen."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.fusion.lattice import Ints
from nav.fusion.scan_geometry import Placed, ScanGeometry
from nav.messages import Floats

LOW_M = 0.5
"""What is lower than this lies below the beams of the scanner on the bumper (0.55 m)."""
Bools = NDArray[np.bool_]


class View(NamedTuple):
    """The newest scan of one scanner."""

    geometry: ScanGeometry
    scanner: Placed
    range_m: Floats


def look(views: Sequence[View], place: Floats, margin_m: float) -> tuple[Bools, Bools]:
    """What k scanners say of n cells at `place` (east, north, top), shape (3, n).

    Returns:
        through: a beam passes the cell no higher than its top. beside: no beam does, but one ends
        near the cell's distance. Both (n,). Three neighbouring beams must agree.
    """
    origin = np.array([view.scanner.origin_m for view in views])[:, :, None]  # (k, 3, 1)
    rise = np.array([view.scanner.turn[2] @ view.geometry.direction for view in views])
    level = np.sqrt(1.0 - rise * rise)
    nearest, farthest = _neighbours(np.array([view.range_m for view in views]) * level)

    x, y = place[0] - origin[:, 0], place[1] - origin[:, 1]  # (k, n)
    distance = np.sqrt(x * x + y * y)
    beam, inside = _beam(views, x, y)
    height = origin[:, 2] + distance * (rise / level).ravel()[beam]
    low = inside & (height <= place[2] + _slack_m(place[2], distance))
    over = nearest.ravel()[beam] - distance
    through = (low & (over > margin_m)).any(axis=0)
    spread = (farthest - nearest).ravel()[beam]  # when grazing, returns lie far apart
    beside = (low & (np.abs(over) <= margin_m) & (spread < 2 * margin_m)).any(axis=0)
    return through, beside & ~through


def _slack_m(top_m: Floats, distance_m: Floats) -> Floats:
    """How far above a cell's top a beam may pass and still deny it; shapes broadcast.

    Tall things are denied by a beam at the height at which they were seen. A level beam just over
    a bale must not deny it: for low things the beam must pass clearly below the top.
    """
    return np.where(top_m < LOW_M, -0.03 - 0.004 * distance_m, 0.02 + 0.002 * distance_m)


def _beam(views: Sequence[View], x: Floats, y: Floats) -> tuple[Ints, Bools]:
    """Index into all beams, (k, n), of the one above or below a place that lies (x, y) from the
    scanner, and whether there is one with two neighbours.

    The fan's beam a is forward * cos a + left * sin a; its level part is parallel to (x, y).
    """
    axes = np.array([view.scanner.turn[:2] @ view.geometry.axes for view in views])[..., None]
    forward, left = axes[:, :, 0], axes[:, :, 1]  # (k, 2, 1)
    angle = np.arctan2(forward[:, 0] * y - forward[:, 1] * x, left[:, 1] * x - left[:, 0] * y)
    fan, count = views[0].geometry, len(views[0].range_m)
    beam = np.rint((angle - fan.first_rad) * (1 / fan.step_rad)).astype(np.int64)
    inside = (beam >= 1) & (beam < count - 1)
    return np.where(inside, beam, 0) + count * np.arange(len(views))[:, None], inside


def _neighbours(range_m: Floats) -> tuple[Floats, Floats]:
    """Nearest and farthest of each beam and its two neighbours, shape (k, count)."""
    nearest, farthest = range_m.copy(), range_m.copy()
    for one, other in ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None))):
        np.minimum(nearest[:, one], range_m[:, other], out=nearest[:, one])
        np.maximum(farthest[:, one], range_m[:, other], out=farthest[:, one])
    return nearest, farthest
