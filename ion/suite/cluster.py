"""Drives on a Dask cluster: any number of machines, the same results.

Each worker drives in a process of its own, in which the processor is fixed before numpy loads,
however the worker was started. Dask gives what a dead worker had begun to another. Tapes and maps
travel home with the result.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from ion.code import code
from ion.errors import UsageError
from ion.suite.cases import Work
from ion.suite.remote import drive_apart
from ion.telling import Result
from scenarios.interrupts import interrupts

CONNECT_S = "10s"
ATTEMPTS = 5
"""So many workers may die under one drive before it is an error."""


def connected(address: str) -> Any:
    """A client of the scheduler.

    Raises:
        UsageError: nobody answers at the address, or dask.distributed is not installed.
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise UsageError("--cluster: needs pip install 'ion-twin[cluster]'") from error
    try:
        return Client(address, timeout=CONNECT_S)
    except (OSError, ValueError) as error:
        raise UsageError(f"--cluster {address}: no scheduler answers there") from error


def on_cluster(work: Work, numbers: Sequence[int], client: Any) -> Iterator[Result]:
    """As `scenarios.batch.many`, on the workers that a client knows; it is closed at the end."""
    from distributed import as_completed

    with client, interrupts() as caught:
        drive, here = partial(drive_apart, work, code=code()), list(numbers)
        futures = client.map(drive, here, pure=False, retries=ATTEMPTS)
        number = dict(zip((future.key for future in futures), here, strict=True))
        for future in as_completed(futures):
            if caught:
                client.cancel(futures)
                return
            yield _home(work.out, _result(future, number[future.key]))


def _result(future: Any, number: int) -> Result:
    if future.status == "finished":
        return future.result()
    error = future.exception()
    return {"seed": number, "outcome": "error", "message": f"{type(error).__name__}: {error}"}


def _home(out: Path, result: Result) -> Result:
    """Put down here what a drive left there."""
    for what, (name, data) in result.pop("files", {}).items():
        (out / name).write_bytes(data)
        result[what] = str(out / name)
    return result
