"""What stands out of the ground within one scan: the top-hat transform of its heights.

Errors of attitude and mounting tilt a whole scan, so that low obstacles drown in them. They do not
put a step between neighbouring beams. The opening (the highest of the lowest, Serra 1982) follows
ground and slopes, and cuts off what is narrower than its window; what it cuts off is a bump.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from nav.messages import Floats


def bumps(height_m: Floats, half_window: int) -> Floats:
    """Height of each return of one scan, in order of beams, above its opening, shape (m,), [m].

    Args:
        height_m: shape (m,).
        half_window: beams to either side that a bump may not fill.
    """
    if len(height_m) < 2:
        return np.zeros(len(height_m))
    # continued as its ends run, so that a slope has no bump there
    padded = np.pad(height_m, 2 * half_window, mode="reflect", reflect_type="odd")
    width = 2 * half_window + 1
    lowest = sliding_window_view(padded, width).min(axis=1)
    return height_m - sliding_window_view(lowest, width).max(axis=1)
