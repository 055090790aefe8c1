"""A scan takes 20 ms: what the twin's mirror sees meanwhile, the navigator puts where it stands."""

import numpy as np
import pytest
from test_sensors import EXACT, FakeView, make_suite, of, only, parameters, run, wall

from nav.fusion.scan_geometry import (
    Pose,
    ScanGeometry,
    Scans,
    level_points,
    placed,
    returns,
    scan_geometry,
)
from nav.messages import LidarScan
from scenarios.parameter_files import parameters_of

VEHICLE = parameters_of("ion").vehicle
WALL_M, SPEED_MPS, YAW_RADPS = 20.0, 10.0, 0.6
EXACT_BEAMS = {"noise_sd_m": 0.0, "bias_sd_m": 0.0, "edge_m": 1e3}


class Turning(FakeView):
    """Drives along x and turns."""

    def site_velocity(self, name):
        turn = np.array([0.0, 0.0, YAW_RADPS])
        lever = self.site_pose(name)[0] - self.site_pose("reference")[0]
        return super().site_velocity(name)[0] + np.cross(turn, lever), turn

    SITES = (*FakeView.SITES, ("reference", (0.0, 0.0, 0.0), 0.0))


@pytest.fixture
def scan() -> LidarScan:
    p = parameters(mounting=EXACT, lidar=EXACT_BEAMS)
    suite = make_suite(0, [wall(WALL_M, 0.0, (0.1, 9.0, 2.0))], only("lidar_bumper"), p)
    return of(run(suite, Turning(SPEED_MPS), 40), LidarScan)[-1]


def geometry_of(sensor: str) -> ScanGeometry:
    return scan_geometry(VEHICLE.lidar_mounts[sensor], VEHICLE.lidar, VEHICLE.outline)


def depth_m(scan: LidarScan, began: bool) -> float:
    """How far apart, along x, the ends of the beams on the wall seem to be."""
    t, geometry = scan.time_ns * 1e-9, geometry_of(scan.sensor)
    now = Pose(SPEED_MPS * t, 0.0, 0.0, 0.0, 0.0)
    back_s = geometry.sweep_s
    first = Pose(SPEED_MPS * (t - back_s), 0.0, -YAW_RADPS * back_s, 0.0, 0.0)
    frame = placed(geometry, now)[None]
    moved = frame - placed(geometry, first)[None] if began else None
    scans = Scans([geometry], frame, scan.range_m[None], moved)
    return float(np.ptp(level_points(scans, returns(scans, 40.0))[0]))


def test_a_scan_is_smeared_by_the_vehicles_motion_and_put_right(scan) -> None:
    smeared = SPEED_MPS * 0.0133  # between whole degrees and halves
    assert depth_m(scan, began=False) > smeared
    assert depth_m(scan, began=True) < 0.03  # counts of a centimetre


def test_whole_degrees_come_before_the_halves() -> None:
    geometry = geometry_of("lidar_roof")
    assert geometry.sweep_s == pytest.approx(0.020, abs=1e-4)
    assert geometry.age[0] == 1.0
    assert geometry.age[359] == 0.0
    assert np.all(geometry.age[::2].min() > geometry.age[1::2].max())
