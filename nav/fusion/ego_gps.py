"""What a GPS fix does to the filter: where it starts, and its corrections by position and velocity.

A fix tells of the antenna, some time ago. `Past` is the vehicle at the fix's own time.
"""

import math
from typing import NamedTuple

import numpy as np

from nav.fusion.ego_filter import (
    COMPASS_BIAS,
    GPS_X,
    GPS_Y,
    HEADING,
    SIZE,
    SPEED,
    Filter,
    X,
    Y,
    row,
)
from nav.fusion.ego_kinematics import Attitude, level, rocking
from nav.fusion.ego_start import FirstHeading
from nav.messages import GpsFix
from nav.parameters.ego_state import EgoParameters

Offset = tuple[float, float, float]
COURSE, AHEAD = row((HEADING, 1.0)), row((SPEED, 1.0))
"""What a fix's velocity measures."""
UNKNOWN_SPEED_MPS = 3.0
"""Standard deviation of the speed before the first measurement."""


class Past(NamedTuple):
    """The vehicle at a fix's time: route frame N, [m], [rad], [m/s]."""

    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    """Horizontal."""
    attitude: Attitude
    age_s: float


def begin(
    kalman: Filter,
    antenna_m: tuple[float, float],
    sd_m: float,
    first: FirstHeading,
    antenna_level_m: tuple[float, float],
) -> None:
    """Set state and covariance from the first position of the antenna and the first heading."""
    p = kalman.parameters
    c, s = math.cos(first.heading_rad), math.sin(first.heading_rad)
    forward, left = antenna_level_m
    x, y = c * forward - s * left, s * forward + c * left
    kalman.state[:3] = antenna_m[0] - x, antenna_m[1] - y, first.heading_rad
    white = _white_variance(p, sd_m)
    independent = np.diag([
        white, white, first.variance, UNKNOWN_SPEED_MPS**2, p.motion.gyro_bias_start_radps**2,
        p.compass.bias_start_rad**2, p.wheels.scale_start**2, 1.0, 1.0,
    ])  # fmt: skip
    J = np.eye(SIZE)  # how these errors enter the state
    J[X, GPS_X] = J[Y, GPS_Y] = -sd_m
    J[HEADING, COMPASS_BIAS] = -1.0 if first.compass else 0.0
    J[X], J[Y] = J[X] + y * J[HEADING], J[Y] - x * J[HEADING]
    kalman.covariance = J @ independent @ J.T


def is_another_offset(p: EgoParameters, fix: GpsFix, before: GpsFix) -> bool:
    """Whether the receiver's slow offset is a new one: after a gap, or a step in what it states."""
    ratio = fix.sd_m / max(before.sd_m, 1e-3)
    gap_s = (fix.time_ns - before.time_ns) * 1e-9
    steady = 1.0 / p.gps.redraw_ratio < ratio < p.gps.redraw_ratio
    return gap_s > p.gps.redraw_s or not steady


def correct_position(
    kalman: Filter, measured_m: tuple[float, float], fix: GpsFix, past: Past, mount: Offset
) -> None:
    """Take the antenna's position (x, y) in frame N, [m]."""
    forward, left = level(mount, past.attitude)
    c, s = math.cos(past.heading_rad), math.sin(past.heading_rad)
    x, y = past.x_m + c * forward - s * left, past.y_m + s * forward + c * left
    x0, y0, *_ = kalman.state.tolist()
    row_x = row((X, 1.0), (HEADING, y0 - y), (SPEED, -past.age_s * c), (GPS_X, fix.sd_m))
    row_y = row((Y, 1.0), (HEADING, x - x0), (SPEED, -past.age_s * s), (GPS_Y, fix.sd_m))
    dx = measured_m[0] - x - fix.sd_m * float(kalman.state[GPS_X])
    dy = measured_m[1] - y - fix.sd_m * float(kalman.state[GPS_Y])
    variance = _white_variance(kalman.parameters, fix.sd_m)
    fits = kalman.fits(row_x, dx, variance) and kalman.fits(row_y, dy, variance)
    if kalman.admit("gps position", fix.time_ns, fits):
        if not fits:
            kalman.doubt(X, dx)
            kalman.doubt(Y, dy)
        moved = kalman.update(row_x, dx, variance)
        kalman.update(row_y, dy - row_y.along(moved), variance)


def correct_velocity(kalman: Filter, fix: GpsFix, past: Past, mount: Offset) -> None:
    """Take the antenna's velocity: its course against the heading, then its size ahead."""
    p, (east, north, _) = kalman.parameters.gps, fix.velocity_mps.tolist()
    c, s = math.cos(past.heading_rad), math.sin(past.heading_rad)
    rock_ahead, rock_left = rocking(mount, past.attitude)
    ahead, left = c * east + s * north - rock_ahead, c * north - s * east - rock_left
    tilt = mount[2] * math.hypot(*past.attitude.rate_radps[:2]) * p.rock_share
    variance = p.velocity_sd_mps**2 + tilt * tilt
    speed = math.hypot(ahead, left)
    if min(speed, abs(past.speed_mps)) > p.course_mps:
        sign = math.copysign(1.0, past.speed_mps)
        course = math.atan2(sign * left, sign * ahead)
        spread = variance / speed**2 + p.sideslip_rad**2
        kalman.correct("gps course", fix.time_ns, COURSE, course, spread)
    kalman.correct("gps speed", fix.time_ns, AHEAD, ahead - past.speed_mps, variance)


def _white_variance(p: EgoParameters, sd_m: float) -> float:
    return p.gps.white_m**2 + (p.gps.white_share * sd_m) ** 2
