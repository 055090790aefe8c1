"""Every sensor's rate, delay and noise, seen through a fake vehicle."""

import pickle

import msgspec
import numpy as np
import pytest

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
)  # fmt: skip
from twin.earth import to_world
from twin.faults import Fault
from twin.sensors.gps import hdop
from twin.sensors.imu import tilt_of
from twin.sensors.parameters import SensorParameters, sensor_parameters
from twin.sensors.sensor import draw_mounting, generator, schedule
from twin.sensors.sight import Sight
from twin.sensors.suite import SensorSuite
from twin.truth import Applied
from twin.world import Obstacle, World

ANCHOR = (34.1, -117.5)
SECOND = 300
SKY = np.array([[a, e] for e in (0.5, 1.1) for a in np.arange(5) * 1.2566 + e])
ALONE = {"cross_talk": 0.0}
EXACT = {"position_sd_m": 0.0, "angle_sd_rad": 0.0}


class Flat:
    """A level plain at height 0."""

    def height(self, x, y):
        return np.zeros(np.broadcast(x, y).shape)


class FakeView:
    """A vehicle on a plain that goes along x at constant speed, turned by roll, pitch and yaw."""

    SITES = (
        ("gps", (0.6, 0.0, 1.98), 0.0),
        ("imu", (0.6, 0.0, 0.8), 0.0),
        ("compass", (0.0, 0.0, 1.0), 0.0),
        ("lidar_bumper", (2.05, 0.0, 0.55), 0.0),
        ("lidar_roof", (1.3, 0.0, 1.9), 0.0),
        ("lidar_left", (1.9, 0.7, 0.75), 0.8),
        ("lidar_right", (1.9, -0.7, 0.75), -0.8),
        ("radar", (2.05, 0.0, 0.4), 0.0),
        ("sonar_front_left", (2.05, 0.45, 0.7), 0.0),
        ("sonar_front_right", (2.05, -0.45, 0.7), 0.0),
        ("sonar_left_front", (1.6, 0.7, 0.7), 0.5 * np.pi),
        ("sonar_left_rear", (-0.6, 0.7, 0.7), 0.5 * np.pi),
        ("sonar_right_front", (1.6, -0.7, 0.7), -0.5 * np.pi),
        ("sonar_right_rear", (-0.6, -0.7, 0.7), -0.5 * np.pi),
        ("sonar_rear_left", (-0.9, 0.45, 0.7), np.pi),
        ("sonar_rear_right", (-0.9, -0.45, 0.7), np.pi),
    )

    def __init__(self, speed_mps=0.0, roll=0.0, pitch=0.0, yaw=0.0):
        self.k, self.speed_mps = 0, speed_mps
        self.rotation = turn(2, yaw) @ turn(1, pitch) @ turn(0, roll)
        self.applied = Applied(0.1, 0.3, 0.0, int(Gear.LOW), False, 2.0)
        self.force = self.rotation.T @ (0.0, 0.0, 9.81)

    @property
    def wheel_speed_radps(self):
        return np.full(6, self.speed_mps / 0.3175)

    def site_pose(self, name):
        offset, yaw = next((p, y) for n, p, y in self.SITES if n == name)
        along = np.array([self.speed_mps * self.k / SECOND, 0.0, 0.0])
        return along + self.rotation @ offset, self.rotation @ turn(2, yaw)

    def site_velocity(self, name):
        return np.array([self.speed_mps, 0.0, 0.0]), np.zeros(3)

    def imu(self):
        return np.zeros(3), self.force


def turn(axis, angle):
    """Rotation (3, 3) by an angle [rad] about x, y or z."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    rotation = np.eye(3)
    rotation[[i, j, i, j], [i, j, j, i]] = (c, c, -s, s)
    return rotation


def parameters(**changes):
    """The file's parameters, with sections changed: parameters(gps={"noise_sd_m": 0})."""
    raw = msgspec.to_builtins(sensor_parameters())
    for section, values in changes.items():
        raw[section].update(values)
    return msgspec.convert(raw, SensorParameters)


