"""Brush holds a vehicle back without stopping it."""

from collections.abc import Sequence
from math import hypot

import numpy as np

from twin.world import Obstacle

DRAG_N = 700.0
"""Of one bush that the vehicle is in (estimated: what a driver feels as a hard push)."""
REACH_M = 1.3
"""The vehicle is in a bush when its middle is this near to it: between half its width and half its
length."""
FULL_MPS = 0.3
"""From this speed on the drag is full; a standing vehicle is not pushed."""


class Brush:
    """Where bushes stand, and what they do."""

    def __init__(self, bushes: Sequence[Obstacle]) -> None:
        self._place = np.array([o.center_m[:2] for o in bushes]).reshape(-1, 2)
        self._half = np.array([o.half_size_m[:2] for o in bushes]).reshape(-1, 2)

    def drag_n(self, x_m: float, y_m: float, speed_mps: float) -> float:
        """Force against the motion of a vehicle whose middle is at x, y; bushes are taken for
        boxes along the axes of the world."""
        gap = np.maximum(np.abs(self._place - (x_m, y_m)) - self._half, 0.0)
        within = int(np.count_nonzero(np.hypot(gap[:, 0], gap[:, 1]) < REACH_M))
        return within * DRAG_N * min(speed_mps / FULL_MPS, 1.0)


def resisted(force: tuple[float, float, float], velocity: Sequence[float], drag_n: float
             ) -> tuple[float, float, float]:  # fmt: skip
    """A force less a drag against the horizontal velocity, [N]."""
    vx, vy = velocity[:2]
    speed = max(hypot(vx, vy), 1e-6)
    return force[0] - drag_n * vx / speed, force[1] - drag_n * vy / speed, force[2]
