"""Whom to believe: each sensor, healthy and spoiled as a fault spoils it."""

from dataclasses import replace

import numpy as np
import pytest

from nav.fusion.plausibility import Plausibility
from nav.fusion.plausibility.scans import steadiness
from nav.fusion.plausibility.steps import Seen, step_m
from nav.messages import (
    CompassHeading,
    Gear,
    GpsFix,
    GpsQuality,
    ImuSample,
    LidarScan,
    RadarTracks,
    SonarScan,
    VehicleState,
)
from scenarios.parameter_files import parameters_of
from twin.faults.spoiled import spoiled

P = parameters_of("ion").plausibility
MOUNTS = parameters_of("ion").vehicle.lidar_mounts
SPEED_MPS = 5.0
RATE_HZ = {
    LidarScan: 37.5, SonarScan: 20.0, RadarTracks: 15.0, GpsFix: 20.0, ImuSample: 100.0,
    CompassHeading: 10.0, VehicleState: 50.0,
}  # fmt: skip
DEGREE_M = 111_320.0


class Straight:
    """The ego state of who drives steadily along the equator, and knows it."""

    ready = True
    speed_mps = SPEED_MPS
    rocking_radps = 0.0

    def antenna_gap_m(self, fix):
        x, y = fix.longitude_deg * DEGREE_M, fix.latitude_deg * DEGREE_M
        return float(np.hypot(x - SPEED_MPS * fix.time_ns * 1e-9, y)), 0.05

    def compass_gap_rad(self, heading_rad):
        return heading_rad

    def yaw_rate_of(self, steering_rad):
        return SPEED_MPS * steering_rad / 2.0


def message(kind, time_ns, rng):
    """What a healthy sensor says."""
    t = time_ns * 1e-9
    wall = 6.0 / np.maximum(np.cos(np.linspace(-1.5, 1.5, 361)), 0.1) - 0.2 * np.sin(t)
    noise = rng.standard_normal(361)
    return {
        LidarScan: lambda: LidarScan(time_ns, "lidar_roof", wall + 0.006 * noise),
        SonarScan: lambda: SonarScan(time_ns, [4.0, 4.0, *(2.0 + 0.01 * noise[:6])]),
        RadarTracks: lambda: RadarTracks(time_ns, 30.0 + noise[:2], noise[:2], noise[:2]),
        GpsFix: lambda: GpsFix(
            time_ns, GpsQuality.CONVERGED, 8, 0.1 * noise[0] / DEGREE_M,
            (SPEED_MPS * t + 0.1 * noise[1]) / DEGREE_M, 0.0, 0.1, (SPEED_MPS, 0.0, 0.0),
        ),
        ImuSample: lambda: ImuSample(time_ns, 0.002 * noise[:3], (0.0, 0.0, 9.81), 0.0, 0.0),
        CompassHeading: lambda: CompassHeading(time_ns, 0.02 * noise[0]),
        VehicleState: lambda: VehicleState(
            time_ns, SPEED_MPS + 0.02 * noise[:6], 0.001 * noise[6], 0.3, 0.0, Gear.HIGH, False
        ),
    }[kind]()  # fmt: skip


