"""Tapes survive a kill, stay small and cost little."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from nav.messages import (
    ActuatorTargets,
    CompassHeading,
    Decision,
    EgoEstimate,
    FollowPath,
    Gear,
    GpsFix,
    GpsQuality,
    ImuSample,
    LidarScan,
    ObstacleCells,
    SonarScan,
    VehicleState,
    lidar_range_m,
)
from tape.errors import TapeError
from tape.reader import attachments, metadata, read
from tape.record import record
from tape.view import View
from tape.writer import TapeWriter

NAMES = ("lidar_bumper", "lidar_roof", "lidar_left", "lidar_right")


class Mount(NamedTuple):
    """Where a scanner sits, as the vehicle's parameters have it."""

    position_m: tuple[float, float, float] = (1.0, 0.0, 0.5)
    yaw_rad: float = 0.0
    pitch_rad: float = 0.0
    roll_rad: float = 0.0


VIEW = View({name: Mount() for name in NAMES})
ANGLE_RAD = np.linspace(-np.pi / 2, np.pi / 2, 361)


def scan(rng, time_ns, name, x_m):
    """Walls 4 m to both sides that undulate, open ahead; noise of 5 mm, counts of 1 cm."""
    wall_m = (4 + np.sin(0.3 * x_m + 2 * ANGLE_RAD)) / np.maximum(np.abs(np.sin(ANGLE_RAD)), 1e-9)
    noisy_m = wall_m + rng.normal(0.0, 0.005, 361)
    counts = np.where(wall_m < 80, np.rint(noisy_m / 0.01), 8192).astype(np.uint16)
    return LidarScan(time_ns, name, lidar_range_m(counts))


def sensors(rng, step, now):
    if step % 8 < 4:
        yield scan(rng, now, NAMES[step % 8], 4.0 * now * 1e-9)
    if step % 3 == 0:
        yield ImuSample(now, rng.normal(size=3), rng.normal(size=3), *rng.normal(size=2))
    if step % 6 == 0:
        yield VehicleState(now, rng.normal(size=6), *rng.normal(size=3), Gear.HIGH, False)
    if step % 15 == 0:
        yield SonarScan(now, rng.uniform(0.3, 4.0, 8))
        place = (34.0 + rng.normal() * 1e-6, -117.0 + rng.normal() * 1e-6, 300.0)
        yield GpsFix(now, GpsQuality.CONVERGED, 9, *place, 0.1, rng.normal(size=3))
    if step % 30 == 0:
        yield CompassHeading(now, rng.normal())


def outputs(rng, step, now):
    if step % 6 == 0:
        yield ActuatorTargets(now, *rng.uniform(size=3), Gear.HIGH)
    if step % 30 == 0:
        yield FollowPath(now, rng.normal(size=(10, 2)), rng.uniform())
        yield EgoEstimate(now, rng.normal(size=2), *rng.normal(size=7))
        words = ("path_point_keeping", "start", "", step // 300)
        yield Decision(now, *words, *rng.normal(size=2), "real", *rng.uniform(size=5))
    if step % 300 == 0:
        yield ObstacleCells(now, rng.normal(size=(200, 2)), rng.uniform(size=200))


def drive(seconds, rng=None):
    """Records as four scanners and the rest make them: about 400 a second."""
    rng = rng or np.random.default_rng(0)
    for step in range(300 * seconds):
        now = step * 10**9 // 300
        for made in (*sensors(rng, step, now), *outputs(rng, step, now)):
            yield record(now, made)


def assert_same(one, two):
    assert [(r.topic, r.delivery_ns, r.payload) for r in one] == [
        (r.topic, r.delivery_ns, r.payload) for r in two
    ]


def write(path, records, **options):
    with TapeWriter(path, **options) as tape:
        for each in records:
            tape.write(each)


def test_what_was_written_is_read_in_order_with_its_attachments(tmp_path):
    path, records = tmp_path / "run.mcap", list(drive(2))
    files = {"scenario.toml": "course = 'nqe'\n", "world.bin": b"\x00\xff"}
    write(path, records, attachments=files, metadata={"seed": "7"}, view=VIEW)
    assert_same(read(path), records)
    assert attachments(path) == {"scenario.toml": b"course = 'nqe'\n", "world.bin": b"\x00\xff"}
    assert metadata(path) == {"seed": "7"}


def topics(path):
    return {r.topic for r in read(path)}


def test_light_leaves_out_the_scans_only(tmp_path):
    records = list(drive(1))
    write(tmp_path / "light.mcap", records, mode="light", view=VIEW)
    assert topics(tmp_path / "light.mcap") == {
        r.topic for r in records if not r.topic.startswith("/tape/lidar")
    }


def test_off_writes_no_file(tmp_path):
    write(tmp_path / "off.mcap", drive(1), mode="off", attachments={"a": "b"})
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_mode_is_refused(tmp_path):
    with pytest.raises(TapeError, match="'all' is unknown; known are full, inputs, light, off"):
        TapeWriter(tmp_path / "run.mcap", mode="all")


def test_a_file_that_cannot_be_written_is_said_at_once(tmp_path):
    with pytest.raises(TapeError, match=r"nowhere/run\.mcap: cannot be written"):
        TapeWriter(tmp_path / "nowhere" / "run.mcap")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full, as Linux has")
def test_a_full_disk_is_said():
    with pytest.raises(TapeError, match="/dev/full: cannot be written"):
        TapeWriter("/dev/full", {"a.toml": "x = 1"})


def test_an_exception_inside_leaves_a_whole_file(tmp_path):
    path, records = tmp_path / "run.mcap", list(drive(1))

    def interrupted():
        with TapeWriter(path) as tape:
            for each in records:
                tape.write(each)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert_same(read(path), records)


def test_two_writers_at_once_do_not_mix(tmp_path):
    records = list(drive(1))
    with TapeWriter(tmp_path / "a.mcap") as a, TapeWriter(tmp_path / "b.mcap") as b:
        for i, each in enumerate(records):
            (a if i % 2 else b).write(each)
    assert_same(read(tmp_path / "a.mcap"), records[1::2])
    assert_same(read(tmp_path / "b.mcap"), records[::2])


KILLED = """
import sys, time
sys.path[:0] = {paths!r}
from test_tape_writer import VIEW, drive
from tape.writer import TapeWriter
tape = TapeWriter({path!r}, mode={mode!r}, view=VIEW, attachments={{"seed": "0"}})
for each in drive(4):
    if each.delivery_ns > 3_600_000_000:
        print("ready", flush=True)
        time.sleep(60)
    tape.write(each)
"""


@pytest.mark.parametrize("mode", ["full", "inputs"])
def test_a_killed_writer_loses_at_most_the_last_second(mode, tmp_path):
    path = str(tmp_path / "run.mcap")
    here = Path(__file__).parent
    code = KILLED.format(paths=[str(here), str(here.parent)], path=path, mode=mode)
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as process:
        assert process.stdout.readline() == b"ready\n"
        os.kill(process.pid, signal.SIGKILL)
    survived = list(read(path))
    assert survived[-1].delivery_ns >= 2_600_000_000
    assert_same(survived, list(drive(4))[: len(survived)])
    assert attachments(path) == {"seed": b"0"}


@pytest.mark.parametrize(("mode", "limit_MB"), [("inputs", 80), ("full", 100)])
def test_an_nqe_of_17_minutes_fits(mode, limit_MB, tmp_path):
    path = tmp_path / "run.mcap"
    write(path, drive(10), mode=mode, view=VIEW)
    assert path.stat().st_size / 1e6 * 17 * 6 < limit_MB
