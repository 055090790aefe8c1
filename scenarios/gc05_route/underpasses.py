"""Where the three narrow underpasses are: on straight segments that are long enough."""

import numpy as np

from scenarios.course import Floats
from scenarios.route.statistics import turns_of

AT = (0.16, 0.47, 0.74)
"""As shares of the waypoints (estimated: nothing but their number is known)."""
LONG_M = 75.0
STRAIGHT_RAD = 0.12
"""Of the turns at both ends of their segment."""


def segments(position_m: Floats) -> list[int]:
    """The segment of each, given the waypoints (n, 2): the nearest that will do."""
    length = np.hypot(*np.diff(position_m, axis=0).T)
    turn = np.abs(turns_of(position_m))
    both = np.maximum(np.append(np.inf, turn), np.append(turn, np.inf))
    will_do = np.flatnonzero((length > LONG_M) & (both < STRAIGHT_RAD))
    wanted = [share * len(position_m) for share in AT]
    return [int(will_do[np.abs(will_do - w).argmin()]) for w in wanted]
