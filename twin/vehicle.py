"""The Ranger in the compiled model: names, and the geometry of its steering.

Numbers with unit, source and grade: models/README.md.
"""

from math import atan, tan

import mujoco
import numpy as np
from numpy.typing import NDArray

AXLES = ("front", "middle", "rear")
SIDES = ("left", "right")
WHEELS = tuple(f"{axle}_{side}" for axle in AXLES for side in SIDES)
"""The order of every array with one value a wheel."""

WHEEL_RADIUS_M = 0.3175
TRACK_M = 1.24
PIVOT_M = 2.29
"""Front axle to the line about which the vehicle turns (published: the manual's wheelbase)."""

STEERING_LIMIT_RAD = 0.576
LINKAGE_RATIO = 0.485
LINKAGE_PROGRESSION_PER_RAD = 0.30
"""Estimated: fitted so that the twin turns as the measured vehicle did at 2 m/s, see `linkage`."""


def linkage(steering_rad: float) -> float:
    """Mean angle of the front wheels [rad] for a position of the steering [rad].

    The measured turning circle (8.174 k - 13.82 k^2 of full steering) is nearly half of what
    Ackermann geometry gives, and progressive. The scrubbing of three axles is the smaller part of
    it; where the rest sits is unknown, so it is put here.
    """
    return steering_rad * (LINKAGE_RATIO + LINKAGE_PROGRESSION_PER_RAD * abs(steering_rad))


def ackermann(mean_rad: float) -> tuple[float, float]:
    """Angles of the left and right front wheels [rad] around one centre of turn."""
    slope = tan(mean_rad)
    half = 0.5 * TRACK_M / PIVOT_M * slope
    return atan(slope / (1.0 - half)), atan(slope / (1.0 + half))


TIRE_STIFFNESS_PER_S2 = 10_000.0
TIRE_DAMPING_PER_S = 200.0
"""Contact of the tire in MuJoCo's direct form: 100 rad/s, damping ratio 1."""
STICKING_RATIO = 0.0025
"""MuJoCo's regularization R / A = (1 - d) / d of a standing tire: it holds on a slope."""
STICKING_MPS = 0.0156
"""Speed below which the tire sticks; above it R grows with speed, see `tire_contact`."""
SOFTEST = 360.0
"""R grows no further than this many times, at 5.6 m/s: softer tires are unstable at speed."""


def tire_contact(speed_mps: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """`solref` and first two values of `solimp` of a tire that rolls at `speed_mps`.

    MuJoCo's friction below its limit is viscous: force = b / R x slip speed. With R in proportion
    to the speed of travel that is a tire's law, force = stiffness x slip angle. With three axles it
    matters: rigid friction makes the tandem scrub at its limit in any turn. The model's `impratio`
    of 0.2 gives friction five times the R of the normal force, so that the tire does not sink.
    """
    softness = min(max(1.0, speed_mps / STICKING_MPS), SOFTEST)
    d = 1.0 / (1.0 + STICKING_RATIO * softness)
    # MuJoCo divides these by d squared and d, which would undo what R shall do.
    return (-TIRE_STIFFNESS_PER_S2 * d * d, -TIRE_DAMPING_PER_S * d), (d, d)


def actuators(model: mujoco.MjModel) -> slice:
    """Angles of the front wheels, left and right [rad], then drive torques of WHEELS [N m].

    Raises:
        ValueError: they do not stand in this order.
    """
    names = [f"front_{s}_steer" for s in SIDES] + [f"{w}_drive" for w in WHEELS]
    first = model.actuator(names[0]).id
    if [model.actuator(name).id for name in names] != list(range(first, first + len(names))):
        raise ValueError(f"actuators out of order: expected {', '.join(names)} in a row")
    return slice(first, first + len(names))


def tire_geoms(model: mujoco.MjModel) -> NDArray[np.int64]:
    """Ids of the tires of WHEELS."""
    return np.array([model.geom(f"{w}_tire").id for w in WHEELS])
