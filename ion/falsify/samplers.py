"""Where to look next, in the unit cube: at random, or where a model of what is known says.

The model is a Gaussian process over the cube (Rasmussen and Williams 2006): a smooth guess of the
cost everywhere, and how sure it is. The next place is where the cost may be lowest: guess less two
standard deviations (Srinivas et al. 2010). Seeds are noise to it, whose size it finds itself.
Of made-up functions with a rare corner, CMA-ES and TPE needed half as many drives again, and up to
three times as many; a drive costs ten times what a proposal does.
"""

import warnings
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

START = 7
"""The middle and a scrambled Sobol sequence are looked at before the model begins. One less than a
power of two: only of so many is the sequence balanced."""
MOST = 200
"""The model knows the lowest of so many costs; more only make it slow."""
ANYWHERE, AROUND = 1024, 256
"""Places that are compared: all over the cube, and around each of the lowest known."""
LOWEST, REACH = 3, 0.1
CORNERS = 64
SIGMAS = 2.0
LENGTHS, NOISES = (0.1, 10.0), (1e-3, 1.0)
"""Within which the process finds its own; the noise as a share of the costs' variance."""


class Sampler(Protocol):
    """Looks for the lowest cost."""

    def ask(self, places: Floats, costs: Floats) -> Floats:
        """The next place, shape (d,), after these (n, d) and their costs (n,)."""
        ...


class Random:
    """Any place, for comparison."""

    def __init__(self, axes: int, seed: int) -> None:
        self._axes, self._rng = axes, np.random.default_rng(seed)

    def ask(self, places: Floats, costs: Floats) -> Floats:
        """As `Sampler` says."""
        del places, costs  # Unused.
        return self._rng.random(self._axes)


class Model:
    """Where the model expects the lowest cost."""

    def __init__(self, axes: int, seed: int) -> None:
        from scipy.stats import qmc

        self._axes, self._rng = axes, np.random.default_rng(seed)
        sobol = qmc.Sobol(axes, rng=seed).random(START + 1) if axes else np.zeros((START, 0))
        self._start = np.vstack([np.full((1, axes), 0.5), sobol])[:START]

    def ask(self, places: Floats, costs: Floats) -> Floats:
        """As `Sampler` says."""
        if len(costs) < START or not self._axes:
            return self._start[min(len(costs), START - 1)]
        lowest = np.argsort(costs, kind="stable")[:MOST]
        candidates = self._candidates(places[lowest[:LOWEST]])
        guess, sd = predicted(places[lowest], costs[lowest], candidates)
        return candidates[np.argmin(guess - SIGMAS * sd)]

    def _candidates(self, lowest: Floats) -> Floats:
        anywhere = self._rng.random((ANYWHERE, self._axes))
        corners = np.rint(self._rng.random((CORNERS, self._axes)))
        near = np.repeat(lowest, AROUND, axis=0)
        near = near + REACH * self._rng.standard_normal(near.shape)
        return np.vstack([anywhere, corners, np.clip(near, 0.0, 1.0)])


SAMPLERS: dict[str, Callable[[int, int], Sampler]] = {"model": Model, "random": Random}
"""By the name that `--sampler` takes: made of the number of axes and a seed."""


def predicted(places: Floats, costs: Floats, elsewhere: Floats) -> tuple[Floats, Floats]:
    """The cost at other places, shape (m,), and its standard deviation, after `places` (n, d) and
    `costs` (n,); the process finds its own length for each axis, and its noise."""
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import Matern, WhiteKernel

    lengths: Any = np.ones(places.shape[1])
    kernel = 1.0 * Matern(lengths, LENGTHS, nu=2.5) + WhiteKernel(0.05, NOISES)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)  # a length at its bound is none
        process: Any = GaussianProcessRegressor(kernel, normalize_y=True).fit(places, costs)
    return process.predict(elsewhere, return_std=True)
