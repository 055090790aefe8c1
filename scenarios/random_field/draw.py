"""The three kinds of field, as a seed draws them."""

from math import pi

import numpy as np

from scenarios.random_field import shapes
from scenarios.random_field.field import Field, Keep, check_points, ends, ends_kept, placed
from scenarios.random_field.field import scattered as scattered_circles
from scenarios.things import generator

DENSITY = {"circles": 80, "traps": 40, "forks": 40}
"""How many circles lie about, unless one says otherwise."""


def draw(seed: int, kind: str, density: int) -> Field:
    """The field of a seed.

    Args:
        seed: draws direction, circles, traps or forks, and check points.
        kind: a key of `DENSITY`.
        density: how many circles lie about.
    """
    turn = float(generator(seed, "direction").uniform(-pi, pi))
    return {"circles": _circles, "traps": _traps, "forks": _forks}[kind](seed, turn, density)


def _circles(seed: int, turn: float, density: int) -> Field:
    circles = scattered_circles(generator(seed, "circles"), density, ends_kept(turn))
    return _with_way(circles, turn, check_points(generator(seed, "check points"), circles, turn))


def _traps(seed: int, turn: float, density: int) -> Field:
    """Traps across the lane, circles elsewhere, check points beyond each trap: the straight way
    leads into it."""
    rng = generator(seed, "traps")
    count = int(rng.integers(1, len(shapes.TRAP_AT_M) + 1))
    at = rng.permutation(shapes.TRAP_AT_M)[:count]
    traps = _world(np.vstack([shapes.trap(rng, float(x)) for x in sorted(at)]), turn)
    loose = scattered_circles(generator(seed, "circles"), density, ends_kept(turn))
    circles = np.vstack([traps, loose])
    return _with_way(circles, turn, check_points(generator(seed, "check points"), circles, turn))


def _forks(seed: int, turn: float, density: int) -> Field:
    """A fork half way, circles elsewhere; its check points lead into the wrong way."""
    walls, misleading, free = shapes.fork(generator(seed, "fork"))
    x, y = placed(np.array([free[:2]]), turn)[0].tolist()
    kept = [*ends_kept(turn), Keep(x, y, free.radius_m)]
    loose = scattered_circles(generator(seed, "circles"), density, kept)
    circles = np.vstack([_world(walls, turn), loose])
    return _with_way(circles, turn, placed(misleading, turn))


def _world(lane: np.ndarray, turn: float) -> np.ndarray:
    """Circles (n, 3) of the lane frame in the world frame."""
    return np.column_stack([placed(lane[:, :2], turn), lane[:, 2]])


def _with_way(circles: np.ndarray, turn: float, between: np.ndarray) -> Field:
    start, goal = ends(turn)
    return Field(circles, np.vstack([start, between, goal]))
