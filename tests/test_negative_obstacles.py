"""Drops, seen by the twin's ray caster on the twin's ground: what must be found, and what must not.

The vehicle goes straight along x at 6.8 m/s, tilted as its four wheels stand.
"""

from dataclasses import replace
from functools import partial
from math import atan2

import numpy as np
import pytest
from test_obstacle_map import GEOMETRY, PARAMETERS, VEHICLE

from nav.fusion.expected_ground import expected
from nav.fusion.ground_profile import UNKNOWN_M
from nav.fusion.negative_obstacles import _in_wide_runs
from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.scan_geometry import Pose, Sweep, placed
from nav.messages import LidarScan
from scenarios.geometry import Pose as Place
from scenarios.route.course import DESERT
from scenarios.things import Site
from twin.landforms import DropOff, Pit
from twin.raycast import Scene, cast
from twin.terrain import GENTLE, Banks, RollingGround, TerrainWindow

SEES = replace(PARAMETERS, negative=replace(PARAMETERS.negative, enabled=True))
STEP_M = 0.34
"""From one scan of two to the next, at 6.8 m/s; two make a tick."""
EDGE_M = 40.0
FLAT = tuple(o._replace(amplitude_m=0.0) for o in GENTLE)


class Kink:
    """Ground that begins to fall at a line across the way."""

    def __init__(self, slope: float, start_m: float = EDGE_M) -> None:
        self.slope, self.start_m = slope, start_m

    def height(self, x, y):
        return -self.slope * np.maximum(x - self.start_m, 0.0) + 0.0 * y


def stand(terrain, x: float) -> tuple[Pose, float]:
    """Pose and ground height of a vehicle that stands at (x, 0) and looks along x."""
    wheel = np.array([(x + dx, dy) for dx in (0.0, 1.7) for dy in (-0.62, 0.62)])
    back_right, back_left, front_right, front_left = terrain.height(*wheel.T).tolist()
    rise = (front_left + front_right - back_left - back_right) / 2
    lean = (front_left + back_left - front_right - back_right) / 2
    pose = Pose(x, 0.0, 0.0, atan2(lean, 1.24), -atan2(rise, 1.7))
    return pose, (back_left + back_right) / 2


class World:
    """A terrain with solids, a map, and how wrong attitude and mounting are."""

    def __init__(
        self, terrain, solids=(), error=(0.0, 0.0), tilt_rad=0.0, parameters=SEES, lean_rad=0.0
    ):
        self.terrain, self.error = terrain, error
        self.scene, self.window = Scene(list(solids)), TerrainWindow(terrain, 0.0, 0.0)
        self.chart = ObstacleMap(parameters, VEHICLE)
        self.turn = np.array([[1, 0, 0], [0, 1, 0], [-tilt_rad, lean_rad, 1.0]])
        self._see()

    def _see(self):
        w = self.window
        self.scene.set_ground(w.z, w.x0, w.y0, w.spacing)

    def scan(self, name, pose, ground_m, time_ns):
        frame = placed(GEOMETRY[name], pose)
        ray = (frame[:, :2] @ GEOMETRY[name].ray).T @ self.turn.T
        origin = frame[:, 2] + (0.0, 0.0, ground_m)
        range_m = cast(self.scene, origin, ray, 81.9)
        counts = np.where(range_m < 81.9, np.rint(range_m * 100), 8192)
        return LidarScan(time_ns, name, counts * 0.01)

    def drive(self, stop_m: float) -> int:
        """Returns the most cells that ever were a drop."""
        most, heard = 0, []
        for k, x in enumerate(np.arange(0.0, stop_m, STEP_M).tolist()):
            if self.window.recenter(x, 0.0):
                self._see()
            pose, ground = stand(self.terrain, x)
            said = pose._replace(
                roll_rad=pose.roll_rad + self.error[0], pitch_rad=pose.pitch_rad + self.error[1]
            )
            names = ("lidar_roof", "lidar_bumper")
            heard += [Sweep(self.scan(n, pose, ground, k * 50_000_000), said) for n in names]
            if k % 2:
                self.chart.integrate(heard)
                heard = []
                most = max(most, len(self.drops().T))
        return most

    def drops(self):
        """Cells that are drops: places (2, n); a drop has no top."""
        index = self.chart.occupied_index()
        return np.stack(self.chart.lattice.centre_m(index[self.chart._top.ravel()[index] < -1e5]))


