"""The twin counts physics steps; nanoseconds are derived, so that time never drifts."""

STEPS_PER_SECOND = 300
"""Measured: a step of 1/300 s is nearly converged on rough ground."""
STEP_S = 1.0 / STEPS_PER_SECOND


def time_ns(k: int) -> int:
    """Time of step `k`, [ns]."""
    return k * 10**9 // STEPS_PER_SECOND


def interval(rate_hz: float) -> int:
    """Steps between two samples of a device that runs at `rate_hz`.

    Raises:
        ValueError: the rate does not divide 300 Hz; the message names its valid neighbours.
    """
    if not 0.0 < rate_hz < float("inf"):
        raise ValueError(f"rate of {rate_hz} Hz: expected a positive number")
    steps = max(1, round(STEPS_PER_SECOND / rate_hz))
    if steps * rate_hz != STEPS_PER_SECOND:
        raise ValueError(
            f"rate of {rate_hz:g} Hz does not divide {STEPS_PER_SECOND} Hz;"
            f" {_neighbours(rate_hz)} would"
        )
    return steps


def _neighbours(rate_hz: float) -> str:
    below = int(STEPS_PER_SECOND // rate_hz) + 1
    rates = [STEPS_PER_SECOND / n for n in (below, below - 1) if n >= 1]
    return " or ".join(f"{rate:.6g} Hz" for rate in rates)
