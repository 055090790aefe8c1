"""Beams in the vehicle and level frames, against angles worked out by hand."""

from math import atan2, cos, pi, radians, sin, tan

import numpy as np
import pytest

from nav.fusion.scan_geometry import (
    Pose,
    ScanGeometry,
    Scans,
    level_points,
    placed,
    returns,
    rotation,
    scan_geometry,
)
from nav.parameters.vehicle import Lidar, LidarMount, Outline

LIDAR = Lidar(-pi / 2, pi / 360, 361, 81.92)
OUTLINE = Outline(2.10, -0.95, 0.762)
AHEAD = 180  # index of the middle beam
LEVEL = Pose(0.0, 0.0, 0.0, 0.0, 0.0)


def one_return(index: int, range_m: float) -> np.ndarray:
    ranges = np.full(361, 81.92)
    ranges[index] = range_m
    return ranges


def point(mount: LidarMount, pose: Pose, index: int, range_m: float) -> np.ndarray:
    geometry = scan_geometry(mount, LIDAR, OUTLINE)
    found = found_by(geometry, pose, one_return(index, range_m), 40.0)
    assert found.shape == (3, 1)
    return found[:, 0]


def found_by(geometry: ScanGeometry, pose: Pose, range_m: np.ndarray, max_range_m: float):
    scans = Scans([geometry], placed(geometry, pose)[None], range_m[None])
    return level_points(scans, returns(scans, max_range_m))


def test_rotation_signs_follow_the_contract() -> None:
    forward, left = np.eye(3)[0], np.eye(3)[1]
    assert (rotation(0.1, 0.0, 0.0) @ left)[2] == pytest.approx(sin(0.1))  # left side up
    assert (rotation(0.0, 0.1, 0.0) @ forward)[2] == pytest.approx(-sin(0.1))  # nose down
    assert (rotation(0.0, 0.0, 0.1) @ forward)[1] == pytest.approx(sin(0.1))  # counter-clockwise


def test_rotation_is_orthonormal() -> None:
    turn = rotation(0.3, -0.2, 2.0)
    assert np.allclose(turn @ turn.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(turn) == pytest.approx(1.0)


def test_beams_are_unit_vectors_from_right_to_left() -> None:
    geometry = scan_geometry(LidarMount((2.05, 0, 0.55), 0.0, 0.0), LIDAR, OUTLINE)
    direction = geometry.mount[:, :2] @ geometry.ray
    assert np.allclose(np.linalg.norm(direction, axis=0), 1.0)
    assert np.allclose(direction[:, [0, AHEAD, 360]].T, [[0, -1, 0], [1, 0, 0], [0, 1, 0]])


def test_a_tilted_scanner_meets_flat_ground_where_it_should() -> None:
    mount = LidarMount((1.30, 0.0, 1.90), 0.0, radians(7))
    found = point(mount, LEVEL, AHEAD, 1.90 / sin(radians(7)))
    assert found == pytest.approx([1.30 + 1.90 / tan(radians(7)), 0.0, 0.0], abs=1e-9)


def test_measured_pitch_lowers_the_point() -> None:
    mount = LidarMount((2.0, 0.0, 0.5), 0.0, 0.0)
    found = point(mount, Pose(0, 0, 0, 0, 0.02), AHEAD, 10.0)
    assert found[2] == pytest.approx(0.5 * cos(0.02) - 12.0 * sin(0.02))


def test_heading_and_position_carry_the_point() -> None:
    mount = LidarMount((2.0, 0.5, 0.5), 0.0, 0.0)
    found = point(mount, Pose(100.0, -50.0, pi / 2, 0, 0), AHEAD, 10.0)
    assert found == pytest.approx([100.0 - 0.5, -50.0 + 12.0, 0.5])


def test_mount_yaw_turns_the_fan() -> None:
    x, y, _ = point(LidarMount((0.0, 2.0, 0.5), 0.8, 0.0), LEVEL, AHEAD, 10.0)
    assert atan2(y - 2.0, x) == pytest.approx(0.8)


@pytest.mark.parametrize("range_m", [81.92, 41.0])
def test_beams_without_return_and_far_ones_are_left_out(range_m: float) -> None:
    geometry = scan_geometry(LidarMount((2.05, 0, 0.55), 0.0, 0.0), LIDAR, OUTLINE)
    found = found_by(geometry, LEVEL, one_return(AHEAD, range_m), 40.0)
    assert found.shape == (3, 0)


def test_no_return_is_left_out_however_far_one_looks() -> None:
    geometry = scan_geometry(LidarMount((2.05, 0, 0.55), 0.0, 0.0), LIDAR, OUTLINE)
    found = found_by(geometry, LEVEL, np.full(361, 81.92), 100.0)
    assert found.shape == (3, 0)


def test_returns_from_the_own_outline_are_left_out() -> None:
    geometry = scan_geometry(LidarMount((2.05, 0, 0.55), 0.0, 0.0), LIDAR, OUTLINE)
    assert geometry.exit_m[[0, AHEAD]] == pytest.approx([0.762, 0.05])
    assert found_by(geometry, LEVEL, one_return(0, 0.75), 40.0).shape == (3, 0)
    assert found_by(geometry, LEVEL, one_return(0, 0.78), 40.0).shape == (3, 1)
