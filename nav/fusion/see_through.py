"""What scanners say of cells that they did not hit: passed through, ended beside, or not seen."""

import numpy as np
from numpy.typing import NDArray

from nav.fusion.lattice import Ints
from nav.fusion.scan_geometry import Scans
from nav.messages import Floats

LOW_M = 0.5
"""What is lower than this lies below the beams of the scanner on the bumper (0.55 m)."""
Bools = NDArray[np.bool_]


def look(scans: Scans, place: Floats, margin_m: float) -> tuple[Bools, Bools]:
    """What k scans say of n cells at `place` (east, north, top), shape (3, n).

    Returns:
        through: a beam passes the cell no higher than its top. beside: no beam does, but one ends
        near the cell's distance. Both (n,). Three neighbouring beams must agree.
    """
    rise = scans.frame[:, 2, :2] @ scans.geometry[0].ray  # (k, count), for each metre of beam
    level = np.sqrt(1.0 - rise * rise)
    nearest, farthest = _of_three(scans.range_m * level)

    x, y, z = scans.frame[:, :, 2].T[..., None]  # (k, 1) each
    x, y = place[0] - x, place[1] - y  # (k, n)
    distance = np.sqrt(x * x + y * y)
    beam, inside = _beam(scans, x, y)
    height = z + distance * (rise / level)[:, 1:-1].ravel().take(beam)
    low = inside & (height <= place[2] + _slack_m(place[2], distance))
    over = nearest.take(beam) - distance
    through = (low & (over > margin_m)).any(axis=0)
    spread = (farthest - nearest).take(beam)  # when grazing, returns lie far apart
    beside = (low & (np.abs(over) <= margin_m) & (spread < 2 * margin_m)).any(axis=0)
    return through, beside & ~through


def _slack_m(top_m: Floats, distance_m: Floats) -> Floats:
    """How far above a cell's top a beam may pass and still deny it; shapes broadcast.

    Tall things are denied by a beam at the height at which they were seen. A level beam just over
    a bale must not deny it: for low things the beam must pass clearly below the top.
    """
    return np.where(top_m < LOW_M, -0.03 - 0.004 * distance_m, 0.02 + 0.002 * distance_m)


def _beam(scans: Scans, x: Floats, y: Floats) -> tuple[Ints, Bools]:
    """Index into all beams that have two neighbours, (k, n), of the one above or below a place
    that lies (x, y) from the scanner, and whether there is one.

    The fan's beam a is forward * cos a + left * sin a; its level part is parallel to (x, y).
    """
    forward, left = scans.frame[:, :2, 0, None], scans.frame[:, :2, 1, None]  # (k, 2, 1)
    angle = np.arctan2(forward[:, 0] * y - forward[:, 1] * x, left[:, 1] * x - left[:, 0] * y)
    fan, inner = scans.geometry[0], scans.range_m.shape[1] - 2
    beam = np.rint((angle - fan.first_rad) * (1 / fan.step_rad)).astype(np.int64) - 1
    inside = (beam >= 0) & (beam < inner)
    return np.where(inside, beam, 0) + inner * np.arange(len(beam))[:, None], inside


def _of_three(range_m: Floats) -> tuple[Floats, Floats]:
    """Nearest and farthest of each beam and its two neighbours, shape (k, count - 2)."""
    right, left = range_m[:, :-1], range_m[:, 1:]
    nearer, farther = np.minimum(right, left), np.maximum(right, left)
    return np.minimum(nearer[:, :-1], nearer[:, 1:]), np.maximum(farther[:, :-1], farther[:, 1:])
