"""One episode is a pure function of scenario, seed and parameters, and picklable in the middle."""

import pickle
import subprocess
import sys

import pytest

from scenarios.episode import Episode
from scenarios.nqe import build

SEED = 3
TICKS = 250
"""Five seconds: start-up, the first decisions, and driving off."""


def driven(ticks: int, seed: int = SEED) -> Episode:
    episode = Episode(build(seed), seed)
    for _ in range(ticks):
        episode.tick()
    return episode


def in_another_process(code: str, data: bytes = b"") -> str:
    done = subprocess.run([sys.executable, "-c", code], input=data, capture_output=True, check=True)
    return done.stdout.decode().strip()


@pytest.fixture(scope="module")
def digest() -> str:
    return driven(TICKS).digest.hex()


def test_same_seed_same_digest(digest):
    assert driven(TICKS).digest.hex() == digest


def test_other_seed_other_digest(digest):
    assert driven(TICKS, seed=SEED + 1).digest.hex() != digest


def test_same_digest_in_another_process(digest):
    code = (
        "from scenarios.episode import Episode; from scenarios.nqe import build\n"
        f"e = Episode(build({SEED}), {SEED})\n"
        f"for _ in range({TICKS}): e.tick()\n"
        "print(e.digest.hex())"
    )
    assert in_another_process(code) == digest


def test_pickled_in_the_middle_and_continued_in_another_process(digest):
    half = pickle.dumps(driven(TICKS // 2))
    code = (
        "import pickle, sys\n"
        "e = pickle.loads(sys.stdin.buffer.read())\n"
        f"for _ in range({TICKS - TICKS // 2}): e.tick()\n"
        "print(e.digest.hex())"
    )
    assert in_another_process(code, half) == digest


def test_pickle_is_small():
    assert len(pickle.dumps(driven(1))) < 6_000_000


def test_it_drives_off_within_five_seconds():
    episode = driven(TICKS)
    assert episode.truth.speed_mps > 0.5
    assert episode.decision is not None
    assert episode.outcome is None
