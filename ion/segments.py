"""A long drive's log: a folder with the tape in segments, and the checkpoint to go on from."""

from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

from scenarios.checkpoint import CheckpointError, load, save

if TYPE_CHECKING:
    from ion.job import Job
    from ion.trace import Trace
    from scenarios.behaviour import Behaviour
    from scenarios.course import Course
    from scenarios.episode import Episode
    from scenarios.events import Events
    from tape.record import Record
    from tape.writer import TapeWriter

CHECKPOINT = "checkpoint.ion"
EVERY_M = 1500.0
"""Of way: less than a mile is lost when a drive is killed."""
LONG_M = 16_000.0
"""Courses longer than this, ten miles, are driven with checkpoints."""


def is_long(course: "Course") -> bool:
    """Whether a drive is worth checkpoints."""
    return float(np.hypot(*np.diff(course.waypoint_m, axis=0).T).sum()) > LONG_M


class Segments:
    """Writes a tape that goes on in a new file after each checkpoint; a context manager.

    Every segment says what the drive is, and can be read by itself.
    """

    def __init__(
        self, folder: Path, open_writer: Callable[[Path], "TapeWriter"], first: int = 0
    ) -> None:
        """Go on with segment `first`; those from there on are dropped."""
        self.folder, self._open, self.segment = folder, open_writer, first
        folder.mkdir(parents=True, exist_ok=True)
        for old in folder.glob("*.mcap"):
            if not old.stem.isdigit() or int(old.stem) >= first:
                old.unlink()
        self._writer = self._open(self._path())

    def write(self, record: "Record") -> None:
        """Take a record."""
        self._writer.write(record)

    def attach(self, name: str, data: str | bytes) -> None:
        """Attach a file to the present segment."""
        self._writer.attach(name, data)

    def keep(self) -> None:
        """It is kept in any case."""

    def next(self) -> None:
        """Close this segment and begin the next."""
        self._writer.close()
        self.segment += 1
        self._writer = self._open(self._path())

    def _path(self) -> Path:
        return self.folder / f"{self.segment:04d}.mcap"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._writer.close()


class Checkpoint(NamedTuple):
    """What a drive goes on from."""

    job: "Job"
    seed: int
    segment: int
    """The tape's next."""
    episode: "Episode"
    trace: "Trace"
    """What has been seen so far, for the map, ..."""
    events: "Events"
    """... what has happened, ..."""
    behaviour: "Behaviour"
    """... and how it was driven."""
    code: str
    """What it is driven by: `ion.code`."""


class Checkpoints:
    """Watches a run, after all other watches, and writes a checkpoint every so often."""

    def __init__(self, start: Checkpoint, segments: Segments) -> None:
        self._start, self._segments = start, segments
        self._due_m = start.episode.judge.movement.distance_m + EVERY_M

    def __call__(self, episode: "Episode", records: "Sequence[Record]") -> None:
        """See whether one is due."""
        del records  # Unused.
        way_m = episode.judge.movement.distance_m
        if way_m >= self._due_m and not episode.outcome:
            self._due_m = way_m + EVERY_M
            self._segments.next()
            state = self._start._replace(segment=self._segments.segment)
            save(self._segments.folder / CHECKPOINT, state)


def last_checkpoint(folder: Path) -> Checkpoint:
    """What a drive's folder can be gone on from.

    Raises:
        CheckpointError: it has none, or one that is not ours.
    """
    state = load(folder / CHECKPOINT)
    if not isinstance(state, Checkpoint):
        raise CheckpointError(f"{folder / CHECKPOINT}: no checkpoint of a drive")
    return state
