"""Radar tracks in the map: they mark nothing, and confirm what scanners see."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from test_obstacle_map import GATE, PARAMETERS, VEHICLE, drive, flat, on, scan

from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.radar import echoes
from nav.fusion.scan_geometry import Pose, Sweep
from nav.messages import LidarScan, RadarTracks
from scenarios.ablation import disabled_sensors
from scenarios.course import Course
from scenarios.episode import Episode
from scenarios.parameter_files import parameters_of
from scenarios.route.course import build as build_route
from scenarios.vehicles import VEHICLES
from twin.faults import Fault

RADAR = VEHICLE.radars["radar"]
STILL = Pose(0.0, 0.0, 0.0, 0.0, 0.0)


def tracks_of(*places: tuple[float, float], pose: Pose = STILL, time_ns: int = 0) -> RadarTracks:
    """Exact tracks of places in N, seen from `pose`, which heads along x."""
    at = [(x - pose.x_m - RADAR.position_m[0], y - pose.y_m) for x, y in places]
    ranges, azimuths = [hypot(*p) for p in at], [np.arctan2(y, x) for x, y in at]
    return RadarTracks(time_ns, ranges, azimuths, [-5.0] * len(at))


def seen(*places: tuple[float, float], pose: Pose = STILL):
    return echoes(tracks_of(*places, pose=pose), RADAR, pose)


@pytest.fixture
def chart() -> ObstacleMap:
    chart = ObstacleMap(PARAMETERS, VEHICLE)
    drive(chart, [])
    return chart


def one_return(range_m: float = 10.0) -> list[Sweep]:
    """One beam of the scanner on the bumper ends straight ahead, at x = 2.05 m + range."""
    beams = np.array(scan("lidar_bumper", STILL, []).range_m)
    beams[180] = range_m
    return [Sweep(LidarScan(3_000_000_000, "lidar_bumper", beams), STILL)]


def test_tracks_alone_make_no_obstacle(chart: ObstacleMap) -> None:
    post = seen((12.05, 0.0), (8.0, 0.5))
    for k in range(50):
        pose = on(flat, 0.0)
        scans = [Sweep(scan(n, pose, [], time_s=3.0 + 0.1 * k), pose) for n in VEHICLE.lidar_mounts]
        chart.integrate(scans, post)
    assert not chart.grid.any()


def test_one_return_near_a_track_is_an_obstacle(chart: ObstacleMap) -> None:
    chart.integrate(one_return(), seen((12.05, 0.0)))
    assert len(chart.occupied().index) == 1


@pytest.mark.parametrize(
    ("place", "counts"),
    [((12.9, 0.0), True), ((11.2, 0.0), True), ((13.2, 0.0), False), ((10.9, 0.0), False),
     ((12.05, 0.16), True), ((12.05, -0.16), True), ((12.05, 0.2), False),
     ((12.05, -0.2), False)],
)  # fmt: skip
def test_a_track_speaks_only_for_what_lies_within_its_errors(
    chart: ObstacleMap, place: tuple[float, float], counts: bool
) -> None:
    chart.integrate(one_return(), seen(place))
    assert bool(len(chart.occupied().index)) is counts


def test_far_away_the_range_may_err_by_a_twentieth() -> None:
    far = seen((RADAR.position_m[0] + 60.0, 0.0))
    x = RADAR.position_m[0] + np.array([56.9, 57.1, 62.9, 63.1])
    assert far.near(np.array([x, np.zeros(4)])).tolist() == [False, True, True, False]


def test_a_track_is_placed_where_the_vehicle_was_when_it_was_measured() -> None:
    then = Pose(3.0, -2.0, np.pi / 2, 0.0, 0.0)
    track = RadarTracks(0, [20.0], [0.1], [-5.0])
    at = echoes(track, RADAR, then)
    x, y = 3.0 - 20.0 * np.sin(0.1), -2.0 + RADAR.position_m[0] + 20.0 * np.cos(0.1)
    assert at.near(np.array([[x, x + 1.0], [y, y]])).tolist() == [True, False]


def first_seen(with_radar: bool, most: int) -> int:
    """Ticks until a thing is an obstacle that one beam meets in every other tick."""
    chart = ObstacleMap(PARAMETERS, VEHICLE)
    drive(chart, [])
    for k in range(most):
        message = one_return()[0][0] if k % 2 == 0 else scan("lidar_bumper", STILL, [])
        now = replace(message, time_ns=3_000_000_000 + k * 100_000_000)
        chart.integrate([Sweep(now, STILL)], seen((12.05, 0.0)) if with_radar else None)
        if len(chart.occupied().index):
            return k
    return most


def test_with_the_radar_an_obstacle_is_confirmed_sooner() -> None:
    assert first_seen(True, 20) == 0
    assert 0 < first_seen(False, 20) < 20


def test_tracks_do_not_hold_up_what_is_gone(chart: ObstacleMap) -> None:
    for _ in range(3):
        chart.integrate(one_return(), seen((12.05, 0.0)))
    for k in range(10):
        pose = on(flat, 0.0)
        scans = [Sweep(scan(n, pose, [], time_s=3.1 + 0.1 * k), pose) for n in VEHICLE.lidar_mounts]
        chart.integrate(scans, seen((12.05, 0.0)))
    assert len(chart.occupied().index) == 0


def test_tracks_of_its_posts_do_not_shut_a_gate(chart: ObstacleMap) -> None:
    rng = np.random.default_rng(1)
    for k in range(60):
        pose = Pose(5.0 + 0.2 * k, 0.0, 0.0, 0.0, 0.0)
        said = tracks_of((20.0, 1.675), (20.0, -1.675), pose=pose)
        worst = rng.choice([-1.0, 1.0], 2)
        said = replace(
            said,
            range_m=said.range_m + worst * np.maximum(0.914, 0.05 * said.range_m),
            azimuth_rad=said.azimuth_rad + worst * 0.0035,
        )
        scans = [
            Sweep(scan(n, pose, GATE, time_s=3.0 + 0.1 * k + t), pose)
            for t in (0.0, 0.05)
            for n in VEHICLE.lidar_mounts
        ]
        chart.integrate(scans, echoes(said, RADAR, pose))
    y = chart.occupied().position_m[:, 1]
    assert np.any(y > 1.5)
    assert np.any(y < -1.5)
    assert np.abs(y).min() >= 1.35


# ---------------------------------------------------------------------- in the navigator


def straight(*faults: Fault) -> Course:
    rows = [f"{i + 1},34.0,{-117.0 + i * 3e-4:.9f},15,15,####,####,####" for i in range(8)]
    course = build_route("\n".join(rows), "straight.rddf", None, None, 5)
    return replace(course, world=replace(course.world, faults=faults))


def test_without_its_radar_the_vehicle_drives_on_as_fast() -> None:
    episode = Episode(straight(Fault("radar", "silent", 3.0)), 5)
    states: set[str] = set()
    while episode.outcome is None and episode.time_s < 12.0:
        episode.tick()
        states.add(episode.state)
    situation = episode.navigator.high_level.situation
    assert situation is not None
    assert situation.health.missed == ("radar",)
    assert situation.V0_mps > episode.navigator.parameters.states.alarm.lost_mps
    assert "alarm" not in states
    assert episode.truth.speed_mps > 3.0


def test_a_vehicle_that_should_have_no_radar_heeds_none_and_misses_none() -> None:
    vehicle = replace(parameters_of("ion").vehicle, radars={})
    episode = Episode(straight(), 5, nav_parameters=replace(parameters_of("ion"), vehicle=vehicle))
    while episode.time_s < 5.0:
        episode.tick()
    situation = episode.navigator.high_level.situation
    assert situation is not None
    assert situation.health.missed == ()


def test_only_ion_has_a_radar_to_take_away() -> None:
    ion, *others = (VEHICLES[name] for name in ("ion", "pioneer", "dubins"))
    assert disabled_sensors(("no-radar",), ion.lidars, ion.radars) == {"radar"}
    assert "radar" in disabled_sensors(("blind",), ion.lidars, ion.radars)
    for other in others:
        assert "radar" not in disabled_sensors(("blind",), other.lidars, other.radars)
        with pytest.raises(ValueError, match="no-radar: unknown"):
            disabled_sensors(("no-radar",), other.lidars, other.radars)


def test_without_the_radar_nothing_is_heard_of_it() -> None:
    for ablate, heard in (((), True), (("no-radar",), False)):
        episode = Episode(straight(), 5, ablate)
        records = [r for _ in range(50) for r in episode.tick()]
        assert any(isinstance(r.message, RadarTracks) for r in records) is heard
