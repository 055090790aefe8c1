"""The gate lets only finite, fresh, forward messages through, and counts the others."""

import numpy as np
import pytest

from nav.admission import Admission
from nav.messages import CompassHeading, ImuSample, LidarScan, RadarTracks, SonarScan

NOW = 10_000_000_000
SCANNERS = ("lidar_left", "lidar_right", "a", "b")


def compass(time_ns: int = NOW, heading: float = 0.1) -> CompassHeading:
    return CompassHeading(time_ns, heading)


def scan(sensor: str, time_ns: int = NOW) -> LidarScan:
    return LidarScan(time_ns, sensor, np.full(361, 5.0))


def test_good_messages_pass_in_order():
    gate = Admission(500_000_000, SCANNERS)
    messages = [compass(NOW - 2), scan("lidar_left"), scan("lidar_right"), compass(NOW)]
    assert list(gate.admit(NOW, messages)) == messages
    assert gate.dropped == {}


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        (compass(heading=float("nan")), "not finite"),
        (SonarScan(NOW, [1.0, float("inf")]), "not finite"),
        (ImuSample(NOW, [0, 0, float("nan")], [0, 0, 9.8], 0.0, 0.0), "not finite"),
        (compass(NOW - 600_000_000), "stale"),
        (compass(NOW + 60_000_000), "from the future"),
        (scan("lidar_of_another_truck"), "unknown scanner"),
        (RadarTracks(NOW, [20.0, 30.0], [0.1], [-5.0, -5.0]), "uneven"),
        (RadarTracks(NOW, [20.0], [0.1], []), "uneven"),
        (RadarTracks(NOW, [[20.0]], [[0.1]], [[-5.0]]), "uneven"),
        (RadarTracks(NOW, 20.0, 0.1, -5.0), "uneven"),
        (RadarTracks(NOW, [20.0], [float("nan")], [-5.0]), "not finite"),
    ],
)
def test_bad_messages_are_dropped_and_counted(message, reason):
    gate = Admission(500_000_000, SCANNERS)
    assert list(gate.admit(NOW, [message])) == []
    assert gate.dropped == {reason: 1}


def test_a_radar_may_have_no_track():
    empty = RadarTracks(NOW, [], [], [])
    assert Admission(500_000_000, SCANNERS).admit(NOW, [empty]) == [empty]


def test_time_going_backwards_is_dropped_per_source():
    gate = Admission(500_000_000, SCANNERS)
    passed = list(gate.admit(NOW, [scan("a"), scan("b"), scan("a"), scan("b", NOW - 1)]))
    assert [m.sensor for m in passed] == ["a", "b"]
    assert gate.dropped == {"backward": 2}
