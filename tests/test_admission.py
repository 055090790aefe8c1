"""The gate lets only good, fresh, forward messages through, and counts the others."""

from dataclasses import fields, replace

import numpy as np
import pytest
from arbitrary import messages
from hypothesis import given, settings
from hypothesis import strategies as st

from nav.admission import FUTURE_NS, MOST, Admission
from nav.messages import (
    CompassHeading,
    Floats,
    Gear,
    GpsFix,
    GpsQuality,
    ImuSample,
    LidarScan,
    RadarTracks,
    RoadEstimate,
    SonarScan,
    VehicleState,
    device,
)
from nav.parameters import parameters_from
from scenarios.parameter_files import parameter_texts

NOW, STALE_NS = 10_000_000_000, 500_000_000
VEHICLE = parameters_from(parameter_texts()).vehicle
LEVEL = [0, 0, 9.8]


def gate() -> Admission:
    return Admission(STALE_NS, VEHICLE)


def compass(time_ns: int = NOW, heading: float = 0.1) -> CompassHeading:
    return CompassHeading(time_ns, heading)


def scan(sensor: str, time_ns: int = NOW, beams: int = 361, range_m: float = 5.0) -> LidarScan:
    return LidarScan(time_ns, sensor, np.full(beams, range_m))


def imu(time_ns: int = NOW, rate=(0, 0, 0), pitch_rad: float = 0.0) -> ImuSample:
    return ImuSample(time_ns, rate, LEVEL, 0.0, pitch_rad)


GOOD = (
    scan("lidar_left", range_m=81.92),
    scan("lidar_right"),
    SonarScan(NOW, np.full(8, 4.0)),
    GpsFix(NOW, GpsQuality.CONVERGED, 9, -90.0, 180.0, 400.0, 0.1, np.zeros(3)),
    imu(),
    compass(),
    VehicleState(NOW, np.full(6, 12.0), -0.576, 1.0, 0.0, Gear.HIGH, False),
    RadarTracks(NOW, np.zeros(0), np.zeros(0), np.zeros(0)),
    RoadEstimate(NOW, 0.3, 0.0, 6.0, 1.0),
)


def test_good_messages_pass_in_order():
    one = gate()
    sent = [compass(NOW - 2), *GOOD]
    assert one.admit(NOW, sent) == sent
    assert one.dropped == {}


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        (compass(heading=float("nan")), "not finite"),
        (SonarScan(NOW, [1.0, float("inf"), *[4.0] * 6]), "not finite"),
        (imu(rate=[0, 0, float("nan")]), "not finite"),
        (imu(rate=[0, 0, -1e200]), "not finite"),
        (scan("lidar_left", range_m=float("nan")), "not finite"),
        (compass(heading=40.0), "out of range"),
        (imu(pitch_rad=1.57), "out of range"),
        (scan("lidar_left", range_m=-1e4), "out of range"),
        (scan("lidar_left", beams=181), "wrong shape"),
        (scan("lidar_left", beams=0), "wrong shape"),
        (LidarScan(NOW, "lidar_left", np.ones((361, 1))), "wrong shape"),
        (SonarScan(NOW, np.full(7, 4.0)), "wrong shape"),
        (imu(rate=[0, 0]), "wrong shape"),
        (RadarTracks(NOW, np.ones(2), np.ones(2), np.ones(3)), "wrong shape"),
        (RadarTracks(NOW, np.ones((1, 1)), np.ones((1, 1)), np.ones((1, 1))), "wrong shape"),
        (RadarTracks(NOW, np.float64(20.0), np.float64(0.1), np.float64(-5.0)), "wrong shape"),
        (compass(NOW - 600_000_000), "stale"),
        (compass(NOW + 60_000_000), "from the future"),
        (scan("lidar_of_another_truck"), "unknown scanner"),
    ],
)
def test_bad_messages_are_dropped_and_counted(message, reason):
    one = gate()
    assert one.admit(NOW, [message]) == []
    assert one.dropped == {reason: 1}


def test_time_going_backwards_is_dropped_per_source():
    one = gate()
    a, b = "lidar_left", "lidar_right"
    passed = one.admit(NOW, [scan(a), scan(b), scan(a), scan(b, NOW - 1)])
    assert [m.sensor for m in passed] == [a, b]
    assert one.dropped == {"backward": 2}


def test_nothing_passes_while_the_clock_is_behind():
    one = gate()
    one.admit(NOW, [])
    assert one.admit(NOW - 1, [compass(NOW - 1)]) == []
    assert one.dropped == {"clock went back": 1}
    assert len(one.admit(NOW, [compass(NOW - 1)])) == 1


calls = st.tuples(st.sampled_from([0, 20_000_000, 20_000_000, -30_000_000, 10**10]),
                  st.lists(messages | st.sampled_from([replace(m, time_ns=0) for m in GOOD]),
                           max_size=6))  # fmt: skip
LENGTH = {"lidar": 361, "sonar": 8, "gps": 3, "imu": 3, "odometry": 6}


def assert_good(message, now_ns):
    source = device(message)
    arrays = [getattr(message, f.name) for f in fields(message) if f.type is Floats]
    length = LENGTH.get(source.split("_")[0], arrays[0].size if arrays else 0)
    assert all(a.shape == (length,) for a in arrays)
    for f in fields(message):
        if f.type in (float, Floats):
            values = np.atleast_1d(getattr(message, f.name))
            assert np.isfinite(values).all()
            assert (np.abs(values) <= MOST[f.name]).all()
    assert -FUTURE_NS <= now_ns - message.time_ns <= STALE_NS
    assert not isinstance(message, LidarScan) or source in VEHICLE.lidar_mounts


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.lists(calls, max_size=8))
def test_whatever_passes_is_good_and_bars_nothing_that_is_good_and_newer(sequence):
    one, now_ns, newest_ns, sent = gate(), NOW, {}, 0
    for step_ns, given_ in sequence:
        now_ns += step_ns
        stamped = [replace(m, time_ns=now_ns + m.time_ns) for m in given_]
        passed = one.admit(now_ns, stamped)
        for message in passed:
            assert_good(message, now_ns)
            assert message.time_ns > newest_ns.get(device(message), -1)
            newest_ns[device(message)] = message.time_ns
        sent += len(stamped) - len(passed)
        order = [stamped.index(m) for m in passed]
        assert order == sorted(order)
    assert one.dropped == {} if sent == 0 else sum(one.dropped.values()) == sent
    later = max(one.now_ns, 0) + FUTURE_NS + 1
    fresh = [replace(m, time_ns=later) for m in GOOD]
    assert one.admit(later, fresh) == fresh