def drive(kind, seconds, spoil=lambda m: m, monitor=None, from_s=12.0):
    """Hear all sensors for some seconds, one kind of them spoiled; what is doubted then."""
    monitor, rng, ego = monitor or Plausibility(P, MOUNTS), np.random.default_rng(0), Straight()
    ticks = range(round(from_s * 300), round((from_s + seconds) * 300))
    for k in ticks:
        for each, rate in RATE_HZ.items():
            if k % round(300 / rate) == 0:
                said = message(each, k * 10**9 // 300, rng)
                monitor.believes(spoil(said) if each is kind else said, ego)
    return monitor


def warm(kind):
    """Who has heard all sensors for long enough that GPS has no outage to be excused by."""
    return drive(kind, 12.0, from_s=0.0)


def test_healthy_sensors_are_believed():
    assert warm(None).doubted == {}


KINDS = [LidarScan, GpsFix, ImuSample, CompassHeading, VehicleState]


@pytest.mark.parametrize("how", ["noisy", "offset"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_spoiled_sensor_is_doubted_and_believed_again(kind, how):
    monitor, rng = warm(kind), np.random.default_rng(1)
    drive(kind, 2.5, lambda m: spoiled(m, how, None, rng), monitor)
    assert len(monitor.doubted) == 1
    drive(kind, 8.0, monitor=monitor, from_s=14.5)
    assert monitor.doubted == {}


@pytest.mark.parametrize(("sees_m", "doubted"), [(40.0, False), (10.0, True)])
def test_ground_that_is_grazed_far_ahead_may_step(sees_m, doubted):
    """As the bumper's scanner at kilometre 165 of a race, by a pitch of 0.2 mrad."""
    rng, monitor = np.random.default_rng(2), Plausibility(P, MOUNTS)
    for k in range(200):
        range_m = sees_m + 0.4 * (k >= 100) + 0.006 * rng.standard_normal(361)
        monitor.believes(LidarScan(k * 26_666_667, "lidar_bumper", range_m), Straight())
    assert ("lidar_bumper" in monitor.doubted) == doubted


def test_noisy_sonars_are_doubted_and_believed_again():
    monitor, rng = warm(SonarScan), np.random.default_rng(1)
    drive(SonarScan, 2.5, lambda m: spoiled(m, "noisy", None, rng), monitor)
    assert monitor.doubted == {"sonar": "noisy"}
    drive(SonarScan, 8.0, monitor=monitor, from_s=14.5)
    assert monitor.doubted == {}


def test_one_sonar_may_pass_from_thing_to_thing():
    def posts(scan):
        near = round(scan.time_ns * 20e-9) % 2 == 0
        return replace(scan, range_m=[1.0 if near else 2.0, *scan.range_m[1:]])

    assert drive(SonarScan, 2.5, posts, warm(SonarScan)).doubted == {}


@pytest.mark.parametrize("kind", [*KINDS, SonarScan, RadarTracks])
def test_a_frozen_sensor_is_doubted(kind):
    monitor, rng = warm(kind), np.random.default_rng(0)
    held = message(kind, 0, rng)
    drive(kind, 2.0, lambda m: replace(held, time_ns=m.time_ns), monitor)
    assert len(monitor.doubted) == 1


def test_a_scanner_that_sees_nothing_is_not_frozen():
    nothing = np.full(361, 81.92)
    monitor = drive(LidarScan, 2.0, lambda m: replace(m, range_m=nothing))
    assert monitor.doubted == {}


@pytest.mark.parametrize(("brake", "doubted"), [(1.0, {}), (0.0, {"odometry"})])
def test_braked_wheels_may_slide(brake, doubted):
    def slide(state):
        return replace(state, wheel_speed_mps=state.wheel_speed_mps - 2.0, brake=brake)

    monitor = drive(VehicleState, 2.5, slide, warm(VehicleState))
    assert set(monitor.doubted) == set(doubted)


def test_after_an_outage_a_receiver_may_be_elsewhere():
    monitor, rng = warm(GpsFix), np.random.default_rng(1)
    drive(GpsFix, 1.0, lambda m: replace(m, quality=GpsQuality.NONE), monitor)
    drive(GpsFix, 3.0, lambda m: spoiled(m, "offset", 2.0, rng), monitor, 13.0)
    assert monitor.doubted == {}


def test_edges_are_no_noise():
    rough = 5.0 + np.random.default_rng(1).uniform(0.0, 4.0, 361)  # ground, say, and nearer
    assert steadiness(rough, rough - 0.2, 20.0, P.scan) == 1.0
    noise = 0.5 * np.random.default_rng(0).standard_normal((2, 361))
    assert steadiness(*(5.0 + noise), 20.0, P.scan) < 0.2
    assert steadiness(rough + 40.0, rough + 40.0, 20.0, P.scan) is None


def test_leaves_that_half_of_the_beams_pass_are_no_noise():
    passed = np.random.default_rng(0).random((2, 361)) < 0.5
    before, after = np.where(passed, 15.0, 6.0)
    assert steadiness(before, after, 20.0, P.scan) > P.scan.steady_share


def stepped(ranges_m, way_m=0.0):
    """What is found in the middle of some scans."""
    return step_m([Seen(r, way_m) for r in ranges_m], P.scan.step)


def still(range_m, step: float | np.ndarray = 0.0):
    """Scans of one scene, and from the middle on an offset."""
    aside = P.scan.step.quiet_scans
    return [range_m] * aside + [range_m + step] * aside


WALL = np.full(91, 10.0)


def test_an_offset_that_comes_is_a_step():
    assert stepped(still(WALL, 0.5)) == pytest.approx(0.5)
    assert stepped(still(WALL, 0.1)) == 0.0
    assert stepped(still(WALL)) == 0.0


def test_an_offset_is_seen_from_a_vehicle_that_nears_all_by_its_bearing():
    bearing = np.linspace(-1.5, 1.5, 91)
    nearing = [r - 0.19 * k * np.cos(bearing) for k, r in enumerate(still(WALL, 0.5))]
    assert stepped(nearing, 0.19) == pytest.approx(0.5, abs=0.02)
    away = [r + 0.19 * k * np.cos(bearing) for k, r in enumerate(still(WALL, 0.5))]
    assert stepped(away, -0.19) == pytest.approx(0.5, abs=0.02)


def test_what_comes_nearer_does_not_step():
    nearing = [WALL - 0.3 * k for k in range(2 * P.scan.step.quiet_scans)]
    assert stepped(nearing, 0.3) == 0.0
    jump = [r - 0.7 * (k >= len(nearing) // 2) for k, r in enumerate(nearing)]
    assert stepped(jump, 0.3) == pytest.approx(-0.7)


def test_a_far_slope_that_is_grazed_does_not_step():
    """The bumper's scanner in the race at 7 m/s: half a metre from scan to scan, all alike."""
    slope = np.linspace(35.0, 46.0, 91)
    for after in (0.58, 0.3, 0.1):
        shaken = still(slope, 0.61)
        shaken[-2] = slope + 0.61 - after
        assert stepped(shaken, 0.19) == 0.0


def test_where_too_little_is_seen_nothing_steps():
    few = np.where(np.arange(91) < 20, 10.0, 81.92)
    assert stepped(still(few, np.where(few < 81.92, 0.5, 0.0))) == 0.0
