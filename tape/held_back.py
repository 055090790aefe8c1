"""A tape that may not be wanted: records wait in memory until that is known."""

from collections.abc import Callable
from types import TracebackType
from typing import Self

from tape.record import Record
from tape.writer import TapeWriter

MOST = 30_000
"""Records that wait at most: half a minute of ION, three minutes of the point-mass simulator. A
longer drive goes to its file from then on."""


class HeldBack:
    """Opens the tape when it is wanted or grows long, or the drive breaks; a context manager.

    Writing a tape costs a quarter of a short drive, and of a thousand of them few are looked at.
    """

    def __init__(self, open_writer: Callable[[], TapeWriter], most: int = MOST) -> None:
        """`open_writer` makes the file; with `most` 0 it does so at once."""
        self._open, self._most = open_writer, most
        self._held: list[Record] = []
        self._writer: TapeWriter | None = None
        if most == 0:
            self.keep()

    def write(self, record: Record) -> None:
        """Take a record."""
        if self._writer:
            self._writer.write(record)
            return
        self._held.append(record)
        if len(self._held) > self._most:
            self.keep()

    def attach(self, name: str, data: str | bytes) -> None:
        """Attach a file to a tape that is kept."""
        if self._writer:
            self._writer.attach(name, data)

    def keep(self) -> None:
        """The tape is wanted: open it and write what waits.

        Raises:
            TapeError: it cannot be written.
        """
        if self._writer is None:
            self._writer = self._open()
            for record in self._held:
                self._writer.write(record)
            self._held = []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if kind is not None:
            self.keep()
        if self._writer:
            self._writer.close()
