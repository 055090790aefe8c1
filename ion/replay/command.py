"""`ion replay`: the present navigator on recorded inputs, compared with what was recorded."""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from ion.errors import UsageError
from ion.replay.comparison import Shown, compare
from ion.replay.numbers import Result, numbers
from ion.replay.options import Options, check, picture_path, texts_of
from ion.replay.scans import check_scans
from ion.replay.table import platform, sentence, table
from nav.errors import NavError
from nav.parameters import ION
from scenarios.batch import many, stop_asked
from scenarios.replay import Tick, navigator_of, tolerance, unlike
from scenarios.replay import replay as replayed
from tape.errors import TapeError
from tape.reader import metadata, span_ns

IDENTICAL, DIFFERS, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130
Watch = Callable[[float], AbstractContextManager[Shown]]
"""Is given the time at which the tape ends, [s]."""


def replay(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option is wrong, or the one tape has nothing to replay.
        TapeError: the one tape is none, or damaged. Of many, such a tape has a line of its own.
    """
    check(options)
    work = Work(options)
    if len(options.logs) == 1:
        result = work.replay(options.logs[0], _bar)
        _tell(result, options.json)
        return _code([result])
    return _code(list(_many(work, options)))


@dataclass(frozen=True)
class Work:
    """What is done with a tape; can be sent to another process."""

    options: Options

    def replay(self, log: Path, watch: Watch) -> Result:
        """Replay one tape to its end, and draw what moved.

        Args:
            log: the tape.
            watch: gives, for the time from the first tick to the last, what is shown each.

        Raises:
            UsageError, TapeError: as `replay`.
        """
        end_s = span_ns(log)[1] * 1e-9
        check_scans(log)
        path = picture_path(log, self.options.out, self.options.json)
        instead = texts_of(self.options.parameters, metadata(log).get("vehicle", ION))
        ticks = replayed(log, navigator_of(log, instead))
        with watch(end_s) as shown:
            comparison = compare(ticks, tolerance(log), shown)
        if not comparison.ticks:
            raise UsageError(f"{log}: ends before the navigator's first targets")
        result = {"log": str(log), **numbers(comparison, unlike(log)), "picture": None}
        if path and comparison.first:
            from ion.replay.picture import draw
            from ion.style import png

            path.write_bytes(png(draw(comparison, f"{log.stem}: {sentence(result)}")))
            result["picture"] = str(path)
        return result

    def replay_in_worker(self, number: int) -> Result:
        """As `replay`, for `scenarios.batch`: what is wrong becomes a result."""
        log = self.options.logs[number]
        try:
            return self.replay(log, lambda _: nullcontext(_stop_when_asked))
        except (UsageError, NavError, TapeError) as error:
            return {"log": str(log), "outcome": "error", "message": str(error)}
        except KeyboardInterrupt:
            return {"log": str(log), "outcome": "interrupted"}


def _many(work: Work, options: Options) -> Iterator[Result]:
    numbers = range(len(options.logs))
    for done, result in enumerate(many(work.replay_in_worker, numbers, options.jobs), start=1):
        number = result.pop("seed", None)  # of one that never began, or whose process died
        log = {} if number is None else {"log": str(options.logs[number])}
        result = {"message": result.get("outcome"), **log, **result} if _failed(result) else result
        _tell(result, options.json)
        print(f"{done} of {len(options.logs)} tapes", file=sys.stderr)
        yield result


def _tell(result: Result, as_json: bool) -> None:
    if as_json:
        print(json.dumps(result, allow_nan=False), flush=True)
        return
    print(f"{result['log']}: {sentence(result)}")
    if not _failed(result):
        for line in filter(None, [platform(result)]):
            print(line)
        if result["fields"]:
            Console().print(table(result))
            print(f"picture: {result['picture']}")
    sys.stdout.flush()


def _failed(result: Result) -> bool:
    return "outcome" in result


def _code(results: list[Result]) -> int:
    outcomes = {result.get("outcome") for result in results}
    if "interrupted" in outcomes:
        return INTERRUPTED
    if "error" in outcomes:
        return BAD_INPUT
    return IDENTICAL if all(result["identical"] for result in results) else DIFFERS


@contextmanager
def _bar(end_s: float) -> Iterator[Shown]:
    """A bar on standard error."""
    columns = (TextColumn("replay"), BarColumn(), TextColumn("{task.completed:.0f} s"))
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task, seconds = progress.add_task("", total=end_s), 0

        def shown(tick: Tick) -> None:
            nonlocal seconds
            if tick.time_ns // 10**9 != seconds:
                seconds = tick.time_ns // 10**9
                progress.update(task, completed=seconds)

        yield shown


def _stop_when_asked(tick: Tick) -> None:
    del tick  # Unused.
    if stop_asked():
        raise KeyboardInterrupt
