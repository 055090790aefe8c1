"""The ground profile on points made by hand, without scanners."""

from math import atan
from pathlib import Path

import numpy as np
import pytest

from nav.fusion.ground_profile import UNKNOWN_M, GroundProfile
from nav.fusion.scan_geometry import Pose
from nav.parameters.loader import from_toml
from nav.parameters.obstacle_map import ObstacleMapParameters

FILE = Path(__file__).parents[1] / "nav" / "parameters" / "obstacle_map.toml"
PARAMETERS = from_toml(ObstacleMapParameters, FILE.read_text(), "obstacle_map.toml").ground
WHEELS = np.array([(x, y) for x in (0.0, 1.7) for y in (-0.62, 0.62)])
START = Pose(0.0, 0.0, 0.0, 0.0, 0.0)


@pytest.fixture
def profile() -> GroundProfile:
    ground = GroundProfile(PARAMETERS, 64.0, WHEELS)
    ground.recentre(0.0, 0.0)
    return ground


def teach(profile: GroundProfile, slope: float, reach_m: float = 16.0, pose: Pose = START) -> None:
    """Steep beams from `pose` find ground of a slope along x, level with the vehicle."""
    x, y = np.meshgrid(np.arange(-4.0, reach_m, 0.25), np.arange(-10.0, 10.1, 0.25))
    points = np.stack([x.ravel() + pose.x_m, y.ravel(), slope * x.ravel()])
    index, inside = profile.lattice.index(points[0], points[1])
    profile.learn(index, points[2], inside, np.zeros_like(inside))
    profile.drive(pose)
    profile.drive(pose._replace(x_m=pose.x_m + 2.0))  # far enough to renew the bound
    profile.drive(pose)


def is_obstacle(profile: GroundProfile, x: float, y: float, z: float) -> bool:
    points = np.array([[x], [y], [z]])
    obstacle, ground, _ = profile.classify(points, np.hypot(points[0], points[1]))
    assert not (obstacle[0] and ground[0])
    return bool(obstacle[0])


@pytest.mark.parametrize(("z", "expected"), [(0.0, False), (0.2, False), (0.4, True), (1.5, True)])
def test_a_step_on_known_flat_ground(profile: GroundProfile, z: float, expected: bool) -> None:
    teach(profile, 0.0)
    assert is_obstacle(profile, 10.0, 0.0, z) is expected


def test_what_hangs_overhead_is_no_obstacle(profile: GroundProfile) -> None:
    teach(profile, 0.0)
    assert is_obstacle(profile, 10.0, 0.0, 2.3)
    assert not is_obstacle(profile, 10.0, 0.0, 2.7)


@pytest.mark.parametrize("slope", [-0.08, 0.08])
def test_a_slope_is_ground_and_a_step_on_it_is_not(profile: GroundProfile, slope: float) -> None:
    teach(profile, slope)
    assert not is_obstacle(profile, 12.0, 3.0, slope * 12.0)
    assert is_obstacle(profile, 12.0, 3.0, slope * 12.0 + 0.5)


def test_beyond_known_ground_it_may_rise_the_farther_the_more(profile: GroundProfile) -> None:
    teach(profile, 0.0)
    assert is_obstacle(profile, 19.0, 0.0, 0.6)  # 3 m on
    assert not is_obstacle(profile, 24.0, 0.0, 0.55)  # 8 m on


def test_a_bank_of_25_degrees_is_an_obstacle(profile: GroundProfile) -> None:
    teach(profile, 0.0)
    for k in range(10):  # it never gets used to it
        y = np.arange(2.05, 6.0, 0.1)
        points = np.stack([np.full_like(y, 8.0), y, (y - 2.0) * 0.47])
        obstacle, ground, index = profile.classify(points, np.hypot(points[0], points[1]))
        profile.learn(index, points[2], ground, obstacle)
        profile.drive(START._replace(x_m=0.1 * (k % 2)))
    assert np.all(obstacle[y > 3.2])
    assert not np.any(obstacle[y < 2.4])


def test_a_slow_rise_of_a_wall_in_one_cell_is_not_learned(profile: GroundProfile) -> None:
    teach(profile, 0.0)
    found = []
    for z in np.arange(0.0, 1.0, 0.02):  # a beam that creeps up a wall
        points = np.array([[10.5], [0.5], [z]])
        obstacle, ground, index = profile.classify(points, np.array([10.5]))
        profile.learn(index, points[2], ground, obstacle)
        profile.drive(START)
        found.append(bool(obstacle[0]))
    assert found[-1]
    assert not found[0]


def test_height_follows_the_measured_pitch(profile: GroundProfile) -> None:
    for x in np.arange(0.0, 20.0, 0.5):
        profile.drive(Pose(float(x), 0.0, 0.0, 0.0, -atan(0.05)))
    assert profile.vehicle_m == pytest.approx(0.05 * 19.5, abs=0.05)


def test_known_ground_under_the_wheels_draws_the_height(profile: GroundProfile) -> None:
    teach(profile, 0.0)
    profile.vehicle_m = 0.5
    for _ in range(30):
        profile.drive(START)
    assert abs(profile.vehicle_m) < 0.01


def test_scrolling_keeps_heights_in_place(profile: GroundProfile) -> None:
    teach(profile, 0.05)
    before = profile.height_m[32, 32 + 10]
    profile.recentre(6.0, 0.0)
    assert profile.height_m[32, 32 + 4] == before < UNKNOWN_M
    assert is_obstacle(profile, 10.0, 0.0, 1.5)
    profile.recentre(500.0, 500.0)
    assert np.all(profile.height_m == UNKNOWN_M)


def test_points_off_the_lattice_are_neither(profile: GroundProfile) -> None:
    points = np.array([[500.0], [0.0], [1.0]])
    obstacle, ground, _ = profile.classify(points, np.array([500.0]))
    assert not obstacle[0]
    assert not ground[0]