def make_suite(seed=0, obstacles=(), disabled=frozenset(), p=None, faults=()):
    world = World(Flat(), tuple(obstacles), 0.7, ANCHOR, (0.0, 0.0, 0.0), SKY, tuple(faults))
    sight = Sight(world)
    sight.set_ground(np.zeros((360, 360)), -90.0, -90.0, 0.5)
    return SensorSuite(world, sight, seed, frozenset(disabled), p)


def run(suite, view, steps):
    """Messages with the step of their delivery, over `steps` further steps."""
    heard = []
    for _ in range(steps):
        heard += [(view.k, message) for message in suite.poll(view)]
        view.k += 1
    return heard


def of(heard, kind, sensor=None):
    messages = [m for _, m in heard if isinstance(m, kind)]
    return messages if sensor is None else [m for m in messages if m.sensor == sensor]


def floats(message):
    """All numbers of a message but its time."""
    values = [getattr(message, name) for name in message.__dataclass_fields__]
    return np.concatenate([np.ravel(v) for v in values[1:] if isinstance(v, float | np.ndarray)])


def wall(x, y, half=(0.1, 3.0, 2.0)):
    return Obstacle("wall", "car", "box", (x, y, half[2]), half)


def only(*kept):
    names = {*sensor_parameters().lidar.units, "sonar", "radar"}
    names |= {"gps", "imu", "compass", "odometry"}
    return names - set(kept)


# ---------------------------------------------------------------- schedule


@pytest.mark.parametrize(
    ("kind", "a_second", "delay_steps"),
    [(LidarScan, 150, 8), (SonarScan, 20, 8), (RadarTracks, 15, 20), (GpsFix, 20, 15),
     (ImuSample, 100, 1), (CompassHeading, 10, 6), (VehicleState, 50, 3)],
)  # fmt: skip
def test_rates_and_delays(kind, a_second, delay_steps):
    suite, view = make_suite(), FakeView()
    run(suite, view, SECOND)
    heard = [(k, m) for k, m in run(suite, view, SECOND) if isinstance(m, kind)]
    assert len(heard) == a_second
    lags = [k - m.time_ns * 300 / 1e9 for k, m in heard]
    assert lags == pytest.approx([delay_steps] * a_second, abs=1e-5)


def test_lidars_take_turns():
    first = {
        m.sensor: m.time_ns for m in reversed(of(run(make_suite(), FakeView(), 40), LidarScan))
    }
    assert len(set(first.values())) == 4


def test_order_within_a_step_is_fixed():
    order = [LidarScan, SonarScan, RadarTracks, GpsFix, ImuSample, CompassHeading, VehicleState]
    heard = run(make_suite(), FakeView(), SECOND)
    ranks = [(k, order.index(type(m))) for k, m in heard]
    assert ranks == sorted(ranks)
    assert len({k for k, _ in heard}) < len(heard)


def test_a_rate_that_does_not_divide_is_refused():
    with pytest.raises(ValueError, match="40"):
        make_suite(p=parameters(gps={"rate_hz": 40.0}))
    with pytest.raises(ValueError, match=r"delay_steps is -1"):
        schedule(parameters(imu={"delay_steps": -1}).imu)


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match=r"no sensor 'sodar'; known are lidar_bumper, .*odometry"):
        make_suite(disabled={"sodar"})
    with pytest.raises(msgspec.ValidationError, match=r"rate_herz.*\$\.gps"):
        parameters(gps={"rate_herz": 1.0})


# ---------------------------------------------------------------- randomness


def drive(seed, disabled=frozenset()):
    obstacles = [wall(12.0, 0.0), wall(0.0, 3.0, (6.0, 0.1, 2.0)), wall(0.0, -3.0, (6.0, 0.1, 2.0))]
    return run(make_suite(seed, obstacles, disabled), FakeView(2.0), SECOND)


