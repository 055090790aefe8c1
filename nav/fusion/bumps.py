"""What stands out of the ground within one scan: the top-hat transform of its heights.

Errors of attitude and mounting tilt a whole scan, so that low obstacles drown in them. They do not
put a step between neighbouring beams. The opening (the highest of the lowest, Serra 1982) follows
ground and slopes, and cuts off what is narrower than its window; what it cuts off is a bump.
"""

import numpy as np

from nav.messages import Floats


def bumps(height_m: Floats, half_window: int) -> Floats:
    """Height of each return of one scan, in order of beams, above its opening, shape (m,), [m].

    Args:
        height_m: shape (m,).
        half_window: beams to either side that a bump may not fill; a scan of fewer returns than
            the window holds has no bumps.
    """
    reach = 2 * half_window
    if len(height_m) <= reach:
        return np.zeros(len(height_m))
    # continued as its ends run, so that a slope has no bump there
    before = 2.0 * height_m[0] - height_m[reach:0:-1]
    after = 2.0 * height_m[-1] - height_m[-2 : -reach - 2 : -1]
    padded = np.concatenate([before, height_m, after])
    lowest = _sliding(np.minimum, padded, reach + 1)
    return height_m - _sliding(np.maximum, lowest, reach + 1)


def _sliding(extreme: np.ufunc, value: Floats, width: int) -> Floats:
    """The extreme of each window of `width` values: windows of 2, 4, 8, ... that overlap."""
    span = 1
    while 2 * span <= width:
        value = extreme(value[:-span], value[span:])
        span *= 2
    rest = width - span
    return extreme(value[:-rest], value[rest:]) if rest else value
