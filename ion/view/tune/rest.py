"""Another process that drives the rest of a run under other terms, while people look."""

import multiprocessing
import signal
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

from ion.recorded import recorded
from nav.errors import NavError
from nav.parameters import parameters_from
from scenarios.processor import fix_processor
from scenarios.what_if import Progress, Snapshots, rest
from tape.errors import TapeError

TOLD_S = 2.0
"""From one word on how far the drive is to the next, of simulated time."""


class Task(NamedTuple):
    """From when on, and the parameter files to drive with, by name."""

    time_s: float
    files: tuple[tuple[str, str], ...]


class Told(NamedTuple):
    """Either how far the drive is on its way to the moment, or how it goes on from there."""

    reached_s: float
    went_on: tuple[Progress, ...] = ()
    trouble: str = ""


@dataclass
class RestOfRun:
    """Asked by the page; it ends with the page.

    Args:
        log: the tape.
    """

    log: Path
    task: Task | None = None
    """The one that is worked on, or was last."""
    told: list[Told] = field(default_factory=list)
    """Of that task."""
    _pipe: "Connection | None" = field(default=None, repr=False)

    def ask(self, task: Task) -> None:
        """Drop what is under way, and drive this."""
        if self._pipe is None:
            context = multiprocessing.get_context("spawn")
            self._pipe, theirs = context.Pipe()
            context.Process(target=_serve, args=(theirs, self.log), daemon=True).start()
            theirs.close()
        self.task, self.told = task, []
        self._pipe.send(task)

    def look(self) -> bool:
        """Take what has come; whether something has."""
        came = False
        try:
            while self._pipe and self._pipe.poll():
                task, told = self._pipe.recv()
                came = came or task == self.task
                self.told += [told] if task == self.task else []
        except (EOFError, OSError):
            self._pipe, came = None, self.task is not None
            self.told = [Told(0.0, trouble="its process has ended unexpectedly")]
        return came


class DroppedError(Exception):
    """Another task has come."""


def _serve(pipe: "Connection", log: Path) -> None:
    """In the other process: one task after the other, until the page is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    fix_processor()
    try:
        drive = recorded(log)
        snapshots = Snapshots(drive.episode)
        while True:
            task: Task = pipe.recv()
            try:
                _drive(pipe, task, snapshots, drive.said["vehicle"])
            except DroppedError:
                pass
            except (NavError, TapeError) as error:
                pipe.send((task, Told(0.0, trouble=str(error))))
    except (EOFError, OSError):
        pass


def _drive(pipe: "Connection", task: Task, snapshots: Snapshots, vehicle: str) -> None:
    p = parameters_from(dict(task.files), vehicle)
    told_s = -TOLD_S

    def passed(time_s: float) -> None:
        nonlocal told_s
        if time_s >= told_s + TOLD_S:
            told_s = time_s
            pipe.send((task, Told(time_s)))
            if pipe.poll():
                raise DroppedError

    episode = snapshots.at(task.time_s, passed)
    waiting: list[Progress] = []
    for progress in rest(episode, p.steering, p.speed):
        waiting.append(progress)
        if progress.outcome or progress.time_s >= waiting[0].time_s + TOLD_S:
            pipe.send((task, Told(progress.time_s, tuple(waiting))))
            waiting = []
            if pipe.poll():
                raise DroppedError
