"""Topics: one for each type, one for each scanner."""

import pytest

from nav.messages import MESSAGE_TYPES, CompassHeading, GpsFix, GpsQuality, LidarScan
from tape.codec import encode
from tape.record import record, topic


def test_a_record_keeps_both_times_and_the_bytes():
    heading = CompassHeading(100, 0.5)
    made = record(130, heading)
    assert (made.topic, made.delivery_ns) == ("/tape/compass_heading", 130)
    assert made.message is heading
    assert made.payload == encode(heading)


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        (LidarScan(0, "lidar_bumper", [1.0]), "/tape/lidar_bumper"),
        (GpsFix(0, GpsQuality.NONE, 0, 0.0, 0.0, 0.0, 0.0, [0.0] * 3), "/tape/gps_fix"),
    ],
)
def test_topics(message, expected):
    assert topic(message) == expected


def test_no_two_types_share_a_topic():
    names = {topic(kind.__new__(kind)) for kind in MESSAGE_TYPES if kind is not LidarScan}
    assert len(names) == len(MESSAGE_TYPES) - 1
