"""The obstacle map in a tiny world of its own: ground by a function, upright boxes, rays."""

import pickle
from collections.abc import Callable
from math import atan, cos, sin
from pathlib import Path

import numpy as np
import pytest

from nav.errors import NavError
from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.scan_geometry import Pose, Sweep, placed, scan_geometry
from nav.messages import LidarScan
from nav.parameters.loader import from_toml
from nav.parameters.obstacle_map import ObstacleMapParameters
from nav.parameters.vehicle import VehicleParameters

FOLDER = Path(__file__).parents[1] / "nav" / "parameters"
VEHICLE = from_toml(VehicleParameters, (FOLDER / "vehicle.toml").read_text(), "vehicle.toml")
PARAMETERS = from_toml(
    ObstacleMapParameters, (FOLDER / "obstacle_map.toml").read_text(), "obstacle_map.toml"
)
MOUNTS = VEHICLE.lidar_mounts
GEOMETRY = {n: scan_geometry(m, VEHICLE.lidar, VEHICLE.outline) for n, m in MOUNTS.items()}
Box = tuple[float, float, float, float, float]  # x0, x1, y0, y1, height
Ground = Callable[[np.ndarray], np.ndarray]


def flat(x: np.ndarray) -> np.ndarray:
    return np.zeros_like(x)


def rise(foot_m: float, slope: float = 0.08) -> Ground:
    return lambda x: np.maximum(x - foot_m, 0.0) * slope


def box_range(origin: np.ndarray, direction: np.ndarray, box: Box, z0: float) -> np.ndarray:
    low, high = np.array([box[0], box[2], z0 - 1.0]), np.array([box[1], box[3], z0 + box[4]])
    with np.errstate(divide="ignore", invalid="ignore"):
        a, b = (low - origin) / direction, (high - origin) / direction
    near, far = np.fmin(a, b).max(axis=1), np.fmax(a, b).min(axis=1)
    return np.where((near <= far) & (near > 0), near, 1e9)


def ground_range(origin: np.ndarray, direction: np.ndarray, ground: Ground) -> np.ndarray:
    r = np.arange(0.0, 60.0, 0.5)
    x = origin[0] + direction[:, :1] * r
    over = origin[2] + direction[:, 2:] * r - ground(x)
    below = over < 0
    k = np.maximum(below.argmax(axis=1), 1)
    row = np.arange(len(direction))
    before, after = over[row, k - 1], over[row, k]
    hit = r[k - 1] + 0.5 * before / np.where(below.any(axis=1), before - after, 1.0)
    return np.where(below.any(axis=1), hit, 1e9)


def scan(name: str, pose: Pose, boxes: list[Box], ground: Ground = flat, time_s: float = 0.0):
    """What scanner `name` measures from the true pose, in whole centimetres."""
    frame = placed(GEOMETRY[name], pose)
    direction = (frame[:, :2] @ GEOMETRY[name].ray).T
    origin = frame[:, 2] + np.array([0.0, 0.0, ground(np.array(pose.x_m))])
    range_m = ground_range(origin, direction, ground)
    for box in boxes:
        foot = float(ground(np.array(box[0])))
        range_m = np.minimum(range_m, box_range(origin, direction, box, foot))
    range_m = np.where(range_m < 81.0, np.rint(range_m * 100) * 0.01, 81.92)
    return LidarScan(round(time_s * 1e9), name, range_m)


def on(ground: Ground, x_m: float, y_m: float = 0.0, heading_rad: float = 0.0) -> Pose:
    """The vehicle as it stands at a place: pitched as the ground under its axles."""
    front = ground(np.array(x_m + 1.7 * cos(heading_rad)))
    return Pose(x_m, y_m, heading_rad, 0.0, -atan(float(front - ground(np.array(x_m))) / 1.7))


def tick(chart: ObstacleMap, pose: Pose, boxes: list[Box], ground: Ground = flat, **more):
    """One tick of 0.1 s: two scans of each scanner. `error` is added to the measured pose."""
    error, time_s = more.get("error", (0,) * 5), more.get("time_s", 0.0)
    said = Pose(*(a + b for a, b in zip(pose, error, strict=True)))
    names = more.get("names", MOUNTS)
    scans = [scan(n, pose, boxes, ground, time_s + t) for t in (0.0, 0.05) for n in names]
    chart.integrate([Sweep(s, said) for s in scans])


def drive(chart: ObstacleMap, boxes: list[Box], ground: Ground = flat, **more) -> int:
    """Straight along x from `start` to `stop` at 5 m/s. Returns the most cells ever occupied."""
    start, stop = more.pop("start", -10.0), more.pop("stop", 0.0)
    most = 0
    for k, x in enumerate(np.arange(start, stop + 1e-9, 0.5)):
        tick(chart, on(ground, float(x)), boxes, ground, time_s=0.1 * k, **more)
        most = max(most, len(chart.occupied().index))
    return most


