"""Ctrl-C that waits for a good moment."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def interrupts() -> Iterator[list[int]]:
    """Collects the first Ctrl-C in the list that it gives; the second strikes as always.

    Outside the main thread, and where Ctrl-C is ignored, the list stays empty.
    """
    caught: list[int] = []
    before = signal.getsignal(signal.SIGINT)

    def catch(number: int, frame: FrameType | None) -> None:
        del frame  # Unused.
        caught.append(number)
        signal.signal(signal.SIGINT, before)

    main = threading.current_thread() is threading.main_thread()
    if not main or before is signal.SIG_IGN:
        yield caught
        return
    signal.signal(signal.SIGINT, catch)
    try:
        yield caught
    finally:
        signal.signal(signal.SIGINT, before)