def across(depth_m: float, ground=FLAT, seed: int = 0) -> RollingGround:
    """Ground that is lower from x = EDGE_M on, everywhere."""
    edge = DropOff((EDGE_M, -60.0), (EDGE_M, 60.0), depth_m, reach_m=60.0)
    return RollingGround(seed, ground, (edge,))


@pytest.mark.parametrize("tilt_rad", [-0.005, 0.0, 0.005])
@pytest.mark.parametrize("depth_m", [0.6, 1.0, 1.5, 5.0])
def test_a_drop_across_the_way_is_found_in_time(depth_m, tilt_rad):
    world = World(across(depth_m), tilt_rad=tilt_rad)
    world.drive(EDGE_M - 12.0)
    x, y = world.drops()
    lane = np.unique(np.round(y[(np.abs(y) < 5.0) & (x < EDGE_M + 1.0)], 1))
    assert len(lane) >= 48  # of 50 cells
    assert x.min() > EDGE_M - 1.2


@pytest.mark.parametrize("lean_rad", [-0.015, 0.015])
def test_a_scanner_that_leans_is_found_out(lean_rad):
    world = World(RollingGround(0, GENTLE), lean_rad=lean_rad)
    world.drive(120.0)
    assert world.chart.ground.lean_rad == pytest.approx(lean_rad, abs=0.003)


def test_what_stands_up_beyond_the_known_ground_teaches_nothing():
    world = World(RollingGround(0, FLAT))
    world.drive(5.0)
    ahead = expected(world.chart.ground, SEES.negative)
    places = np.array([[26.0, 26.0], [0.0, 0.0], [0.2, 0.6]])
    assert ahead.continues(places, np.ones(2, bool)).tolist() == [True, False]


def test_the_low_ground_behind_an_edge_teaches_nothing():
    """Who brakes before an edge looks down on what lies behind it."""
    world = World(across(0.6))
    world.drive(EDGE_M - 14.0)
    pose, ground_m = stand(world.terrain, EDGE_M - 10.0)
    pose = pose._replace(pitch_rad=0.03)
    for k in range(3):
        scan = world.scan("lidar_roof", pose, ground_m, 10**10 + k * 50_000_000)
        world.chart.integrate([Sweep(scan, pose)])
    profile = world.chart.ground
    x, y = np.meshgrid(np.arange(EDGE_M + 2.0, EDGE_M + 12.0), np.arange(-4.0, 5.0))
    index, _ = profile.lattice.index(x.ravel(), y.ravel())
    assert (profile.height_m.ravel()[index] >= UNKNOWN_M).all()


def test_a_drop_on_rolling_ground_is_found():
    for seed in range(3):
        world = World(across(1.0, GENTLE, seed), error=(0.005, 0.008))
        assert world.drive(EDGE_M - 10.0) > 200


def test_a_drop_beside_the_way_leaves_the_way_free():
    edge = DropOff((EDGE_M, -2.0), (EDGE_M + 20.0, -2.0), 1.0)
    world = World(RollingGround(0, FLAT, (edge,)))
    world.drive(EDGE_M + 4.0)
    x, y = world.drops()
    assert y.max() < -1.3
    along = x[y > -3.0]
    assert set(range(41, 58)) <= set(np.floor(along).astype(int).tolist())


def test_switched_off_nothing_is_found():
    off = replace(PARAMETERS, negative=replace(PARAMETERS.negative, enabled=False))
    assert World(across(1.5), parameters=off).drive(EDGE_M - 5.0) == 0


@pytest.mark.parametrize("error", [(0.0, 0.0), (0.009, -0.009), (-0.009, 0.009)])
@pytest.mark.parametrize("octaves", [GENTLE, DESERT], ids=["gentle", "desert"])
@pytest.mark.parametrize("seed", range(4))
def test_ground_of_the_courses_has_no_drops(seed, octaves, error):
    assert World(RollingGround(seed, octaves), error=error).drive(150.0) == 0


