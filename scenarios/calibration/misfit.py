"""How far what was felt lies from what should have been, in units of its scatter.

Means over 0.1 s are compared: the body moves below 3 Hz. Where tires slide they chatter at 30 to
100 Hz, and in the twin as on the tape that is never twice the same: of such a second only the mean
is compared. The scatter is read from the tape itself, by second differences.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scenarios.calibration.evidence import Evidence, Floats, Ints, Series
from scenarios.calibration.retrace import Felt
from twin import clock
from twin.vehicle import WHEEL_RADIUS_M

Bools = NDArray[np.bool_]

MEAN_STEPS = clock.STEPS_PER_SECOND // 10
SECOND = clock.STEPS_PER_SECOND
CHATTER = 2.0
"""A second that scatters so many times as much as usual is one of chatter (estimated)."""
MOVING_MPS = 1.0
"""Below it tooth counters, which know no sign, and a GPS speed are not compared."""


class Means(NamedTuple):
    """One kind of sensor, as it is compared."""

    bin: Ints
    """Shape (samples,): which mean each sample belongs to."""
    time_s: Floats
    """Shape (means,): when each begins."""
    value: Floats
    """Shape (means, channels)."""
    sd: Floats
    """As `value`: one sigma of it."""
    used: Bools
    """As `value`."""

    def of(self, value: Floats) -> Floats:
        """The means of other samples at the same times."""
        return _means(self.bin, value)


def means(evidence: Evidence) -> dict[str, Means]:
    """All that is compared, by the names of `Evidence`."""
    chatters = _chatters(evidence.imu)
    return {
        "imu": _compared(evidence.imu, chatters, -np.inf),
        "wheels": _compared(evidence.wheels, chatters, MOVING_MPS),
        "gps": _compared(evidence.gps, chatters, MOVING_MPS),
    }


def differences(compared: Mapping[str, Means], felt: Felt) -> dict[str, Floats]:
    """Felt less what should have been, over its sigma; 0 where nothing is compared.

    What an instrument adds to all that it says is taken out by least squares: a bias of each gyro
    and accelerometer, the radius of each tire.
    """
    wheels = compared["wheels"].of(WHEEL_RADIUS_M * np.abs(felt.wheels))
    imu = compared["imu"].of(felt.imu)
    gps = compared["gps"].of(felt.gps)
    return {
        "imu": _without(np.ones_like(imu), imu, compared["imu"]),
        "wheels": _without(wheels, wheels, compared["wheels"]),
        "gps": _without(np.zeros_like(gps), gps, compared["gps"]),
    }


def vector(compared: Mapping[str, Means], felt: Felt) -> Floats:
    """All differences that count, one after the other, shape (n,)."""
    found = differences(compared, felt)
    return np.concatenate([found[name][c.used] for name, c in compared.items()])


def scatter(series: Series) -> Floats:
    """One sigma of a sample's noise in each second, shape (seconds, channels).

    The second difference of white noise has six times its variance, and a motion has nearly none.
    """
    second = (series.step - 1) // SECOND
    found = np.full((second.max() + 1, series.value.shape[1]), np.nan)
    for s in np.unique(second):
        there = np.diff(series.value[second == s], 2, axis=0)
        if len(there):
            found[s] = np.sqrt((there**2).mean(axis=0) / 6.0)
    return found


def _chatters(imu: Series) -> Bools:
    scattered = scatter(imu)
    loud: Bools = scattered > CHATTER * np.nanmedian(scattered, axis=0)
    return np.logical_or.reduce(loud, axis=1)


def _compared(series: Series, chatters: Bools, least: float) -> Means:
    step, value = series
    scattered = scatter(series)
    second = np.minimum((step - 1) // SECOND, len(chatters) - 1)
    first = np.where(chatters[second], second * SECOND, (step - 1) // MEAN_STEPS * MEAN_STEPS)
    begins, bin = np.unique(first, return_inverse=True)
    whole, usual = begins // SECOND, np.nanmedian(scattered, axis=0)
    rough = chatters[np.minimum(whole, len(chatters) - 1)]
    louder = np.fmax(scattered[np.minimum(whole, len(scattered) - 1)], usual)
    count = np.bincount(bin)[:, None]
    # Samples of a chatter alias: their mean is no better known than one of them.
    sd = np.where(rough[:, None], louder, usual / np.sqrt(count))
    lowest = np.full(sd.shape, np.inf)
    np.minimum.at(lowest, bin, value)
    full = count >= np.median(count[~rough]) * np.where(rough, SECOND // MEAN_STEPS, 1)[:, None] / 2
    return Means(bin, begins / SECOND, _means(bin, value), sd, (lowest > least) & full)


def _means(bin: Ints, value: Floats) -> Floats:
    columns = [np.bincount(bin, column) for column in value.T]
    return np.stack(columns, axis=1) / np.bincount(bin)[:, None]


def _without(shape: Floats, felt: Floats, measured: Means) -> Floats:
    """The difference over its sigma, less as much of `shape` as makes it smallest."""
    difference = np.where(measured.used, (measured.value - felt) / measured.sd, 0.0)
    shape = np.where(measured.used, shape / measured.sd, 0.0)
    norm = (shape**2).sum(axis=0)
    amount = (shape * difference).sum(axis=0) / np.where(norm > 0.0, norm, 1.0)
    return difference - amount * shape
