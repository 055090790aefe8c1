"""From ranges of a scanner to points in a level frame: only the measured attitude enters.

The level frame has the axes of N and its height zero at the reference point, so a point is
(east, north, height above the ground under the middle of the rear axles).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from nav.fusion.lattice import Ints
from nav.messages import LIDAR_NO_RETURN_M, Floats, LidarScan
from nav.parameters.vehicle import Lidar, LidarMount, Outline


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
    """One mounted scanner in the vehicle frame."""

    mount: Floats
    """Shape (3, 3): columns are the fan's forward and left direction and its place, [m]."""
    ray: Floats
    """Shape (2, count): how far each beam goes forward and left in its fan, for each metre."""
    exit_m: Floats
    """Shape (count,): where each beam leaves the vehicle's own outline, [m]."""
    first_rad: float
    step_rad: float
    sweep_s: float
    """From the first beam to the last, whose time the scan bears."""
    age: Floats
    """Shape (count,): how old each beam is by then, as a share of the sweep."""


class Sweep(NamedTuple):
    """A scan, and where the vehicle was meanwhile."""

    scan: LidarScan
    pose: Pose
    """At its last beam."""
    began: Pose | None = None
    """At its first beam; None: it was quick, or the vehicle stood."""


class Scans(NamedTuple):
    """k scans of scanners of one kind at their places in the level frame."""

    geometry: Sequence[ScanGeometry]
    frame: Floats
    """Shape (k, 3, 3): as `placed`, at each scan's time."""
    range_m: Floats
    """Shape (k, count)."""
    moved: Floats | None = None
    """Shape (k, 3, 3): how much `frame` has changed since the first beam."""

    def only(self, which: list[int]) -> "Scans":
        """Some of them, without how they moved."""
        chosen = [self.geometry[k] for k in which]
        return Scans(chosen, self.frame[which], self.range_m[which])


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
    axes = rotation(mount.roll_rad, mount.pitch_rad, mount.yaw_rad)[:, :2]
    angle = lidar.first_rad + lidar.step_rad * np.arange(lidar.count)
    ray = np.stack([np.cos(angle), np.sin(angle)])
    sweep_s, age = _sweep(lidar)
    position = np.array(mount.position_m)
    return ScanGeometry(
        mount=np.column_stack([axes, position]),
        ray=ray,
        exit_m=_exit_m(position, axes @ ray, outline),
        first_rad=lidar.first_rad,
        step_rad=lidar.step_rad,
        sweep_s=sweep_s,
        age=age,
    )


def _sweep(lidar: Lidar) -> tuple[float, Floats]:
    """From the first beam to the last [s], and the ages of all beams (count,) as shares of it."""
    beam = np.arange(lidar.count)
    turns = beam * (lidar.step_rad / (2.0 * pi)) + beam % 2
    return float(turns.max()) * lidar.turn_s, 1.0 - turns / turns.max()


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


def placed(geometry: ScanGeometry, pose: Pose) -> Floats:
    """The scanner's `mount` in the level frame, for the measured attitude, shape (3, 3)."""
    frame = rotation(pose.roll_rad, pose.pitch_rad, pose.heading_rad) @ geometry.mount
    frame[0, 2] += pose.x_m
    frame[1, 2] += pose.y_m
    return frame


def returns(scans: Scans, max_range_m: float) -> Ints:
    """Flat indices, scan after scan, of beams that came back and not from our own outline.

    Args:
        scans: k of them.
        max_range_m: farther returns are left out, as are beams without one.
    """
    exit_m = np.array([geometry.exit_m for geometry in scans.geometry])
    far = min(max_range_m, LIDAR_NO_RETURN_M)
    return np.flatnonzero((scans.range_m > exit_m) & (scans.range_m < far))


def level_points(scans: Scans, beam: Ints) -> Floats:
    """Where some beams end, in the level frame: shape (3, m), [m]; `beam` as from `returns`."""
    way = scans.range_m[:, None] * scans.geometry[0].ray  # (k, 2, count)
    points = scans.frame[:, :, :2] @ way + scans.frame[:, :, 2:]  # (k, 3, count)
    if scans.moved is not None:  # a turn of some hundredths between two frames is linear
        since = scans.moved[:, :, :2] @ way + scans.moved[:, :, 2:]
        points -= scans.geometry[0].age * since
    return points.swapaxes(0, 1).reshape(3, -1).take(beam, axis=1)
