"""A suite on a Dask cluster of three workers, one of which is killed: the same results."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from test_cli import ion, refused
from test_suite import lines

TEXT = """\
title = "Short drives, one of which fails."
[[run]]
scenario = "sharp_turn"
seeds = "0-5"
time_limit_s = 10.0
[run.verdicts]
outcome = "timeout"
[[run]]
scenario = "sharp_turn"
name = "hopeless"
time_limit_s = 3.0
"""
DASK = Path(sys.executable).with_name("dask")


@pytest.fixture
def suite(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(TEXT)
    return path


def started(folder, *words):
    """A program of Dask's, in a group of its own, so that its children can be killed with it."""
    log = (folder / f"{words[0]}{len(list(folder.iterdir()))}.log").open("w")
    words = (DASK, *words, "--host", "127.0.0.1", "--no-dashboard")
    return subprocess.Popen(words, stdout=log, stderr=log, cwd=folder, start_new_session=True)


def killed(program):
    os.killpg(program.pid, signal.SIGKILL)
    program.wait()


@pytest.fixture
def cluster(tmp_path):
    """The file of a scheduler on a free port, and three workers."""
    pytest.importorskip("distributed")
    folder, file = tmp_path / "cluster", tmp_path / "scheduler.json"
    folder.mkdir()
    programs = [started(folder, "scheduler", "--port", "0", "--scheduler-file", str(file))]
    while not file.exists():
        assert programs[0].poll() is None
        time.sleep(0.2)
    worker = ("worker", "--scheduler-file", str(file), "--nthreads", "1")
    programs += [started(folder, *worker) for _ in range(3)]
    yield file, programs
    for program in programs:
        if program.poll() is None:
            killed(program)


@pytest.mark.slow
def test_a_worker_that_dies_loses_nothing(cluster, suite, tmp_path, monkeypatch, capsys):
    import json

    from distributed import Client

    file, (_, doomed, *_) = cluster
    address = json.loads(file.read_text())["address"]
    with Client(address) as client:
        client.wait_for_workers(3, timeout=60)
    here = ("suite", suite, "--out", tmp_path / "here", "--json")
    *drives, _ = lines(ion(monkeypatch, capsys, *here)[1])

    killer = subprocess.Popen(
        [sys.executable, "-c", f"import os, time; time.sleep(12); os.killpg({doomed.pid}, 9)"]
    )
    there = ("suite", suite, "--out", tmp_path / "there", "--json", "--cluster", address)
    *far, told = lines(ion(monkeypatch, capsys, *there)[1])
    killer.wait()
    assert doomed.wait() == -signal.SIGKILL
    assert (told["episodes"], told["failed"]) == (7, 1)
    assert {d["case"]: d["digest"] for d in far} == {d["case"]: d["digest"] for d in drives}
    log = Path(told["failures"][0]["log"])
    assert log.parent == tmp_path / "there" / "mine"
    assert log.read_bytes()


def test_nobody_answers(suite, tmp_path, monkeypatch, capsys):
    pytest.importorskip("distributed")
    monkeypatch.setattr("ion.suite.cluster.CONNECT_S", "1s")
    words = ("suite", suite, "--out", tmp_path, "--cluster", "tcp://127.0.0.1:9")
    assert "no scheduler answers" in refused(monkeypatch, capsys, *words)
    words = ("suite", suite, "--out", tmp_path, "--cluster", "nowhere")
    assert "no scheduler answers" in refused(monkeypatch, capsys, *words)