def test_same_seed_same_bits():
    for (k, a), (other_k, b) in zip(drive(3), drive(3), strict=True):
        assert k == other_k
        np.testing.assert_array_equal(floats(a), floats(b))


def test_every_float_differs_between_seeds():
    for kind in (GpsFix, ImuSample, CompassHeading):
        a, b = (np.array([floats(m) for m in of(drive(seed), kind)]) for seed in (1, 2))
        assert (a != b).all(), kind
    a, b = (np.array([floats(m) for m in of(drive(seed), VehicleState)]) for seed in (1, 2))
    assert (a != b).any(axis=0).all()  # positions come in counts, which may be alike
    for kind, none in ((LidarScan, 81.92), (SonarScan, 4.0)):
        a, b = (np.array([floats(m) for m in of(drive(seed), kind)]) for seed in (1, 2))
        met = (a < none).any(axis=0) & (b < none).any(axis=0)
        assert met.sum() >= 4
        assert (a != b).any(axis=0)[met].all(), kind


def test_a_disabled_sensor_changes_no_other():
    suppressed = drive(3, {"gps", "lidar_roof", "sonar", "radar"})
    kept = [
        (k, m) for k, m in drive(3)
        if not isinstance(m, GpsFix | SonarScan | RadarTracks)
        and getattr(m, "sensor", "") != "lidar_roof"
    ]  # fmt: skip
    assert len(suppressed) == len(kept)
    for (_, a), (_, b) in zip(suppressed, kept, strict=True):
        np.testing.assert_array_equal(floats(a), floats(b))


def test_pickled_in_the_middle_goes_on_with_the_same_bits():
    suite, view = make_suite(5, [wall(12.0, 0.0)]), FakeView(2.0)
    run(suite, view, 157)
    again = pickle.loads(pickle.dumps((suite, view)))
    for (k, a), (other_k, b) in zip(run(suite, view, 200), run(*again, 200), strict=True):
        assert k == other_k
        np.testing.assert_array_equal(floats(a), floats(b))


def test_mounting_errors_are_small_and_rotations():
    p = sensor_parameters().mounting
    drawn = [draw_mounting(generator(seed, "x"), p) for seed in range(300)]
    offsets = np.array([m.offset_m for m in drawn])
    angles = [np.arccos((np.trace(m.rotation) - 1.0) / 2.0) for m in drawn]
    assert offsets.std() == pytest.approx(p.position_sd_m, rel=0.1)
    assert np.sqrt(np.mean(np.square(angles)) / 3.0) == pytest.approx(p.angle_sd_rad, rel=0.1)
    np.testing.assert_allclose(drawn[0].rotation @ drawn[0].rotation.T, np.eye(3), atol=1e-12)


# ---------------------------------------------------------------- lidar and sonar


def test_lidar_measures_a_wall_in_counts_with_the_measured_noise():
    p = parameters(mounting=EXACT, lidar={"bias_sd_m": 0.0})
    suite = make_suite(1, [wall(12.15, 0.0)], only("lidar_bumper"), p)
    scans = np.array([m.range_m for m in of(run(suite, FakeView(), 4000), LidarScan)])
    ahead = scans[:, 180]
    assert ahead.mean() == pytest.approx(10.0, abs=0.002)
    assert 0.005 < (scans[:, 170:191] - scans[:, 170:191].mean(axis=0)).std() < 0.006
    np.testing.assert_allclose(scans / 0.01, np.rint(scans / 0.01), atol=1e-9)
    assert (scans[:, 0] == 81.92).all()  # level, to the side: nothing there


def test_lidar_first_beam_looks_right():
    p = parameters(mounting=EXACT)
    suite = make_suite(1, [wall(2.0, -5.0, (1.0, 0.1, 2.0))], only("lidar_bumper"), p)
    scan = of(run(suite, FakeView(), 30), LidarScan)[0].range_m
    assert scan[0] == pytest.approx(4.9, abs=0.05)
    assert scan[-1] == 81.92


