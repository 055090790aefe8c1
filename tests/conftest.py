"""What all tests share: the processor's settings, made before numpy loads, as the command does;
Ctrl-C; and the tape of a short drive."""

import signal
from pathlib import Path

import pytest

from scenarios.processor import fix_processor

fix_processor()
signal.signal(signal.SIGINT, signal.default_int_handler)
"""Who runs the tests in the background has it ignored, and so would all that they start."""

SHORT_S = 17.0
"""Long enough for Obstacle Avoidance in the dead end."""


@pytest.fixture(scope="session")
def short_tape(tmp_path_factory):
    """The tape of ION's first seconds in the dead end; the drive was interrupted."""
    from ion.courses import scenario_source
    from ion.job import Job

    def stop(episode, records):
        if episode.time_s >= SHORT_S:
            raise KeyboardInterrupt

    job = Job(scenario_source("dead_end"), tmp_path_factory.mktemp("short"))
    return job.drive(0, [stop])["log"]


@pytest.fixture(scope="session")
def avoids_s(short_tape):
    """When Obstacle Avoidance begins on it, [s]."""
    from ion.recorded import recorded

    events = recorded(Path(short_tape)).events
    return next(event.time_s for event in events if "obstacle avoidance" in event.text)
