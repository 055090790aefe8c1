"""`ion falsify`: search, shrink, write, tell."""

import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from ion.code import code
from ion.falsify.drives import BrokenDriveError, Drives
from ion.falsify.options import Asked, Options, asked_of
from ion.falsify.picture import draw
from ion.falsify.samplers import SAMPLERS
from ion.falsify.search import Drive, Episode, search
from ion.falsify.shrink import Shrunk, shrunk
from ion.falsify.space import Point, usual
from ion.falsify.written import seeds_said, write
from ion.telling import Result
from scenarios.batch import workers
from scenarios.scenario_file import read_scenario

PASSED, FAILED, BROKE, INTERRUPTED = 0, 1, 3, 130
PICTURE = "search.png"


class Told(NamedTuple):
    """What a search came to."""

    episodes: list[Episode]
    small: Shrunk | None
    """The simplest failing case; None where nothing failed."""
    file: Path | None
    picture: Path

    @property
    def worst(self) -> Episode:
        """The lowest cost of the search."""
        return min(self.episodes, key=lambda episode: episode.cost)

    @property
    def failed(self) -> int:
        """How many drives of the search failed a verdict."""
        return sum(bool(episode.failed) for episode in self.episodes)


def falsify(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option, or the scenario's file, is wrong.
    """
    asked = asked_of(options)
    try:
        told = _searched(asked, options)
    except BrokenDriveError as error:
        print(f"ion: a drive broke: {error}", file=sys.stderr)
        return BROKE
    except KeyboardInterrupt:
        print("ion: interrupted; what was driven is kept: say it again", file=sys.stderr)
        return INTERRUPTED
    if options.json:
        print(json.dumps(summary(told)))
    else:
        _say(told, usual(asked.space.scenario))
    return FAILED if told.small else PASSED


def _searched(asked: Asked, options: Options) -> Told:
    with workers(options.jobs) as many, _bar() as bar:
        drive = Drives(asked.folder, code(), many)
        episodes = list(_episodes(asked, options, drive, bar))
        told = Told(episodes, None, None, asked.folder / PICTURE)
        draw(episodes, asked.space.varied, asked.space.scenario.title, told.picture)
        if not told.failed:
            return told
        bar.add_task("making it simple", total=None)
        return _made_simple(told, asked, options, drive)


def _made_simple(told: Told, asked: Asked, options: Options, drive: Drive) -> Told:
    """With the simplest case, written, read and driven once more."""
    known = usual(asked.space.scenario)
    small = shrunk(asked.space, drive, known, told.worst, options.shrink)
    file = write(asked.folder, asked.table, small, _how(options, told.episodes, small))
    _check(file, small, drive)
    return told._replace(small=small, file=file)


def _episodes(asked: Asked, options: Options, drive: Drive, bar: Progress) -> Iterator[Episode]:
    """Until the first that fails, or all."""
    space, seed = asked.space, options.search_seed
    budget = options.budget if space.varied else min(options.budget, len(space.seeds))
    sampler = SAMPLERS[options.sampler](len(space.varied), seed)
    task = bar.add_task(space.scenario.name, total=budget)
    for episode in search(space, sampler, drive, budget, seed, options.jobs):
        yield episode
        bar.advance(task)
        if episode.failed and not options.whole:
            return


def _check(file: Path, small: Shrunk, drive: Drive) -> None:
    """Drive what was written.

    Raises:
        BrokenDriveError: it does not fail as it should.
    """
    point = Point(read_scenario(file), {}, small.episode.point.seed)
    if small.figure not in Episode(point, drive([point])[0]).failed:
        raise BrokenDriveError(f"{file}: was to fail {small.figure}, and passes")


def _how(options: Options, episodes: Sequence[Episode], small: Shrunk) -> list[str]:
    return [
        f"Found in {len(episodes)} drives, and made simple in {small.drives}, by",
        options.command,
        f"Here {_reason(small)}.",
    ]


def _reason(small: Shrunk) -> str:
    """What the one verdict says."""
    verdicts = {v["figure"]: v for v in small.episode.result["verdicts"]}
    verdict = verdicts[small.figure]
    value = "not measured" if verdict["value"] is None else _short(verdict["value"])
    return f"{small.figure} is {value}, expected {verdict['expected']}"


def summary(told: Told) -> Result:
    """The object of `--json`; its values are those that drive the same again, to the bit."""
    small, best = told.small, told.small.episode if told.small else told.worst
    return {
        "episodes": len(told.episodes),
        "failed": told.failed,
        "best_cost": told.worst.cost,
        "least_clearance_m": min(e.result["clear_m"] for e in told.episodes),
        "figure": small.figure if small else None,
        "values": best.point.values,
        "seed": best.point.seed,
        "file": str(told.file) if told.file else None,
        "shrink_episodes": small.drives if small else 0,
        "picture": str(told.picture),
    }


def _say(told: Told, known: dict[str, Any]) -> None:
    console, small = Console(soft_wrap=True), told.small
    if small is None:
        point = told.worst.point
        print(f"nothing failed in {len(told.episodes)} drives; nearest to it was")
        console.print(_table(point, known))
    else:
        print(f"FAILED: {_reason(small)}")
        print(f"{told.failed} of {len(told.episodes)} drives; made simple in {small.drives} more:")
        console.print(_table(small.episode.point, known))
        print(*seeds_said(small))
        print(f"file: {told.file}")
        print(f"again: ion drive {told.file} --seed {small.episode.point.seed}")
    print(f"least clearance: {min(e.result['clear_m'] for e in told.episodes):.2f} m")
    print(f"picture: {told.picture}")


def _table(point: Point, known: dict[str, Any]) -> Table:
    """What is set, and how far that is from what is usual."""
    table = Table("", "here", "usually")
    for name, value in point.values.items():
        table.add_row(name, _short(value), _short(known[name]))
    table.add_row("seed", str(point.seed), "")
    return table


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _bar() -> Progress:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
               TimeRemainingColumn())  # fmt: skip
    return Progress(*columns, console=Console(stderr=True))
