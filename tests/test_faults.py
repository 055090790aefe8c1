"""What fails, when, where, and what is heard of it then."""

from dataclasses import fields

import numpy as np
import pytest

from nav.messages import (
    LIDAR_NO_RETURN_M,
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
)
from tape.codec import encode
from twin.faults import Fault, Faults, parse

S = 10**9
KNOWN = ("gps", "imu", "lidar_roof", "brake", "gear")


def heading(t, rad=0.5):
    return CompassHeading(t * S, rad)


def test_a_fault_has_a_beginning_and_an_end():
    faults = Faults((Fault("gps", "silent", 2.0, 5.0),))
    heard = [not faults.silent(t * S, "gps") for t in (1, 2, 4, 5)]
    assert heard == [True, False, False, True]
    assert not faults.silent(3 * S, "imu")


def test_a_fault_has_a_place():
    faults = Faults((parse("gps silent 100m-110m", KNOWN),))
    heard = []
    for faults.way_m in (99.0, 100.0, 109.0, 110.0):
        heard.append(not faults.silent(S, "gps"))
    assert heard == [True, False, False, True]


def test_a_reset_helps_after_a_while():
    faults = Faults((Fault("gps", "silent", 2.0, recovers_s=3.0),))
    faults.reset(1 * S, "gps")  # before it fails, nothing can be mended
    assert faults.silent(6 * S, "gps")
    faults.reset(6 * S, "gps")
    faults.reset(8 * S, "gps")  # the first one is under way
    assert faults.silent(8 * S, "gps")
    assert not faults.silent(9 * S, "gps")


def test_some_faults_stay():
    faults = Faults((Fault("gps", "silent", 0.0),))
    faults.reset(1 * S, "gps")
    assert faults.silent(1000 * S, "gps")


@pytest.mark.parametrize("line", [
    "lidar_roof silent 120s", "gps offset by -5 120s-180s", "imu noisy by 0.3 800m-900m",
    "lidar_roof flapping by 2 1.5s recovers 90s", "gear frozen 10s",
])  # fmt: skip
def test_a_line_says_a_fault_and_a_fault_its_line(line):
    assert str(parse(line, KNOWN)) == line


@pytest.mark.parametrize(("line", "complaint"), [
    ("lidar_roof silent", "expected DEVICE KIND"),
    ("lidar_roof silent 120", "expected DEVICE KIND"),
    ("lidar_roof silent 10s-20m", "expected DEVICE KIND"),
    ("lidar silent 1s", "no device 'lidar' can fail here; known are gps, imu"),
    ("gps mute 1s", "no kind 'mute' of fault; known are silent, frozen"),
    ("gear noisy 1s", "no kind 'noisy' of fault; known are silent, frozen, late"),
    ("gps silent 9s-3s", "ends before it begins"),
    ("gps silent by 3 1s", "has no size"),
    ("gps late by -3 1s", "expected a number above 0"),
])  # fmt: skip
def test_a_wrong_line_is_refused(line, complaint):
    with pytest.raises(ValueError, match=complaint):
        parse(line, KNOWN)


def test_what_is_frozen_repeats_itself_with_new_times():
    faults = Faults((Fault("compass", "frozen", 2.0, 4.0),))
    heard = [faults.heard(t * S, "compass", heading(t, 0.1 * t)) for t in range(6)]
    assert [m.heading_rad for m in heard] == pytest.approx([0.0, 0.1, 0.1, 0.1, 0.4, 0.5])
    assert [m.time_ns for m in heard] == [t * S for t in range(6)]


def test_what_flaps_is_silent_half_of_the_time():
    faults = Faults((Fault("compass", "flapping", 4.0, size=4.0),))
    heard = [faults.heard(t * S, "compass", heading(t)) is not None for t in range(12)]
    assert heard == [True] * 4 + [False, False, True, True] * 2


def test_what_is_late_says_by_how_much():
    faults = Faults((Fault("gps", "late", 2.0, size=0.3), Fault("gps", "late", 3.0)))
    assert [faults.late_s(t * S, "gps") for t in (1, 2, 3)] == [0.0, 0.3, 1.0]


MESSAGES = [
    LidarScan(S, "lidar_roof", np.where(np.arange(361) % 2, 5.0, LIDAR_NO_RETURN_M)),
    SonarScan(S, np.array([1.0, 4.0, 2.0, 2.0, 4.0, 4.0, 3.0, 1.0])),
    RadarTracks(S, np.array([20.0, 30.0]), np.zeros(2), np.zeros(2)),
    GpsFix(S, GpsQuality.CONVERGED, 8, 34.0, -117.0, 0.0, 0.1, np.zeros(3)),
    ImuSample(S, np.zeros(3), np.array([0.0, 0.0, 9.81]), 0.0, 0.0),
    heading(1),
    VehicleState(S, np.full(6, 3.0), 0.0, 0.0, 0.0, Gear.HIGH, False),
    RoadEstimate(S, 0.0, 0.0, 4.0, 0.9),
]


@pytest.mark.parametrize("kind", ["noisy", "offset"])
@pytest.mark.parametrize("message", MESSAGES, ids=lambda m: type(m).__name__)
def test_every_sensor_can_be_noisy_and_wrong(message, kind):
    faults = Faults((Fault("it", kind),), seed=1)
    first, second = (faults.heard(t * S, "it", message) for t in (1, 2))
    assert encode(first) != encode(message)  # and the tape can hold it
    assert (encode(first) == encode(second)) is (kind == "offset")
    none = {LidarScan: LIDAR_NO_RETURN_M, SonarScan: 4.0}.get(type(message))
    for f in fields(message):
        if f.type is Floats and none:
            was, now = getattr(message, f.name), getattr(first, f.name)
            assert np.all(now[was >= none] == none)


def test_an_offset_is_as_large_as_said():
    faults = Faults((Fault("gps", "offset", size=10.0),))
    fix = faults.heard(S, "gps", MESSAGES[3])
    east = (fix.longitude_deg + 117.0) * 111_320 * np.cos(np.radians(34.0))
    assert (east, (fix.latitude_deg - 34.0) * 111_320) == pytest.approx((10.0, 10.0), rel=1e-3)


def test_a_fault_of_a_drive_stands_on_its_tape_and_is_driven_again(tmp_path):
    from ion.drive.options import Options, job_of

    lines = ("lidar_bumper silent 12s recovers 9s", "brake late by 0.2 30m")
    recorded = job_of(Options("dead_end", fault=lines, out=tmp_path)).recorded(3)
    assert recorded.command.endswith(f"--fault '{lines[0]}' --fault '{lines[1]}'")
    assert [str(f) for f in recorded.course().world.faults] == list(lines)
    assert recorded.log.stem.startswith("dead_end_lidar_bumper_silent")


def test_a_scenario_file_says_what_fails():
    from ion.courses import scenario_source

    faults = scenario_source("lidar_recovers").course(0).world.faults
    assert [str(f) for f in faults] == [
        "lidar_bumper silent 12s recovers 90s", "lidar_left silent 70m recovers 60s",
    ]  # fmt: skip


def test_a_pioneer_has_no_steering_to_fail():
    from ion.courses import scenario_source
    from scenarios.failing import failing

    course = scenario_source("small_robot").course(0)
    assert failing(course, ["lidar_deck noisy 5s"]).world.faults
    with pytest.raises(ValueError, match="no device 'steering' can fail here; known are lidar_de"):
        failing(course, ["steering frozen 5s"])
