"""Many episodes, one process each; results come as they end, and none is lost."""

import gc
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from functools import partial
from multiprocessing import connection
from multiprocessing.synchronize import Event
from typing import Any

from scenarios.interrupts import interrupts
from scenarios.processor import fix_processor

Result = dict[str, Any]
Work = Callable[[int], Result]
"""Drives the episode of one seed; can be pickled."""
POLL_S = 0.5

_stop: Event | None = None


def many(work: Work, seeds: Sequence[int], jobs: int) -> Iterator[Result]:
    """Drive many seeds.

    Args:
        work: is called with a seed in another process; asks `stop_asked` now and then.
        seeds: in the order of starting.
        jobs: how many at a time.

    Yields:
        What `work` gives, in the order of ending; for one that raised or whose process died,
        `seed`, `outcome: error` and `message`. After Ctrl-C, `outcome: interrupted` for those
        never begun, and what the running ones give when they have stopped.
    """
    with workers(min(jobs, len(seeds))) as drive:
        yield from drive(work, seeds)


@contextmanager
def workers(jobs: int) -> Iterator[Callable[[Work, Sequence[int]], Iterator[Result]]]:
    """As `many`, for who has more to drive when the first have ended: the processes stay."""
    fix_processor()
    context = multiprocessing.get_context("spawn")
    stop = context.Event()
    pool = ProcessPoolExecutor(jobs, context, _begin, (stop,))
    try:
        yield partial(_drive, pool, stop)
    finally:
        stop.set()
        pool.shutdown(cancel_futures=True)


def _drive(
    pool: ProcessPoolExecutor, stop: Event, work: Work, seeds: Sequence[int]
) -> Iterator[Result]:
    with interrupts() as caught:
        pending = {pool.submit(_work, work, seed): seed for seed in seeds}
        while pending:
            if caught and not stop.is_set():
                stop.set()
                yield from _cancel(pending)
            yield from _ended(pending)


def stop_asked() -> bool:
    """In a worker: whether the user wants no more."""
    return _stop is not None and _stop.is_set()


def _begin(stop: Event) -> None:
    """In a worker: Ctrl-C reaches all processes of a terminal, but only the parent takes it."""
    global _stop
    _stop = stop
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _work(work: Work, seed: int) -> Result:
    """In a worker: what the first episode has loaded stays, and garbage is not looked for in it
    again: that took as long as a fifth of a short episode, every few of them."""
    result = work(seed)
    if not gc.get_freeze_count():
        gc.collect()
        gc.freeze()
    return result


def _end_with_parent() -> None:
    """In a worker: with a parent that was killed, nobody is left who would take the result."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    connection.wait([parent.sentinel])
    os._exit(1)


def _cancel(pending: "dict[Future[Result], int]") -> Iterator[Result]:
    for future in [future for future in pending if future.cancel()]:
        yield {"seed": pending.pop(future), "outcome": "interrupted"}


def _ended(pending: "dict[Future[Result], int]") -> Iterator[Result]:
    done, _ = wait(pending, timeout=POLL_S, return_when=FIRST_COMPLETED)
    for future in [future for future in pending if future in done]:
        yield _result(future, pending.pop(future))


def _result(future: "Future[Result]", seed: int) -> Result:
    if error := future.exception():
        message = f"{type(error).__name__}: {error}"
        return {"seed": seed, "outcome": "error", "message": message}
    return future.result()
