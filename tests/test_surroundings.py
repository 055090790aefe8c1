"""What surroundings do to sensors: mirrors, other sonars, dust, mountains, steel, a low sun."""

from dataclasses import replace

import numpy as np
import pytest
from test_sensors import (
    ALONE,
    ANCHOR,
    EXACT,
    SECOND,
    SKY,
    FakeView,
    Flat,
    make_suite,
    of,
    only,
    parameters,
    run,
    wall,
)

from nav.messages import (
    CompassHeading,
    GpsFix,
    GpsQuality,
    ImuSample,
    LidarScan,
    RoadEstimate,
    SonarScan,
)
from twin.sensors.sight import Sight
from twin.sensors.suite import SensorSuite
from twin.world import Obstacle, Road, World


def test_a_sonar_now_and_then_hears_another():
    walls = [wall(0.0, 2.1, (6.0, 0.1, 2.0))]
    often = parameters(mounting=EXACT, sonar={"cross_talk": 0.1})
    suite = make_suite(2, walls, only("sonar"), often)
    range_m = np.array([m.range_m[2] for m in of(run(suite, FakeView(), 12000), SonarScan)])
    assert np.mean(range_m < 1.25) == pytest.approx(0.1 * 0.95, rel=0.25)
    assert range_m.max() < 1.35


@pytest.mark.parametrize(("kind", "yaw", "heard"), [
    ("car", 0.0, True), ("car", 0.5, True), ("car", 0.9, False), ("hay_bale", 0.9, True),
])  # fmt: skip
def test_a_smooth_face_mirrors_sound_away(kind, yaw, heard):
    turned = (np.cos(0.5 * yaw), 0.0, 0.0, np.sin(0.5 * yaw))
    face = Obstacle("face", kind, "box", (3.4, 0.0, 1.0), (0.05, 5.0, 1.0), turned)
    suite = make_suite(2, [face], only("sonar"), parameters(mounting=EXACT, sonar=ALONE))
    scan = of(run(suite, FakeView(), 30), SonarScan)[0]
    assert (scan.range_m[:2].min() < 4.0) == heard


def test_sound_passes_dust_and_some_beams_do_not():
    cloud = Obstacle("cloud", "dust", "box", (3.0, 0.0, 1.0), (0.3, 5.0, 1.0))
    suite, view = make_suite(2, [cloud], p=parameters(mounting=EXACT, sonar=ALONE)), FakeView()
    heard = run(suite, view, SECOND)
    assert all((m.range_m == 4.0).all() for m in of(heard, SonarScan))
    ahead = np.array([m.range_m[170:190] for m in of(heard, LidarScan, "lidar_bumper")])
    assert 0.08 < np.mean(ahead < 2.0) < 0.25


class Canyon(Flat):
    """Walls 1 km to the east and west, 1.5 km high; too far for the ray caster."""

    def height(self, x, y):
        return np.where(np.abs(x) > 1000.0, 1500.0, 0.0) * np.ones(np.broadcast(x, y).shape)


def test_far_mountains_hide_satellites_and_the_fix_is_worse_by_their_dilution():
    p = parameters(mounting=EXACT)
    fixes = {}
    for terrain in (Flat(), Canyon()):
        sky = np.array([[a, e] for e in (0.5, 1.1) for a in np.arange(8) * np.pi / 4.0])
        world = World(terrain, (), 0.7, ANCHOR, (0.0, 0.0, 0.0), sky)
        sight = Sight(world)
        sight.set_ground(np.zeros((360, 360)), -90.0, -90.0, 0.5)
        suite = SensorSuite(world, sight, 1, frozenset(only("gps")), p)
        fixes[type(terrain)] = of(run(suite, FakeView(0.0), 2 * SECOND), GpsFix)[-1]
    free, walled = fixes[Flat], fixes[Canyon]
    assert (free.satellites, walled.satellites) == (16, 10)
    assert walled.quality is GpsQuality.CONVERGED
    assert 1.1 < walled.sd_m / free.sd_m < 3.0


def test_the_bias_of_the_gyro_walks():
    walking = parameters(imu={"gyro_walk_radps": 0.01, "gyro_noise_radps": 0.0})
    ends = []
    for seed in range(40):
        rates = of(run(make_suite(seed, [], only("imu"), walking), FakeView(), SECOND), ImuSample)
        ends.append(rates[-1].angular_rate_radps - rates[0].angular_rate_radps)
    assert np.std(ends) == pytest.approx(0.01, rel=0.25)


class Turning(FakeView):
    """On the spot, at 0.5 rad/s."""

    def imu(self):
        return np.array([0.0, 0.0, 0.5]), self.force


def test_a_gyro_has_a_scale():
    suite = make_suite(3, [], only("imu"), parameters(imu={"gyro_scale_sd": 0.1}))
    mean = np.mean([m.angular_rate_radps[2] for m in of(run(suite, Turning(), SECOND), ImuSample)])
    assert 0.01 < abs(mean - 0.5) < 0.2


def test_steel_turns_the_compass_and_hay_does_not():
    p = parameters(compass={"bias_sd_rad": 0.0, "noise_sd_rad": 0.0})
    for kind, away_m, least, most in (
        ("car", 2.0, 0.02, 0.2), ("car", 7.0, 0.0, 0.02), ("hay_bale", 2.0, 0.0, 0.0),
    ):  # fmt: skip
        place = away_m * np.sqrt(0.5) + 0.6
        thing = Obstacle("it", kind, "box", (place, place, 0.75), (0.9, 0.9, 0.75))
        suite = make_suite(1, [thing], only("compass"), p)
        heading = of(run(suite, FakeView(0.0), 60), CompassHeading)[0].heading_rad
        assert least <= abs(heading) <= most, (kind, away_m)


def test_in_a_tunnel_of_steel_a_compass_is_lost_but_says_a_heading():
    walls = [wall(0.0, y, (15.0, 0.08, 1.6)) for y in (1.6, -1.6)]
    steel = [replace(w, name=f"t{i}", kind="tunnel") for i, w in enumerate(walls)]
    heading = of(run(make_suite(1, steel, only("compass")), FakeView(), 60), CompassHeading)[0]
    assert abs(heading.heading_rad) < 1.0


@pytest.mark.parametrize(("sun", "sure"), [(None, True), ((0.1, 0.2), False), ((0.1, 1.0), True),
                                           ((2.0, 0.2), True)])  # fmt: skip
def test_a_low_sun_dazzles_the_camera(sun, sure):
    road = Road(((0.0, 0.0), (100.0, 0.0)), 5.0, (), sun)
    world = World(Flat(), (), 0.7, ANCHOR, (0.0, 0.0, 0.0), SKY, (), road)
    suite = SensorSuite(world, Sight(world), 1, frozenset(only("road_camera")))
    view = FakeView()
    view.SITES = (*view.SITES, ("reference", (0.0, 0.0, 0.0), 0.0))
    said = of(run(suite, view, SECOND), RoadEstimate)
    assert (np.mean([m.confidence for m in said]) > 0.5) == sure
