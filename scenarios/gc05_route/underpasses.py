"""Where the three narrow underpasses are: on straight segments that are long enough."""

import numpy as np
from numpy.typing import NDArray

from scenarios.course import Floats

AT = (0.16, 0.47, 0.74)
"""As shares of the waypoints (estimated: nothing but their number is known)."""
LONG_M = 75.0
STRAIGHT_RAD = 0.12
"""Of the turns at both ends of their segment."""


def segments(position_m: Floats) -> list[int]:
    """The segment of each, given the waypoints (n, 2): the nearest that will do."""
    step = np.diff(position_m, axis=0)
    length = np.hypot(*step.T)
    will_do = np.flatnonzero((length > LONG_M) & _straight(step))
    wanted = [share * len(position_m) for share in AT]
    return [int(will_do[np.abs(will_do - w).argmin()]) for w in wanted]


def _straight(step: Floats) -> NDArray[np.bool_]:
    heading = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
    turn = np.abs(np.diff(heading))
    return np.maximum(np.append(np.inf, turn), np.append(turn, np.inf)) < STRAIGHT_RAD
