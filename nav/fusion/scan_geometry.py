"""From ranges of a scanner to points in a level frame: only the measured attitude enters.

The level frame has the axes of N and its height zero at the reference point, so a point is
(east, north, height above the ground under the middle of the rear axles).
"""

from dataclasses import dataclass
from math import cos, sin
from typing import NamedTuple

import numpy as np

from nav.messages import LIDAR_COUNT_M, LIDAR_NO_RETURN_COUNT, Floats
from nav.parameters.vehicle import Lidar, LidarMount, Outline

NO_RETURN_M = (LIDAR_NO_RETURN_COUNT - 0.5) * LIDAR_COUNT_M
"""Ranges from here on say that nothing came back."""


class Pose(NamedTuple):
    """Where the vehicle was at a scan's time: route frame N, [m], and angles, [rad]."""

    x_m: float
    y_m: float
    heading_rad: float
    roll_rad: float
    """Positive with the left side up."""
    pitch_rad: float
    """Positive with the nose down."""


@dataclass(frozen=True, eq=False)
class ScanGeometry:
    """The fan of one mounted scanner in the vehicle frame."""

    position_m: Floats
    """Shape (3,)."""
    axes: Floats
    """Shape (3, 2): the fan's own forward and left direction; beam a is axes @ (cos a, sin a)."""
    direction: Floats
    """Shape (3, count), unit vectors."""
    exit_m: Floats
    """Shape (count,): where each beam leaves the vehicle's own outline, [m]."""
    first_rad: float
    step_rad: float


class Placed(NamedTuple):
    """Where the scanner stands in the level frame, and how it is turned."""

    origin_m: Floats
    """Shape (3,)."""
    turn: Floats
    """Shape (3, 3), from the vehicle frame: beams are turn @ geometry.direction."""


def rotation(roll_rad: float, pitch_rad: float, yaw_rad: float) -> Floats:
    """Rz(yaw) Ry(pitch) Rx(roll), shape (3, 3): from the rotated frame to the outer one."""
    cr, sr = cos(roll_rad), sin(roll_rad)
    cp, sp = cos(pitch_rad), sin(pitch_rad)
    cy, sy = cos(yaw_rad), sin(yaw_rad)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def scan_geometry(mount: LidarMount, lidar: Lidar, outline: Outline) -> ScanGeometry:
    """Unit vectors of all beams of one scanner, and where they leave the vehicle's outline."""
    axes = np.ascontiguousarray(rotation(mount.roll_rad, mount.pitch_rad, mount.yaw_rad)[:, :2])
    angle = lidar.first_rad + lidar.step_rad * np.arange(lidar.count)
    direction = axes @ np.stack([np.cos(angle), np.sin(angle)])
    position = np.array(mount.position_m)
    return ScanGeometry(
        position_m=position,
        axes=axes,
        direction=direction,
        exit_m=_exit_m(position, direction, outline),
        first_rad=lidar.first_rad,
        step_rad=lidar.step_rad,
    )


def _exit_m(position: Floats, direction: Floats, outline: Outline) -> Floats:
    """Distance at which beams from inside the outline's rectangle leave it; 0 from outside."""
    low = np.array([outline.rear_m, -outline.half_width_m])
    high = np.array([outline.front_m, outline.half_width_m])
    place, ahead = position[:2], direction[:2].T
    if np.any(place < low) or np.any(place > high):
        return np.zeros(len(ahead))
    wall = np.where(ahead > 0, high, low) - place
    along = np.where(np.abs(ahead) < 1e-9, 1e-9, np.abs(ahead))
    return (np.abs(wall) / along).min(axis=1)


def placed(geometry: ScanGeometry, pose: Pose) -> Placed:
    """The scanner in the level frame, for the measured attitude."""
    turn = rotation(pose.roll_rad, pose.pitch_rad, pose.heading_rad)
    origin = turn @ geometry.position_m
    origin[0] += pose.x_m
    origin[1] += pose.y_m
    return Placed(origin, turn)


def level_points(
    geometry: ScanGeometry, scanner: Placed, range_m: Floats, max_range_m: float
) -> Floats:
    """Returns of one scan in the level frame, without our own outline.

    Args:
        geometry: the scanner.
        scanner: as `placed` at the scan's time.
        range_m: shape (count,), [m].
        max_range_m: farther returns are left out, as are beams without one.

    Returns:
        Points, shape (3, m), [m].
    """
    far = min(max_range_m, NO_RETURN_M)
    hit = np.flatnonzero((range_m > geometry.exit_m) & (range_m < far))
    direction = scanner.turn @ geometry.direction.take(hit, axis=1)
    return direction * range_m.take(hit) + scanner.origin_m[:, None]
