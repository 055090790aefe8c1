"""Standard manoeuvres of handling: steady-state circle, step steer, double lane change."""

import itertools

import numpy as np

from scenarios.truth.check import Check, Curve, Floats, Range
from scenarios.truth.rig import TICK_S, Cruise, Moment, Rig, plane
from twin.vehicle import STEERING_LIMIT_RAD

STEER_RAD, STEADY_MPS = 0.2, np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0])
STEP_MPS, STEP_RAD = 6.0, 0.1


def steady_state_circle() -> Check:
    """ISO 4138, constant steering: how much wider the circle becomes with speed."""
    radius, sideways = np.zeros(len(STEADY_MPS)), np.zeros(len(STEADY_MPS))
    for k, speed in enumerate(STEADY_MPS):
        rig = Rig().cruise(9.0, float(speed), STEER_RAD)
        rate, now = np.mean(rig.of("yaw_rate_radps", 1.0)), np.mean(rig.of("speed_mps", 1.0))
        radius[k], sideways[k] = now / rate, now * rate
    gradient = _gradient(radius, sideways)
    return Check(
        title="Steady-state circle (ISO 4138): understeer, growth of the radius at 1 m/s^2",
        unit="%", twin=100.0 * gradient, allowed=Range(0.0, 15.0), grade="estimated",
        source="utility vehicles understeer; no figure of a Ranger 6x6 was found",
        curve=Curve(sideways, "sideways acceleration [m/s^2]", "radius [m]", {"twin": radius}),
    )  # fmt: skip


def _gradient(radius_m: Floats, sideways_mps2: Floats) -> float:
    """Share by which the radius grows for each m/s^2, below 3 m/s^2."""
    slow = sideways_mps2 < 3.0
    slope, start = np.polyfit(sideways_mps2[slow], radius_m[slow], 1)
    return float(slope / start)


def step_steer() -> Check:
    """ISO 7401: time from half of the steering's step to 90 % of the steady yaw rate."""
    rig = Rig().cruise(6.0, STEP_MPS)
    began = len(rig.moments)
    driver = Cruise(0.12 * STEP_MPS)
    for _ in range(round(5.0 / TICK_S)):
        throttle, brake = driver.pedals(STEP_MPS, rig.plant.speed_mps)
        rig.tick(STEP_RAD, throttle, brake)
    steering, rate = rig.of("steering_rad")[began:], rig.of("yaw_rate_radps")[began:]
    time_s = np.arange(len(rate), dtype=np.float64) * TICK_S
    steady = float(np.mean(rate[-50:]))
    half = time_s[np.argmax(steering > 0.5 * STEP_RAD)]
    response = time_s[np.argmax(rate > 0.9 * steady)] - half
    overshoot = float(rate.max() / steady - 1.0)
    lines = {"yaw rate [rad/s]": rate, "steering [rad]": steering}
    return Check(
        title="Step steer (ISO 7401) at 6 m/s: from half of the step to 90 % of the yaw rate",
        unit="s", twin=float(response), allowed=Range(0.05, 0.6), grade="estimated",
        source="road vehicles take 0.1 to 0.4 s; here half of the step itself takes 0.17 s",
        remark=f"Overshoot {100.0 * overshoot:.0f} %.",
        curve=Curve(time_s, "time since the command [s]", "", lines),
    )  # fmt: skip


LANES = ((0.0, 15.0, 0.0, 1.1), (45.0, 70.0, 3.5, 1.2), (95.0, 110.0, 0.0, 1.3))
"""ISO 3888-1: from x, to x, middle [m], and width as so many widths of the vehicle, with 0.25 m."""
SPEEDS_MPS = np.arange(4.0, 16.0, dtype=np.float64)
WIDTH_M = 1.52
AHEAD_S = 0.45
"""The driver knows that the steering is late."""


def lane_change() -> Check:
    """The fastest entry at which a driver who knows the path keeps the lanes."""
    room, roll = np.array([_changed(float(speed)) for speed in SPEEDS_MPS]).T
    kept = np.logical_and.accumulate(room > 0.0)
    lines = {"least room to the cones [m]": room, "largest roll [rad]": roll}
    return Check(
        title="Double lane change (ISO 3888-1): fastest entry without touching a cone",
        unit="m/s", twin=float(SPEEDS_MPS[kept].max(initial=0.0)), allowed=Range(7.0, 16.0),
        grade="estimated",
        source="no figure of a Ranger was found; cars do 22 m/s, steering of 4 s lock to lock less",
        curve=Curve(SPEEDS_MPS, "entry [m/s]", "", lines, points=True),
    )  # fmt: skip


def _changed(speed_mps: float) -> tuple[float, float]:
    """Least room between outline and cones [m], and largest roll [rad]."""
    rig = Rig(plane()).push(speed_mps).cruise(4.0, speed_mps)
    start, driver = rig.moments[-1].x_m + 5.0, Cruise(0.12 * speed_mps)
    room, rolled = np.inf, 0.0
    while rig.moments[-1].x_m < start + 112.0 and rig.time_s < 60.0:
        now = rig.moments[-1]
        steering = _steered(now, start, rig.plant.speed_mps)
        now = rig.tick(steering, *driver.pedals(speed_mps, now.speed_mps))
        rolled = max(rolled, abs(now.roll_rad))
        for low, high, middle, widths in LANES:
            if low < now.x_m - start < high:
                half = 0.5 * (widths * WIDTH_M + 0.25) - 0.5 * WIDTH_M
                room = min(room, half - abs(now.y_m - middle))
    return room, rolled


def _steered(now: Moment, start_m: float, speed_mps: float) -> float:
    """Curvature of the path where the steering will act, and back to it."""
    turned = now.heading_rad + now.yaw_rate_radps * AHEAD_S
    middle = now.heading_rad + 0.5 * now.yaw_rate_radps * AHEAD_S
    x = now.x_m - start_m + speed_mps * AHEAD_S * np.cos(middle)
    y = now.y_m + speed_mps * AHEAD_S * np.sin(middle)
    path, slope, bend = _path(float(x))
    reach = max(5.0, speed_mps)
    k = bend - (y - path) / reach**2 - 2.0 * (turned - np.arctan(slope)) / reach
    steering = STEERING_LIMIT_RAD * (8.174 * abs(k) - 13.82 * k * k) * np.sign(k)
    return float(np.clip(steering, -STEERING_LIMIT_RAD, STEERING_LIMIT_RAD))


def _path(x_m: float) -> tuple[float, float, float]:
    """y, its slope and its second derivative: from lane to lane by the quintic step."""
    for (_, begin, before, _), (end, _, after, _) in itertools.pairwise(LANES):
        if begin < x_m < end:
            u, span = (x_m - begin) / (end - begin), end - begin
            rise = after - before
            step = u**3 * (10.0 - 15.0 * u + 6.0 * u * u)
            slope = 30.0 * u * u * (1.0 - u) ** 2 / span
            bend = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / span**2
            return before + rise * step, rise * slope, rise * bend
    within_lane = [middle for low, high, middle, _ in LANES if low <= x_m <= high]
    return (within_lane[0] if within_lane else 0.0), 0.0, 0.0