def test_lidar_bias_differs_from_unit_to_unit():
    suite = make_suite(1, [wall(12.15, 0.0)], only("lidar_bumper", "lidar_roof"))
    heard = run(suite, FakeView(), 2000)
    means = [
        np.mean([m.range_m[180] for m in of(heard, LidarScan, f"lidar_{n}")])
        for n in ("bumper", "roof")
    ]
    assert abs((means[0] + 2.05) - (means[1] + 1.3)) > 1e-3


def test_sonar_hears_walls_at_its_sides_and_not_the_plain():
    walls = [wall(0.0, 2.1, (6.0, 0.1, 2.0)), wall(0.0, -1.9, (6.0, 0.1, 2.0))]
    suite = make_suite(2, walls, only("sonar"), parameters(mounting=EXACT, sonar=ALONE))
    ranges = np.array([m.range_m for m in of(run(suite, FakeView(), 3000), SonarScan)])
    np.testing.assert_allclose(ranges[:, 2:6].mean(axis=0), [1.3, 1.3, 1.1, 1.1], atol=0.01)
    assert ranges[:, 2:6].std(axis=0) == pytest.approx([0.01] * 4, rel=0.25)
    assert (ranges[:, [0, 1, 6, 7]] == 4.0).all()


@pytest.mark.parametrize(("pitch", "echoes"), [(0.3, False), (0.8, True)])
def test_sonar_hears_the_ground_only_where_it_meets_it_steeply(pitch, echoes):
    suite = make_suite(2, [], only("sonar"), parameters(mounting=EXACT))
    view = FakeView(pitch=pitch)
    view.SITES = tuple((n, (p[0], p[1], p[2] + 2.5), y) for n, p, y in view.SITES)
    scan = of(run(suite, view, 30), SonarScan)[0]
    assert (scan.range_m[0] < 4.0) == echoes


# ---------------------------------------------------------------- radar


def post(x, y, name="post", kind="gate_post"):
    return Obstacle(name, kind, "cylinder", (x, y, 0.6), (0.075, 0.075, 0.6))


def tracks(obstacles, steps=40, seed=1, view=None, **more):
    """What the radar says in so many steps, as it drives at 5 m/s."""
    p = more.pop("p", parameters(mounting=EXACT))
    suite = make_suite(seed, obstacles, only("radar"), p, **more)
    return of(run(suite, view or FakeView(5.0), steps), RadarTracks)


class Running(FakeView):
    """Keeps its place while it goes at 5 m/s: wheels on rollers, as it were."""

    def __init__(self):
        super().__init__(0.0)

    def site_velocity(self, name):
        return np.array([5.0, 0.0, 0.0]), np.zeros(3)


def errors_of_tracks(steps=60 * SECOND):
    """Errors of a post's tracks: of range and rate as a share, of azimuth in [rad]."""
    said = tracks([wall(42.05, 1.0, (1.0, 0.075, 0.6))], steps, view=Running())
    far, bearing = np.hypot(39.0, 1.0), np.arctan2(1.0, 39.0)
    return (
        np.array([m.range_m[0] / far - 1.0 for m in said]),
        np.array([m.azimuth_rad[0] - bearing for m in said]),
        np.array([m.range_rate_mps[0] / (-5.0 * np.cos(bearing)) - 1.0 for m in said]),
    )


def test_radar_errors_stay_within_the_published_bounds_and_are_as_large_as_said():
    for error, bound in zip(errors_of_tracks(), (0.05, np.radians(0.2), 0.01), strict=True):
        rays = 1.5e-3  # the ray that met the post is not quite the one to its nearest point
        assert np.abs(error).max() < bound + rays
        assert error.std() == pytest.approx(bound / 3.0, rel=0.1)
        assert error.mean() == pytest.approx(0.0, abs=0.1 * bound + rays)