@pytest.fixture
def chart() -> ObstacleMap:
    return ObstacleMap(PARAMETERS, VEHICLE)


CAR: Box = (12.0, 16.5, -0.9, 0.9, 1.5)
GATE: list[Box] = [(20.0, 20.15, y - 0.075, y + 0.075, 1.2) for y in (-1.675, 1.675)]


def test_a_car_ahead_is_seen_at_its_place(chart: ObstacleMap) -> None:
    drive(chart, [CAR])
    position = chart.occupied().position_m
    front = position[np.abs(position[:, 0] - 12.0) <= 0.2]
    assert np.ptp(front[:, 1]) == pytest.approx(1.8, abs=0.3)
    assert len(front) == len(position)


def test_a_wall_ahead_is_one_or_two_cells_thick(chart: ObstacleMap) -> None:
    drive(chart, [(14.07, 15.0, -6.0, 6.0, 2.0)])
    x, y = chart.occupied().position_m.T
    assert np.all(np.abs(x - 14.07) <= 0.3)
    assert len(np.unique(y)) >= 56


@pytest.mark.parametrize("error_deg", [-1.0, -0.5, 0.0, 0.5, 1.0])
@pytest.mark.parametrize("foot_m", [3.0, 8.0, 12.0, 20.0])
def test_a_rise_ahead_is_no_obstacle(chart: ObstacleMap, foot_m: float, error_deg: float) -> None:
    error = (0, 0, 0, 0, np.radians(error_deg))
    assert drive(chart, [], rise(foot_m), stop=25.0, error=error) == 0


@pytest.mark.parametrize("foot_m", [8.0, 12.0, 20.0])
def test_a_rise_that_is_met_without_history_is_no_obstacle(foot_m: float) -> None:
    chart = ObstacleMap(PARAMETERS, VEHICLE)
    assert drive(chart, [], rise(foot_m), start=0.0, error=(0, 0, 0, 0, 0.017)) == 0


def test_rolling_ground_is_no_obstacle(chart: ObstacleMap) -> None:
    def rolling(x: np.ndarray) -> np.ndarray:
        return 0.5 * np.sin(x * (2 * np.pi / 40))  # slopes up to 7.9 %

    assert drive(chart, [], rolling, stop=60.0, error=(0, 0, 0, 0.009, 0.009)) == 0


def test_a_car_on_a_rise_is_seen(chart: ObstacleMap) -> None:
    drive(chart, [CAR], rise(4.0), stop=5.0)
    position = chart.occupied().position_m
    assert len(position) >= 8
    assert np.all(np.abs(position[:, 0] - 12.0) <= 0.4)


def test_a_bale_lower_than_the_level_beams_stays_when_it_is_no_longer_seen(
    chart: ObstacleMap,
) -> None:
    bale = (14.0, 14.5, -0.5, 0.5, 0.45)
    drive(chart, [bale], start=-6.0, stop=10.0)
    x, y = chart.occupied().position_m.T
    assert len(x) >= 5
    assert np.all((np.abs(x - 14.0) < 0.7) & (np.abs(y) < 0.7))


def test_a_gate_is_seen_at_20_m_with_its_opening_free(chart: ObstacleMap) -> None:
    drive(chart, GATE, start=-5.0, stop=0.0)
    x, y = chart.occupied().position_m.T
    assert np.any(y > 1.5)
    assert np.any(y < -1.5)
    assert np.all((np.abs(x - 20.0) <= 0.3) & (np.abs(np.abs(y) - 1.675) <= 0.2))


def test_drift_of_the_estimate_does_not_fill_a_gate(chart: ObstacleMap) -> None:
    for k in range(60):
        drift = 0.1 * sin(0.1 * k)
        error = (drift, 0.1 * cos(0.13 * k), 0.003 * sin(0.2 * k), 0, 0)
        tick(chart, Pose(5.0 + 0.2 * k, 0, 0, 0, 0), GATE, time_s=0.1 * k, error=error)
    y = chart.occupied().position_m[:, 1]
    assert np.any(y > 1.5)
    assert np.any(y < -1.5)
    assert np.abs(y).min() >= 1.35


def test_what_is_gone_vanishes_within_a_second(chart: ObstacleMap) -> None:
    drive(chart, [CAR])
    assert len(chart.occupied().index) > 0
    for k in range(10):
        tick(chart, Pose(0, 0, 0, 0, 0), [], time_s=3.0 + 0.1 * k)
    assert len(chart.occupied().index) == 0


def test_a_level_beam_that_dips_onto_a_bale_does_not_make_it_forgotten(chart: ObstacleMap) -> None:
    bale: Box = (16.0, 16.46, -1.0, 1.0, 0.42)
    seen = drive(chart, [bale], start=-10.0, stop=3.0)
    down = 0.011  # 0.6 degrees, unnoticed, for two ticks: the bumper's beams end on the bale
    for k in range(2):
        pose = Pose(3.0 + 0.5 * k, 0.0, 0.0, 0.0, down)
        tick(chart, pose, [bale], time_s=2.7 + 0.1 * k, error=(0.0, 0.0, 0.0, 0.0, -down))
    for k, x in enumerate(np.arange(4.0, 12.0, 0.5)):
        tick(chart, on(flat, float(x)), [bale], time_s=2.9 + 0.1 * k)
    assert seen > 5
    assert len(chart.occupied().index) > 0.8 * seen


