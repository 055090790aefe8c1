"""A long drive can be stopped, killed, and gone on with: the same bits as without a break."""

import json
import os
import pickle
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from test_cli import refused

from ion import segments
from ion.__main__ import main
from ion.courses import scenario_source
from ion.job import Job
from ion.segments import CHECKPOINT, last_checkpoint
from scenarios.checkpoint import MAGIC, CheckpointError, load, save
from tape.digest import Digest
from tape.errors import TapeError
from tape.reader import attachments, metadata, read, span_ns


@pytest.fixture(autouse=True)
def own_key(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


class Evil:
    """Does something as it is unpickled."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return os.mkdir, (str(self.path),)


def test_what_is_saved_is_loaded(tmp_path):
    save(tmp_path / "c", {"way": [1, 2.5]})
    assert load(tmp_path / "c") == {"way": [1, 2.5]}
    assert [p.name for p in tmp_path.iterdir() if p.is_file()] == ["c"]


def test_a_foreign_pickle_is_refused_unread(tmp_path, monkeypatch):
    path, trap = tmp_path / "c", tmp_path / "trap"
    path.write_bytes(pickle.dumps(Evil(trap)))
    with pytest.raises(CheckpointError, match="no checkpoint"):
        load(path)
    path.write_bytes(MAGIC + 32 * b"x" + pickle.dumps(Evil(trap)))
    with pytest.raises(CheckpointError, match="of another user"):
        load(path)
    save(path, Evil(trap))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "other"))
    with pytest.raises(CheckpointError, match="of another user"):
        load(path)
    assert not trap.exists()


def test_a_damaged_one_is_refused(tmp_path):
    path = tmp_path / "c"
    save(path, list(range(1000)))
    raw = bytearray(path.read_bytes())
    raw[-5] ^= 1
    path.write_bytes(raw)
    with pytest.raises(CheckpointError, match="damaged"):
        load(path)


def test_a_key_is_for_its_user_alone(tmp_path):
    save(tmp_path / "c", 1)
    key = tmp_path / "state" / "ion-twin" / "checkpoint.key"
    assert key.stat().st_mode & 0o077 == 0


@pytest.fixture
def short(monkeypatch):
    """A few hundred metres are a long drive."""
    monkeypatch.setattr(segments, "LONG_M", 100.0)
    monkeypatch.setattr(segments, "EVERY_M", 40.0)


def drive_until(job, way_m):
    """Drive, and be interrupted on the way."""

    def stop(episode, records):
        if way_m is not None and episode.judge.movement.distance_m > way_m:
            raise KeyboardInterrupt

    return job.drive(0, [stop])


def digest_of(tape):
    digest = Digest()
    for record in read(tape):
        digest.update(record)
    return digest.hex()


def test_going_on_gives_the_same_bits(short, tmp_path):
    source = scenario_source("gc05_route", {"first": 300, "last": 304})
    whole = drive_until(Job(source, tmp_path / "whole", "full"), None)
    broken = drive_until(Job(source, tmp_path / "broken", "full"), 110.0)
    assert broken["outcome"] == "interrupted"
    start = last_checkpoint(Path(broken["log"]))
    assert start.segment == 2
    ended = start.job.go_on(start)
    assert (ended["outcome"], whole["outcome"]) == ("finished", "finished")
    assert ended["digest"] == whole["digest"] == digest_of(ended["log"]) == digest_of(whole["log"])
    assert metadata(ended["log"])["scenario"] == "gc05_route"
    assert json.loads(attachments(ended["log"])["figures.json"])["digest"] == whole["digest"]
    assert span_ns(ended["log"]) == span_ns(whole["log"])


def test_what_came_after_the_checkpoint_is_dropped(short, tmp_path):
    source = scenario_source("gc05_route", {"first": 300, "last": 304})
    broken = drive_until(Job(source, tmp_path, "inputs"), 110.0)
    folder = Path(broken["log"])
    assert sorted(p.name for p in folder.iterdir()) == [
        "0000.mcap", "0001.mcap", "0002.mcap", CHECKPOINT,
    ]  # fmt: skip
    before = (folder / "0002.mcap").read_bytes()
    (folder / "0099.mcap").write_bytes(b"of an older drive")
    start = last_checkpoint(folder)
    start.job.go_on(start)
    assert not (folder / "0099.mcap").exists()
    assert (folder / "0002.mcap").read_bytes() != before


def test_resume_says_what_is_wrong(monkeypatch, capsys, tmp_path):
    assert "cannot be read" in refused(monkeypatch, capsys, "drive", "--resume", tmp_path)
    (tmp_path / CHECKPOINT).write_bytes(b"pickle")
    assert "no checkpoint" in refused(monkeypatch, capsys, "drive", "--resume", tmp_path)
    said = refused(monkeypatch, capsys, "drive", "nqe", "--resume", tmp_path)
    assert "nothing beside it" in said
    save(tmp_path / CHECKPOINT, {"job": 1})
    assert "no checkpoint of a drive" in refused(monkeypatch, capsys, "drive", "--resume", tmp_path)
    with pytest.raises(TapeError, match=r"expected segments 0000\.mcap"):
        metadata(tmp_path)


def test_other_code_does_not_go_on(short, monkeypatch, capsys, tmp_path):
    source = scenario_source("gc05_route", {"first": 300, "last": 304})
    folder = Path(drive_until(Job(source, tmp_path, "inputs"), 60.0)["log"])
    start = last_checkpoint(folder)
    save(folder / CHECKPOINT, start._replace(code="of yesterday"))
    assert "begun by other code" in refused(monkeypatch, capsys, "drive", "--resume", folder)


SHORT = "from ion import segments; segments.EVERY_M = 40.0; segments.LONG_M = 100.0;"
DRIVE = "from ion.__main__ import main; import sys; sys.argv = {}; main()"


@pytest.mark.slow
def test_a_killed_drive_goes_on(short, monkeypatch, capsys, tmp_path):
    arguments = ["ion", "drive", "gc05_route", "--from", "300", "--to", "304", "--out"]
    killed, whole = ([*arguments, str(tmp_path / name)] for name in ("killed", "whole"))
    process = subprocess.Popen([sys.executable, "-c", SHORT + DRIVE.format(killed)])
    folder = tmp_path / "killed" / "gc05_route_300_304_seed0"
    while not (folder / "0002.mcap").exists():
        assert process.poll() is None
        time.sleep(0.1)
    process.send_signal(signal.SIGKILL)
    process.wait()
    digests = []
    for words in (["ion", "drive", "--resume", str(folder), "--json"], [*whole, "--json"]):
        monkeypatch.setattr("sys.argv", words)
        with pytest.raises(SystemExit):
            main()
        digests.append(json.loads(capsys.readouterr().out)["digest"])
    assert digests[0] == digests[1]
