"""Measured and predicted curves, before and after the fit."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ion.style import DECIDED, INK, QUIET, REAL, new_figure, plain
from scenarios.calibration.fit import Fit
from scenarios.calibration.misfit import Floats, differences
from scenarios.calibration.retrace import Felt
from twin.vehicle import WHEEL_RADIUS_M


class Curve(NamedTuple):
    """One channel of one kind of sensor."""

    title: str
    kind: str
    channel: int
    times: float = 1.0
    """What makes it a prediction of what is measured."""


CURVES = (
    Curve("Yaw rate [rad/s]", "imu", 2),
    Curve("Lateral acceleration [m/s²]", "imu", 4),
    Curve("Acceleration ahead [m/s²]", "imu", 3),
    Curve("Roll rate [rad/s]", "imu", 0),
    Curve("Front left wheel [m/s]", "wheels", 0, WHEEL_RADIUS_M),
    Curve("GPS speed [m/s]", "gps", 0),
)
BEFORE, AFTER = ("as the model has it", DECIDED), ("as found", REAL)


def picture(fit: Fit) -> Figure:
    """On the left the curves, on the right their differences in units of the noise."""
    figure = new_figure(13.0, 13.0)
    axes = figure.subplots(len(CURVES), 2, sharex=True, width_ratios=(2, 1))
    for curve, (over, beside) in zip(CURVES, axes, strict=True):
        _curves(over, fit, curve)
        _differences(beside, fit, curve)
    axes[0, 0].legend(frameon=False, fontsize=8.5, loc="upper left")
    axes[0, 1].set_title("Measured less predicted, in sigma", loc="left", fontsize=9, color=QUIET)
    for ax in axes[-1]:
        ax.set_xlabel("time [s]", color=INK, fontsize=8.5)
    return figure


def _curves(ax: Axes, fit: Fit, curve: Curve) -> None:
    plain(ax, curve.title)
    means = fit.compared[curve.kind]
    measured = np.where(means.used, means.value, np.nan)[:, curve.channel]
    ax.plot(means.time_s, measured, color=INK, linewidth=2.2, alpha=0.35, label="measured")
    for (label, color), felt in ((BEFORE, fit.before), (AFTER, fit.after)):
        predicted = curve.times * means.of(getattr(felt, curve.kind))[:, curve.channel]
        ax.plot(means.time_s, predicted, color=color, linewidth=0.9, label=label)


def _differences(ax: Axes, fit: Fit, curve: Curve) -> None:
    plain(ax)
    for (_, color), felt in ((BEFORE, fit.before), (AFTER, fit.after)):
        ax.plot(fit.compared[curve.kind].time_s, _of(fit, felt, curve), color=color, linewidth=0.7)


def _of(fit: Fit, felt: Felt, curve: Curve) -> Floats:
    return differences(fit.compared, felt)[curve.kind][:, curve.channel]
