"""Batches and runs, tried with a small stand-in for an episode."""

import multiprocessing
import os
import pathlib
import signal
import time
from functools import partial

import pytest

from scenarios.batch import many, stop_asked
from scenarios.run import run
from scenarios.verdicts.judge import Judge


def square(seed):
    return {"seed": seed, "outcome": "finished", "square": seed * seed}


def fragile(seed):
    if seed == 1:
        raise ValueError("a wheel came off")
    if seed == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return square(seed)


def settings(seed):
    return {"seed": seed, "threads": os.environ.get("OPENBLAS_NUM_THREADS")}


def patient(folder, seed):
    (folder / f"{seed}").touch()
    end = time.monotonic() + 30.0
    while not stop_asked() and time.monotonic() < end:
        time.sleep(0.02)
    return {"seed": seed, "outcome": "interrupted" if stop_asked() else "timeout"}


class StandIn:
    """Ends by itself after five ticks."""

    def __init__(self):
        self.time_s, self.outcome, self.judge = 0.0, None, self

    def stop(self, word):
        self.outcome = self.outcome or word

    def tick(self):
        self.time_s += 0.02
        if self.time_s > 0.09:
            self.stop("finished")
        return [self.time_s]

    def figures(self):
        return {"outcome": self.outcome, "sim_time_s": self.time_s}


class Notes:
    """A writer that keeps what it is given."""

    def __init__(self):
        self.written = []

    def write(self, record):
        self.written.append(record)


def test_every_seed_gives_its_result():
    results = list(many(square, range(5), jobs=2))
    assert sorted(r["square"] for r in results) == [0, 1, 4, 9, 16]


def test_a_worker_that_raises_is_reported():
    results = {r["seed"]: r for r in many(fragile, [0, 1, 3], jobs=1)}
    assert results[1] == {
        "seed": 1,
        "outcome": "error",
        "message": "ValueError: a wheel came off",
    }
    assert results[0]["outcome"] == results[3]["outcome"] == "finished"


def test_a_worker_that_dies_is_reported():
    results = {r["seed"]: r for r in many(fragile, [2], jobs=1)}
    assert results[2]["outcome"] == "error"
    assert "terminated abruptly" in results[2]["message"]


def test_workers_inherit_the_processors_settings():
    assert next(iter(many(settings, [0], jobs=1)))["threads"] == "1"


def test_ctrl_c_stops_the_running_and_reports_all(tmp_path):
    results = []
    batch = many(partial(patient, tmp_path), range(6), jobs=2)
    before = signal.getsignal(signal.SIGALRM)
    signal.signal(signal.SIGALRM, lambda *_: os.kill(os.getpid(), signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 1.5)
    try:
        results = list(batch)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert sorted(r["seed"] for r in results) == list(range(6))
    assert {r["outcome"] for r in results} == {"interrupted"}


def test_a_run_goes_to_the_end_and_writes_everything():
    notes, watched = Notes(), []
    figures = run(StandIn(), notes, [lambda episode, records: watched.extend(records)])
    assert figures["outcome"] == "finished"
    assert len(notes.written) == len(watched) == 5
    assert figures["real_time_factor"] == pytest.approx(0.1 / figures["wall_time_s"])


def test_ctrl_c_ends_a_run_between_two_ticks():
    def interrupt(episode, records):
        if episode.time_s > 0.05:
            os.kill(os.getpid(), signal.SIGINT)

    notes = Notes()
    assert run(StandIn(), notes, [interrupt])["outcome"] == "interrupted"
    assert len(notes.written) == 3
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_watch_may_end_a_run():
    def enough(episode, records):
        raise KeyboardInterrupt

    assert run(StandIn(), None, [enough])["sim_time_s"] == 0.02


def test_a_verdict_stands_once_it_is_spoken():
    judge = Judge.__new__(Judge)
    judge.outcome = "contact"
    judge.stop("interrupted")
    assert judge.outcome == "contact"


def busy(folder, seed):
    (folder / str(os.getpid())).touch()
    time.sleep(30.0)
    return square(seed)


def batch_of_two(folder):
    list(many(partial(busy, folder), [0, 1], 2))


def test_workers_end_with_a_parent_that_was_killed(tmp_path):
    parent = multiprocessing.get_context("spawn").Process(target=batch_of_two, args=(tmp_path,))
    parent.start()
    while len(workers := list(tmp_path.iterdir())) < 2:
        time.sleep(0.05)
    parent.kill()
    deadline = time.monotonic() + 10.0
    while any(alive(int(path.name)) for path in workers):
        assert time.monotonic() < deadline
        time.sleep(0.05)


def alive(pid):
    try:
        state = pathlib.Path(f"/proc/{pid}/stat").read_text().split()[2]
    except FileNotFoundError:
        return False
    return state != "Z"