@pytest.mark.parametrize("slope", [0.03, 0.05, 0.08])
@pytest.mark.parametrize("error", [-0.009, 0.0, 0.009])
def test_a_kink_is_no_drop(slope, error):
    world = World(RollingGround(0, FLAT, (Kink(slope),)), error=(0.0, error))
    assert world.drive(EDGE_M + 10.0) == 0


def test_a_pass_with_banks_has_no_drops_on_its_track():
    banks = Banks(((30.0, 0.0), (84.0, 0.0)), 1.9, (0.40, 0.55), 2.5)
    for seed in range(3):
        world = World(RollingGround(seed, GENTLE, (banks,)))
        for stop in (20.0, 50.0, 90.0):
            world.drive(stop)
            assert not np.any(np.abs(world.drops()[1]) < 3.0)


@pytest.mark.parametrize("what", ["car", "bale", "strips", "wall"])
def test_behind_what_stands_there_is_no_drop(what):
    ground = RollingGround(1, GENTLE)
    make = partial(Site, what, what, ground)
    place = Place(EDGE_M, 0.5, 0.0)
    solids = {
        "car": lambda: make(place).car(),
        "bale": lambda: make(place).bales(1),
        "strips": lambda: make(place).rumble_strips(),
        "wall": lambda: [make(place).box("", place, (0.2, 4.0), 1.5)],
    }[what]()
    assert World(ground, solids).drive(EDGE_M - 4.0) == 0


@pytest.mark.parametrize(("radius_m", "depth_m"), [(0.6, 0.45), (0.4, 2.0), (3.0, 0.25)])
def test_small_and_shallow_holes_are_let_be(radius_m, depth_m):
    hole = Pit((EDGE_M, 0.0), radius_m, depth_m)
    assert World(RollingGround(0, GENTLE, (hole,))).drive(EDGE_M - 4.0) == 0


def test_ground_that_is_seen_there_takes_a_drop_away():
    world = World(RollingGround(0, FLAT))
    world.drive(20.0)
    x = np.arange(37.0, 39.0, 0.1)
    for _ in range(4):
        world.chart._mark_drops(np.stack([x, np.zeros_like(x)]))
    assert len(world.drops().T) > 20
    world.window, world.k = TerrainWindow(world.terrain, 19.0, 0.0), 0
    pose, ground = stand(world.terrain, 19.0)
    for k in range(100):  # it sways, and so sees all of it
        swung = pose._replace(pitch_rad=0.006 * np.sin(0.3 * k))
        world.chart.integrate([Sweep(world.scan("lidar_roof", swung, ground, 10**10 + k), swung)])
    assert len(world.drops().T) < 10


def test_a_drop_is_wide():
    """Four beams that look into a gap between two bales are none: NQE 9 and 17 stood before one."""
    scan = np.repeat([0, 1], 20)
    beam = np.tile(np.arange(100, 120), 2)
    deep = np.zeros(40, bool)
    deep[3:7] = deep[18:24] = deep[28:36] = True
    wide = _in_wide_runs(scan, beam, deep, PARAMETERS.negative.least_beams)
    assert np.flatnonzero(wide).tolist() == list(range(28, 36))
    assert not _in_wide_runs(scan, beam, np.zeros(40, bool), 8).any()


def test_who_comes_back_finds_the_drop_that_he_saw():
    world = World(across(1.0))
    world.drive(EDGE_M - 12.0)
    seen = world.drops().T.tolist()
    world.chart.recenter(EDGE_M + 45.0, 0.0)
    assert world.drops().size == 0
    world.chart.recenter(EDGE_M - 12.0, 0.0)
    assert world.drops().T.tolist() == seen


def test_drops_far_behind_are_forgotten():
    world = World(across(1.0))
    world.drive(EDGE_M - 12.0)
    for x in (EDGE_M + 45.0, EDGE_M + 200.0, EDGE_M - 12.0):
        world.chart.recenter(x, 0.0)
    assert world.drops().size == 0