def test_radar_range_error_is_three_feet_where_that_is_more_than_a_share():
    near, far = (
        np.array([m.range_m[0] for m in tracks([wall(x, 0.0)], 9000, view=Running())])
        for x in (12.15, 62.15)
    )
    assert near.std() == pytest.approx(0.914 / 3.0, rel=0.12)
    assert far.std() == pytest.approx(0.05 * 60.0 / 3.0, rel=0.12)


def test_radar_left_is_positive_and_what_comes_nearer_has_a_negative_rate():
    left, right = tracks([post(30.0, 2.0)])[0], tracks([post(30.0, -2.0)])[0]
    assert left.azimuth_rad[0] == pytest.approx(np.arctan2(2.0, 27.9), abs=0.005)
    assert right.azimuth_rad[0] == pytest.approx(-np.arctan2(2.0, 27.9), abs=0.005)
    assert left.range_rate_mps[0] == pytest.approx(-5.0, rel=0.02)
    away = tracks([post(30.0, 0.0)], view=FakeView(-5.0))[0]
    assert away.range_rate_mps[0] == pytest.approx(5.0, rel=0.02)


def test_radar_tells_of_the_seven_nearest_things_the_nearest_first():
    posts = [post(15.0 + 1.5 * k, 0.15 * (k - 4), f"post{k}") for k in range(9)]
    said = tracks(posts, view=Running(), p=parameters(
        mounting=EXACT, radar={"range_error_m": 1e-6, "range_error_share": 0.0}
    ))[0]  # fmt: skip
    assert len(said.range_m) == len(said.azimuth_rad) == len(said.range_rate_mps) == 7
    expected = [12.95 + 1.5 * k - 0.075 for k in range(7)]
    np.testing.assert_allclose(said.range_m, expected, atol=0.08)


def test_a_car_is_one_track_at_its_nearest_point():
    said = tracks([wall(32.05, 0.0, (2.0, 0.9, 0.7))], view=Running())
    assert {len(m.range_m) for m in said} == {1}
    assert np.mean([m.range_m[0] for m in said]) == pytest.approx(28.0, abs=0.9)


@pytest.mark.parametrize("place", [(20.0, 3.0), (20.0, -3.0), (-20.0, 0.0), (130.0, 0.0)])
def test_nothing_outside_the_radars_view_is_a_track(place):
    assert all(len(m.range_m) == 0 for m in tracks([post(*place)], view=Running()))


@pytest.mark.parametrize("kind", ["rumble_strip", "brush"])
def test_radar_rejects_ground_and_what_lies_on_it_and_passes_brush(kind):
    thing = Obstacle("thing", kind, "box", (20.0, 0.0, 0.5), (1.0, 1.0, 0.5))
    assert all(len(m.range_m) == 0 for m in tracks([thing], view=FakeView(5.0, pitch=0.05)))


def test_a_post_hides_what_stands_right_behind_it():
    assert len(tracks([post(10.0, 0.0), post(30.0, 0.0, "behind")])[0].range_m) == 1


def test_a_doppler_radar_hears_nothing_at_a_stand():
    said = tracks([post(20.0, 0.0)], SECOND, view=FakeView(0.0))
    assert len(said) == 14
    assert all(len(m.range_m) == 0 for m in said)


