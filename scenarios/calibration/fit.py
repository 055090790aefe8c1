"""Parameters of the vehicle from a tape, with `mujoco.sysid`.

Of sysid its parameters, its optimizer and its covariance are used. Its own rollout holds a control
signal in `ctrl`; the Ranger's actuators answer to its speed a hundred times a second (steering
geometry, coupled wheels, brakes as joint friction, tires that soften), so the rollout is ours.
"""

from collections.abc import Callable, Sequence
from io import StringIO
from typing import Any, NamedTuple

import numpy as np

from scenarios.calibration.evidence import Evidence, Floats, Inputs
from scenarios.calibration.misfit import Means, means, vector
from scenarios.calibration.quantities import ALONG, QUANTITIES, check
from scenarios.calibration.retrace import Felt, retrace
from scenarios.calibration.torque_meter import SCALE_SD

STEP = 0.01
"""Of a parameter's scale: larger than what the chatter of sliding tires does to a difference."""
FINAL_STEP = 0.02
ITERATIONS = 12
DRAWS = 12
"""Drives with other noise on what the actuators are said to have done."""
STUDENT = 2.179
"""97.5 % of Student's t with as many degrees of freedom as DRAWS."""
NORMAL = 1.96
Watch = Callable[[int], None]
"""Is shown how many drives have been retraced."""


class Found(NamedTuple):
    """One parameter."""

    name: str
    value: float
    half_width: float
    """Of the 95 % confidence interval."""


class Fit(NamedTuple):
    """What a tape says of the vehicle."""

    found: tuple[Found, ...]
    """What was asked for, then what was fitted along."""
    compared: dict[str, Means]
    before: Felt
    """What the sensors should have felt with the model's own values ..."""
    after: Felt
    """... and with those found."""
    misfit: tuple[float, float]
    """Mean square of the differences in units of their sigma, before and after."""
    drives: int


def fit(evidence: Evidence, names: Sequence[str], watch: Watch = lambda _: None) -> Fit:
    """Fit the parameters `names` of `QUANTITIES`.

    Raises:
        ValueError: an unknown name.
        ModuleNotFoundError: `mujoco[sysid]` is not installed.
    """
    check(names, QUANTITIES)
    problem = _Problem(evidence, tuple(dict.fromkeys((*names, *ALONG))), watch)
    start = np.array([QUANTITIES[n].model for n in problem.names]) / problem.scale
    before = problem.felt(start)
    best = _optimize(problem, start)
    after = problem.felt(best)
    half_width = _half_widths(problem, best, vector(problem.compared, after))
    found = zip(problem.names, best * problem.scale, half_width * problem.scale, strict=True)
    return Fit(
        tuple(Found(name, float(value), float(width)) for name, value, width in found),
        problem.compared, before, after,
        (_misfit(problem, before), _misfit(problem, after)), problem.drives,
    )  # fmt: skip


def expected_drives(names: Sequence[str]) -> int:
    """About how many drives a fit retraces: four iterations, and what the intervals want."""
    n = len({*names, *ALONG})
    return 4 * (n + 2) + 2 * n + DRAWS


class _Problem:
    """A tape, and what is varied; counts the drives."""

    def __init__(self, evidence: Evidence, names: tuple[str, ...], watch: Watch) -> None:
        self.evidence, self.names = evidence, names
        self.compared = means(evidence)
        self.scale = np.array([QUANTITIES[n].scale for n in names])
        self.drives = 0
        self._watch = watch

    def felt(self, x: Floats, inputs: Inputs | None = None) -> Felt:
        """What the sensors should have felt; x is in units of `scale`."""
        values = dict(zip(self.names, (x * self.scale).tolist(), strict=True))
        self.drives += 1
        self._watch(self.drives)
        return retrace(self.evidence._replace(inputs=inputs or self.evidence.inputs), values)

    def residual(self, x: Floats, inputs: Inputs | None = None) -> Floats:
        """The differences, shape (n,)."""
        return vector(self.compared, self.felt(x, inputs))


def _optimize(problem: _Problem, start: Floats) -> Floats:
    """Gauss-Newton, regularized where a step fails, within bounds."""
    from mujoco import sysid

    parameters = sysid.ParameterDict()
    for name, x, scale in zip(problem.names, start, problem.scale, strict=True):
        q = QUANTITIES[name]
        parameters.add(sysid.Parameter(name, x, q.least / scale, q.most / scale))

    def residuals(x: Floats, _: Any) -> tuple[list[Floats], None, None]:
        columns = [problem.residual(column) for column in x.reshape(len(x), -1).T]
        return [np.stack(columns, axis=1)], None, None

    _, result = sysid.optimize(
        parameters, residuals, optimizer="mujoco", verbose=False, output=StringIO(),
        eps=STEP, xtol=1e-3, gtol=1e-3, max_iters=ITERATIONS,
        mu_min=1e4, mu_factor=10.0, mu_max=1e8,  # J'J is some 1e7: a failed step is shortened soon
    )  # fmt: skip
    return np.asarray(result.x).ravel()


def _half_widths(problem: _Problem, best: Floats, residual: Floats) -> Floats:
    """Of the 95 % confidence intervals: the sensors' noise, that of what was recorded of the
    actuators, and the scale of the torque meter."""
    from mujoco import sysid

    jacobian = _jacobian(problem, best)
    covariance, _ = sysid.calculate_intervals([residual], jacobian)

    def moved(inputs: Inputs) -> Floats:
        """How far the result would move, had the actuators' records been these."""
        change = problem.residual(best, inputs) - residual
        return np.asarray(np.linalg.lstsq(jacobian, change, rcond=None)[0], np.float64)

    recorded = problem.evidence.inputs
    by_scale = moved(recorded._replace(torque_n_m=(1.0 + SCALE_SD) * recorded.torque_n_m))
    by_noise = np.array([moved(_noisy(problem.evidence, draw)) for draw in range(DRAWS)])
    normal = np.diag(covariance) + by_scale**2
    return np.sqrt(NORMAL**2 * normal + STUDENT**2 * (by_noise**2).mean(axis=0))


def _jacobian(problem: _Problem, best: Floats) -> Floats:
    """By central differences: more exact than the optimizer's own."""
    moves = FINAL_STEP * np.eye(len(best))
    columns = [problem.residual(best + move) - problem.residual(best - move) for move in moves]
    return np.stack(columns, axis=1) / (2.0 * FINAL_STEP)


def _noisy(evidence: Evidence, draw: int) -> Inputs:
    """What was recorded of the actuators, with as much noise again."""
    rng = np.random.default_rng(draw)
    pairs = zip(evidence.inputs, evidence.input_sd, strict=True)
    return Inputs(*(x + sd * rng.standard_normal(len(x)) for x, sd in pairs))


def _misfit(problem: _Problem, felt: Felt) -> float:
    return float((vector(problem.compared, felt) ** 2).mean())
