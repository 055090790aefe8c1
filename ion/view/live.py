"""`ion drive --view`: a drive as a web page while it is driven."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread

from ion.job import Job
from ion.recorded import recorded
from ion.view.page import Page
from ion.view.server import announce, opened
from ion.view.show import Show
from ion.view.timeline import Timeline
from scenarios.episode import Episode
from scenarios.events import Events
from scenarios.true_states import TrueStates
from tape.reader import Packed
from tape.record import Record


class Live:
    """Watches a run, and hands what crosses the boundary to a page at once."""

    def __init__(self, show: Show) -> None:
        self._show, self._events, self._truth = show, Events(), TrueStates(self)

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take what this tick recorded."""
        for record in records:
            self.write(record)
        self._truth(episode, records)
        self._events(episode, records)
        if len(self._events.found) > len(self._show.recorded.events):
            found = tuple(self._events.found)
            self._show.recorded = replace(self._show.recorded, events=found)

    def write(self, record: Record) -> None:
        """Take one record."""
        kind = type(record.message)
        self._show.timeline.take(Packed(record.topic, record.delivery_ns, kind, record.payload))

    def ended(self, log: str | None) -> None:
        """The drive is over; with a tape, all can be asked of it that `ion view` can."""
        if log:
            self._show.recorded = recorded(Path(log))
        self._show.timeline.complete = True

    def stay(self) -> None:
        """Let people look until Ctrl-C."""
        with suppress(KeyboardInterrupt):  # it may come as soon as one has read this
            print("the page stays: Ctrl-C ends it", flush=True)
            Event().wait()
        print()


@contextmanager
def live(job: Job, seed: int, host: str, port: int | None) -> Iterator[Live]:
    """A page of a drive that is about to begin. It is drawn in a thread of its own, so that Ctrl-C
    reaches the drive.

    Raises:
        UsageError: the page cannot be opened.
    """
    told = job.recorded(seed)
    show = Show(told, Timeline(told.log))
    show.player.play(0.0)
    with opened(host, port) as server:
        page = Page(server, show, Path("runs/parameters"))
        announce(server)
        Thread(target=page.run, name="page", daemon=True).start()
        yield Live(show)
