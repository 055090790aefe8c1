"""Another process that replays a tape and answers what was decided, and why, while people look."""

import multiprocessing
import signal
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

from ion.errors import UsageError
from ion.replay.scans import check_scans
from ion.view.decide.decisions import Decisions, Found
from nav.errors import NavError
from scenarios.processor import fix_processor
from tape.errors import TapeError

CALLS = 25
"""Calls of the navigator between two looks for a question."""
STEP_S = 5.0
"""From one word on how far the replay is to the next."""


class Question(NamedTuple):
    """What was decided at a time?"""

    time_s: float
    instead: tuple[tuple[str, str], ...] = ()
    """Names and texts of parameter files that are tried instead of those on the tape."""


class Reply(NamedTuple):
    """To a question; or, without one, how far the replay is."""

    question: Question | None
    found: Found | None
    trouble: str
    """Why there is no answer, or an empty word."""
    reached_s: float


@dataclass
class Worker:
    """Asked by the page. It ends with the page, however that ends: its pipe closes.

    Args:
        log: the tape.
    """

    log: Path
    reply: Reply | None = None
    """To the last question that was answered."""
    reached_s: float = 0.0
    """How far the replay is."""
    _asked: Question | None = None
    _pipe: "Connection | None" = field(default=None, repr=False)

    def start(self) -> None:
        """Begin to replay."""
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        context.Process(target=_serve, args=(theirs, self.log), daemon=True).start()
        theirs.close()

    def ask(self, question: Question) -> None:
        """Ask, unless that is asked already; what was asked before is forgotten."""
        if self._pipe and question != self._asked:
            self._asked = question
            self._pipe.send(question)

    @property
    def answered(self) -> bool:
        """Whether `reply` is to the last question."""
        return self.reply is not None and self.reply.question == self._asked

    def look(self) -> None:
        """Take the replies that have come."""
        try:
            while self._pipe and self._pipe.poll():
                self._take(self._pipe.recv())
        except (EOFError, OSError):
            self._pipe = None
            self.reply = Reply(None, None, "The replay of the tape has ended unexpectedly.", 0.0)

    def _take(self, reply: Reply) -> None:
        self.reached_s = reply.reached_s
        if reply.question is not None or reply.trouble:
            self.reply = reply


def _serve(pipe: "Connection", log: Path) -> None:
    """In the other process: answer at once, and replay on in between."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    fix_processor()
    try:
        check_scans(log)
        _answer_all(pipe, Decisions(log))
    except (NavError, TapeError, UsageError) as error:
        pipe.send(Reply(None, None, str(error), 0.0))
    except (EOFError, OSError):
        pass  # the page is gone


def _answer_all(pipe: "Connection", decisions: Decisions) -> None:
    question: Question | None = None
    more, told_s = True, 0.0
    while True:
        while pipe.poll() or (question is None and not more):
            question = pipe.recv()
        if question is not None and (not more or decisions.reached_s > question.time_s):
            pipe.send(_answer(decisions, question))
            question = None
        more = more and decisions.advance(CALLS)
        if decisions.reached_s > told_s + (STEP_S if more else 0.0):
            told_s = decisions.reached_s
            pipe.send(Reply(None, None, "", told_s))


def _answer(decisions: Decisions, question: Question) -> Reply:
    try:
        found, trouble = decisions.at(question.time_s, dict(question.instead)), ""
    except NavError as error:
        found, trouble = None, str(error)
    return Reply(question, found, trouble, decisions.reached_s)
