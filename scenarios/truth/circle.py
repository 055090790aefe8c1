"""Turning circles: the measured one, and why a Ranger turns as wide as it does."""

import numpy as np

from scenarios.truth.check import Check, Curve, Floats, Range
from scenarios.truth.rig import Rig, plane
from twin.vehicle import STEERING_LIMIT_RAD, WHEELS

FRACTIONS = np.array([0.611, 0.667, 0.722, 0.778, 0.833, 0.861, 0.889, 0.917, 0.944, 0.972])
"""Of full steering: the range of the measurement."""
WALK_MPS = 2.0
"""At what speed the circles were driven is not known."""
SOURCE = "fit to the measured circle of another Ranger 6x6 (Overbot): 8.174 k - 13.82 k^2"


def measured_radius_m(fraction: Floats) -> Floats:
    """Radius [m] of the measured vehicle at fractions (n,) of full steering."""
    k = (8.174 - np.sqrt(8.174**2 - 4.0 * 13.82 * fraction)) / (2.0 * 13.82)
    return 1.0 / k


def radius_m(rig: Rig, steering_rad: float, speed_mps: float = WALK_MPS) -> float:
    """Of the circle in which the twin settles, [m]."""
    rig.cruise(7.0, speed_mps, steering_rad)
    return float(np.mean(rig.of("speed_mps", 1.0)) / np.mean(rig.of("yaw_rate_radps", 1.0)))


def turning_circle() -> Check:
    """The circle of the reference point at ten steering angles."""
    true = measured_radius_m(FRACTIONS)
    twin = np.array([radius_m(Rig(plane(0.7)), f * STEERING_LIMIT_RAD) for f in FRACTIONS])
    off = twin / true - 1.0
    worst = float(off[np.argmax(np.abs(off))])
    lines = {"measured (fit)": true, "twin": twin}
    return Check(
        title="Turning circle at ten steering angles, 2 m/s: largest difference of the radius",
        unit="%", twin=100.0 * worst, allowed=Range(-3.0, 3.0), grade="measured", source=SOURCE,
        remark="The ratio of the linkage is fitted to it, with two parameters.",
        curve=Curve(FRACTIONS, "fraction of full steering", "radius [m]", lines, points=True),
    )  # fmt: skip


def without_axle(axle: str) -> float:
    """Radius [m] of full steering where the tires of an axle have no grip."""
    model = plane(0.7)
    ground = model.geom("ground").id
    for wheel in WHEELS:
        if wheel.startswith(axle):  # the tire's friction, low as it is, must rule: raise priority
            tire = model.geom(f"{wheel}_tire").id
            model.geom_priority[tire] = model.geom_priority[ground] + 1
            model.geom_friction[tire, 0] = 1e-4
    return radius_m(Rig(model), STEERING_LIMIT_RAD)


def middle_axle() -> Check:
    """The reason has to be the axles: without the middle one's grip the circle is another."""
    whole = radius_m(Rig(plane(0.7)), STEERING_LIMIT_RAD)
    middle, rear = without_axle("middle"), without_axle("rear")
    lines = {"radius": np.array([whole, middle, rear])}
    return Check(
        title="Full steering without grip on the middle axle: change of the radius",
        unit="%", twin=100.0 * (middle / whole - 1.0), allowed=Range(-60.0, -0.5),
        grade="estimated",
        source="three axles scrub; how much of the circle they explain is not published",
        remark=f"Without the rear axle's grip it changes by {100.0 * (rear / whole - 1.0):.0f} %. "
        "The axles explain the smaller part of the wide circle; the rest is put into the linkage.",
        curve=Curve(np.arange(3.0), "all axles, no middle, no rear", "radius [m]", lines, True),
    )  # fmt: skip
