"""Speed along the route before any obstacle is known: limits, bends, and braking for both."""

import numpy as np

from nav.messages import Floats
from nav.parameters.planning import SpeedProfileParameters
from nav.route.smooth_path import SmoothPath


def speed_profile(route: SmoothPath, half_width_m: Floats, p: SpeedProfileParameters) -> Floats:
    """V0 at every sample of the smooth path, shape (k,), [m/s], given the corridor's half-width at
    each, shape (k,).

    Never above the speed limit, the cap or what the bend allows, and falling no faster towards
    what lies ahead than `braking_mps2`.
    """
    bend = np.sqrt(p.lateral_mps2 / np.maximum(np.abs(route.curvature_per_m), 1e-4))
    fast, clear = route.speed_limit_mps >= p.open_limit_mps, half_width_m < p.open_half_width_m
    cap = np.where(fast, np.where(clear, p.open_mps, p.wide_mps), p.cap_mps)
    limit = np.minimum(p.limit_factor * route.speed_limit_mps, cap)
    squared = np.minimum(limit, bend) ** 2
    gained = 2.0 * p.braking_mps2 * route.arc_m
    # v_i^2 <= v_j^2 + 2 a (s_j - s_i) for all j >= i is a running minimum from behind
    reachable = np.minimum.accumulate((squared + gained)[::-1])[::-1] - gained
    return np.sqrt(reachable)