def test_radar_is_the_same_for_a_seed_and_other_for_another():
    a, same, other = (tracks([post(20.0, 1.0)], SECOND, seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal([floats(m) for m in a], [floats(m) for m in same])
    assert (np.array([floats(m) for m in a]) != np.array([floats(m) for m in other])).all()


def test_a_radar_that_fails_is_silent_until_it_is_reset():
    fault = Fault("radar", "silent", recovers_s=0.5)
    suite, view = make_suite(1, [], only("radar"), None, [fault]), FakeView(5.0)
    assert run(suite, view, SECOND) == []
    suite.faults.reset(10**9, "radar")
    assert len(run(suite, view, SECOND)) > 5


# ---------------------------------------------------------------- gps


def errors_m(fixes, view_speed=0.0):
    x, y = to_world(ANCHOR, [f.latitude_deg for f in fixes], [f.longitude_deg for f in fixes])
    true_x = 0.6 + view_speed * np.array([f.time_ns for f in fixes]) / 1e9
    return np.stack([x - true_x, y], axis=1)


def test_gps_in_the_open_is_converged_and_within_ten_centimetres():
    p = parameters(mounting=EXACT)
    found = [
        of(run(make_suite(seed, (), only("gps"), p), FakeView(), 40), GpsFix)[-1]
        for seed in range(150)
    ]
    error = errors_m(found)
    assert {f.quality for f in found} == {GpsQuality.CONVERGED}
    assert {f.satellites for f in found} == {10}
    assert np.median(np.hypot(*error.T)) == pytest.approx(0.10, abs=0.02)
    assert np.mean([f.sd_m for f in found]) == pytest.approx(error.std(), rel=0.15)
    velocity = np.array([f.velocity_mps for f in found])
    assert velocity.std() == pytest.approx(0.03, rel=0.15)


def test_gps_error_wanders_slowly():
    fixes = of(run(make_suite(1, (), only("gps")), FakeView(), 20 * SECOND), GpsFix)
    steps = np.diff(errors_m(fixes), axis=0)
    assert steps.std() == pytest.approx(0.02 * np.sqrt(2.0), rel=0.25)


def tunnel(first, last):
    middle, half = 0.5 * (first + last), 0.5 * (last - first)
    return [
        wall(middle, 1.7, (half, 0.05, 1.5)), wall(middle, -1.7, (half, 0.05, 1.5)),
        Obstacle("roof", "tunnel", "box", (middle, 0.0, 3.05), (half, 1.75, 0.05)),
    ]  # fmt: skip


def test_gps_is_lost_in_a_tunnel_and_comes_back_worse():
    suite = make_suite(4, tunnel(15.0, 45.0), only("gps"))
    fixes = of(run(suite, FakeView(5.0), 14 * SECOND), GpsFix)
    at = np.array([0.6 + 5.0 * f.time_ns / 1e9 for f in fixes])
    quality = np.array([f.quality for f in fixes])
    assert (quality[at < 12.0] == GpsQuality.CONVERGED).all()
    inside = (at > 22.0) & (at < 38.0)
    assert (quality[inside] == GpsQuality.NONE).all()
    assert len({fixes[i].latitude_deg for i in np.flatnonzero(inside)}) == 1
    assert max(fixes[i].satellites for i in np.flatnonzero(inside)) < 4
    back = np.flatnonzero((at > 38.0) & (quality != GpsQuality.NONE))[0]
    assert 0.0 < at[back] - 40.0 < 5.0 * (1.0 + 0.5 + 1.5)
    assert quality[back] == GpsQuality.DIFFERENTIAL
    assert fixes[back].sd_m > 2.0 * fixes[0].sd_m


def test_gps_offset_after_an_outage_is_as_large_as_it_says():
    gone = []
    for seed in range(60):
        suite = make_suite(seed, tunnel(-3.0, 3.0), only("gps"))
        view = FakeView(10.0)
        fixes = of(run(suite, view, 2 * SECOND), GpsFix)
        last = [fixes[-1]]
        assert last[0].quality == GpsQuality.DIFFERENTIAL
        gone.append(errors_m(last, 10.0)[0])
    assert np.std(gone) == pytest.approx(0.31, rel=0.25)


def test_gps_starts_without_a_solution_where_there_is_no_sky():
    fixes = of(run(make_suite(0, tunnel(-20.0, 20.0), only("gps")), FakeView(), SECOND), GpsFix)
    assert {f.quality for f in fixes} == {GpsQuality.NONE}


def test_hdop():
    square = np.array(
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0, 0, 1]]
    )
    assert hdop(square) == pytest.approx(1.0)
    assert hdop(square[:3]) == np.inf


# ---------------------------------------------------------------- imu, compass, odometry


