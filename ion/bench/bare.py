"""Bare physics: MuJoCo's step and nothing else."""

import copy
import time

import mujoco

from twin import tire_collision
from twin.body import Body


class Bare:
    """The world of a vehicle as it is now, to be stepped by stock MuJoCo.

    It goes on from the same state over the same ground, its controls and the drag of the air held
    as they are: all in one call of `mj_step`, with MuJoCo's own function for tires on the ground.
    That is put back into the table of this process while it runs.
    """

    def __init__(self, body: Body) -> None:
        self._model, self._data = copy.copy(body.model), copy.copy(body.data)

    def wall_s(self, steps: int) -> float:
        """Wall time of so many steps of 1/300 s, [s]; the vehicle drives on."""
        with tire_collision.stock():
            start_s = time.perf_counter()
            mujoco.mj_step(self._model, self._data, steps)
            return time.perf_counter() - start_s