def test_a_blind_corner_persists(chart: ObstacleMap) -> None:
    beside = (1.0, 3.0, 2.0, 3.0, 1.5)
    drive(chart, [beside], start=-12.0, stop=6.0)
    before = len(chart.occupied().index)
    for k in range(50):
        tick(chart, Pose(6.0, 0, 0, 0, 0), [], time_s=5.0 + 0.1 * k)
    assert len(chart.occupied().index) == before > 5


def test_one_return_is_no_obstacle_two_are(chart: ObstacleMap) -> None:
    drive(chart, [])
    range_m = np.array(scan("lidar_bumper", Pose(0, 0, 0, 0, 0), []).range_m)
    range_m[180] = 10.0
    one = [Sweep(LidarScan(3_000_000_000, "lidar_bumper", range_m), Pose(0, 0, 0, 0, 0))]
    chart.integrate(one)
    assert len(chart.occupied().index) == 0
    chart.integrate(one)
    assert len(chart.occupied().index) == 1


def test_own_outline_is_never_occupied(chart: ObstacleMap) -> None:
    drive(chart, [(0.5, 1.5, -0.5, 0.5, 1.0)], start=-10.0, stop=0.0)  # driven over, as it were
    x, y = chart.occupied().position_m.T
    assert not np.any((x > -0.9) & (x < 2.0) & (np.abs(y) < 0.7))


def test_scrolling_keeps_cells_in_place(chart: ObstacleMap) -> None:
    drive(chart, [CAR])
    before = chart.occupied()
    chart.recenter(3.33, -7.77)
    after = chart.occupied()
    assert chart.origin_m != (-32.0, -32.0)
    assert np.array_equal(before.confidence, after.confidence)
    assert np.allclose(before.position_m, after.position_m, atol=1e-9)


def test_the_map_scrolls_with_the_vehicle(chart: ObstacleMap) -> None:
    drive(chart, [CAR], start=-90.0, stop=0.0)
    assert np.all(np.abs(np.array(chart.origin_m) + 32.0) <= PARAMETERS.scroll_m)
    assert np.isfinite(chart.grid).all()
    assert len(chart.occupied().index) > 5


def test_heading_does_not_matter() -> None:
    east, west = ObstacleMap(PARAMETERS, VEHICLE), ObstacleMap(PARAMETERS, VEHICLE)
    tick(east, Pose(0.01, 0.01, 0, 0, 0), [(9.05, 11.0, 0.7, 2.1, 1.5)])
    tick(west, Pose(-0.01, -0.01, np.pi, 0, 0), [(-11.0, -9.05, -2.1, -0.7, 1.5)])
    assert len(east.occupied().index) > 5
    assert np.array_equal(east.grid, west.grid[::-1, ::-1])


def test_a_mirrored_scene_gives_a_mirrored_grid() -> None:
    left, right = ObstacleMap(PARAMETERS, VEHICLE), ObstacleMap(PARAMETERS, VEHICLE)
    drive(left, [(12.03, 14.0, 0.53, 2.33, 1.5)])
    drive(right, [(12.03, 14.0, -2.33, -0.53, 1.5)], names=list(MOUNTS)[::-1])
    assert len(left.occupied().index) > 5
    assert np.allclose(left.grid, right.grid[::-1], atol=1e-12)


def test_it_goes_on_the_same_from_a_pickle(chart: ObstacleMap) -> None:
    drive(chart, [CAR])
    other = pickle.loads(pickle.dumps(chart))
    for each in (chart, other):
        drive(each, [CAR], start=0.0, stop=3.0)
    assert np.array_equal(chart.grid, other.grid)


def test_sonar_marks_after_three_echoes(chart: ObstacleMap) -> None:
    pose = Pose(0, 0, 0, 0, 0)
    echo = np.array([4.0, 4.0, 1.5, 4.0, 4.0, 4.0, 0.0, 3.9])
    for expected in (False, False, True):
        chart.integrate_sonar(echo, pose)
        assert bool(len(chart.occupied().index)) is expected
    x, y = chart.occupied().position_m.T
    assert np.all((np.abs(x - 1.6) <= 0.25) & (np.abs(y - 2.2) <= 0.11))


def test_an_unknown_scanner_is_refused(chart: ObstacleMap) -> None:
    message = LidarScan(0, "lidar_tail", np.full(361, 81.92))
    with pytest.raises(NavError, match="no LIDAR is named 'lidar_tail'; known are lidar_bumper"):
        chart.integrate([Sweep(message, Pose(0, 0, 0, 0, 0))])