def test_imu_noise_and_signs():
    p = parameters(imu={"tilt_bias_max_rad": 0.0})
    samples = of(
        run(make_suite(1, (), only("imu"), p), FakeView(roll=0.2, pitch=-0.1), 3000), ImuSample
    )
    rate = np.array([m.angular_rate_radps for m in samples])
    force = np.array([m.acceleration_mps2 for m in samples])
    assert rate.std(axis=0) == pytest.approx([1.16e-3] * 3, rel=0.1)
    assert force.std(axis=0) == pytest.approx([0.05] * 3, rel=0.1)
    assert np.mean([m.roll_rad for m in samples]) == pytest.approx(0.2, abs=1e-3)
    assert np.mean([m.pitch_rad for m in samples]) == pytest.approx(-0.1, abs=1e-3)
    assert force.mean(axis=0)[0] == pytest.approx(9.81 * np.sin(0.1), abs=0.2)  # nose up


def test_left_side_up_is_positive_roll_and_nose_down_positive_pitch():
    for axis, lifted in ((0, (0.0, 1.0, 0.0)), (1, (-1.0, 0.0, 0.0))):
        rotation = turn(axis, 0.1)
        assert (rotation @ lifted)[2] > 0.0
        assert tilt_of(rotation[2])[axis] == pytest.approx(0.1)


def test_imu_biases_over_episodes():
    means = []
    for seed in range(60):
        m = of(run(make_suite(seed, (), only("imu")), FakeView(), 60), ImuSample)
        means.append(
            [np.mean([s.roll_rad for s in m]), *np.mean([s.acceleration_mps2 for s in m], axis=0)]
        )
    roll, *force = np.array(means).T
    assert np.abs(roll).max() < 0.0095
    assert roll.std() == pytest.approx(0.0087 / np.sqrt(3.0), rel=0.25)
    assert np.std(force[:2]) == pytest.approx(0.05, rel=0.25)


def test_acceleration_tilts_the_vertical_slowly():
    p = parameters(imu={"tilt_bias_max_rad": 0.0})
    view = FakeView()
    view.force = np.array([2.0, 0.0, 9.81])
    samples = of(run(make_suite(1, (), only("imu"), p), view, 6 * SECOND), ImuSample)
    apparent = -np.arctan2(2.0, 9.81)
    assert samples[-1].pitch_rad == pytest.approx(apparent * (1 - np.exp(-0.1)), abs=4e-3)


def test_compass_bias_noise_and_wrap():
    runs = [
        of(run(make_suite(seed, (), only("compass")), FakeView(yaw=1.0), 630), CompassHeading)
        for seed in range(60)
    ]
    headings = np.array([[m.heading_rad for m in heard] for heard in runs])
    assert (headings.mean(axis=1) - 1.0).std() == pytest.approx(0.026, rel=0.25)
    assert headings.std(axis=1).mean() == pytest.approx(0.0087, rel=0.1)
    south_west = of(
        run(make_suite(0, (), only("compass")), FakeView(yaw=np.pi), 3000), CompassHeading
    )
    assert all(-np.pi < m.heading_rad <= np.pi for m in south_west)


@pytest.mark.parametrize("speed", [5.0, -5.0, 0.0])
def test_odometry_is_unsigned_with_scale_and_noise(speed):
    states = of(run(make_suite(1, (), only("odometry")), FakeView(speed), 3000), VehicleState)
    wheels = np.array([m.wheel_speed_mps for m in states])
    assert (wheels >= 0.0).all()
    if speed:
        assert np.abs(wheels.mean(axis=0) / 5.0 - 1.0).max() < 0.02
        assert wheels.std(axis=0) == pytest.approx([0.02] * 6, rel=0.15)
        assert np.ptp(wheels.mean(axis=0)) > 0.01
    assert np.mean([m.steering_rad for m in states]) == pytest.approx(0.1, abs=0.008)
    assert np.std([m.throttle for m in states]) == pytest.approx(0.003, rel=0.2)
    assert {m.gear for m in states} == {Gear.LOW}
