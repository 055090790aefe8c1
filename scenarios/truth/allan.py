"""The overlapping Allan deviation (IEEE Std 952, annex C; NIST SP 1065, section 5.2.4)."""

import numpy as np

from scenarios.truth.check import Floats


def allan_deviation(rate: Floats, interval_s: float, averaged: Floats) -> Floats:
    """Of a rate (n,), sampled every `interval_s`, at averages of so many samples, (m,).

    With theta the sum of the rate, sigma^2(m) = <(theta[k + 2m] - 2 theta[k + m] + theta[k])^2> /
    (2 (m dt)^2).
    """
    theta = np.concatenate([[0.0], np.cumsum(rate) * interval_s])
    found = np.empty(len(averaged))
    for k, m in enumerate(averaged.astype(int)):
        second = theta[2 * m :] - 2.0 * theta[m:-m] + theta[: -2 * m]
        found[k] = np.sqrt(np.mean(second**2) / 2.0) / (m * interval_s)
    return found
