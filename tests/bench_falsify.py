"""Does the failure search find planted faults sooner than chance? `python tests/bench_falsify.py
[--jobs N] [--repeats N] [--budget N] [--out FOLDER] [FAULT ...]`.

Each fault of `tests/planted` is searched ten times by what `ion falsify` does and ten times at
random, each time with another seed of the search, until its first failed verdict. What the search
finds is shrunk, written, read and driven again. A line for each search as it ends, then a table:
medians, and how many shrunk cases still fail. All drives are kept: one that was stopped goes on
where it was. One to two hours on one core.
"""

import sys
import tomllib
from argparse import ArgumentParser
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from inspect import getsource
from itertools import product
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import planted
from planted import PLANTED, scenario_of

from ion.code import code
from ion.falsify.drives import Drives
from ion.falsify.samplers import SAMPLERS
from ion.falsify.search import Episode, search
from ion.falsify.shrink import shrunk
from ion.falsify.space import Point, Space, usual
from ion.falsify.written import write
from scenarios.batch import many
from scenarios.scenario_file import read_scenario

SEEDS = tuple(range(20))
SHRINK = 40


class Found(NamedTuple):
    """What one search came to."""

    fault: str
    sampler: str
    repeat: int
    episodes: int
    """Until the first that failed; one more than there were if none did."""
    shrink_drives: int = 0
    values: Any = None
    """Of the shrunk case."""
    still_fails: bool = False


@dataclass(frozen=True)
class Searches:
    """A search by its number, for `scenarios.batch`."""

    units: list[tuple[int, str, str]]
    """Repeat, fault and sampler."""
    budget: int
    out: Path

    def __call__(self, number: int) -> dict[str, Any]:
        repeat, fault, sampler = self.units[number]
        return {"found": found(fault, sampler, repeat, self.budget, self.out)}


def found(fault: str, sampler: str, repeat: int, budget: int, out: Path) -> Found:
    """Search for one fault, once."""
    space = Space(scenario_of(fault), SEEDS)
    folder = out / fault / f"{sampler}_{repeat}"
    folder.mkdir(parents=True, exist_ok=True)
    drives = Drives(folder, _code(), _one_by_one, PLANTED[fault])
    looks = SAMPLERS[sampler](len(space.varied), repeat)
    episodes = list(_until_failed(search(space, looks, drives, budget, repeat)))
    if not episodes[-1].failed:
        return Found(fault, sampler, repeat, budget + 1)
    told = Found(fault, sampler, repeat, len(episodes))
    return told if sampler == "random" else _shrunk(told, space, drives, episodes[-1])


def _shrunk(told: Found, space: Space, drives: Drives, episode: Episode) -> Found:
    small = shrunk(space, drives, usual(space.scenario), episode, SHRINK)
    table = tomllib.loads((planted.FOLDER / f"{told.fault}.toml").read_text(encoding="utf-8"))
    read = read_scenario(write(drives.path.parent, table, small, []))
    point = Point(read, {}, small.episode.point.seed)
    fails = small.figure in Episode(point, drives([point])[0]).failed
    values = {"verdict": small.figure, **small.episode.point.values}
    return told._replace(shrink_drives=small.drives, values=values, still_fails=fails)


def _until_failed(episodes: Iterator[Episode]) -> Iterator[Episode]:
    for episode in episodes:
        yield episode
        if episode.failed:
            return


def _one_by_one(work: Any, numbers: Any) -> Iterator[dict[str, Any]]:
    """Here, not in processes of their own: searches are what is done at the same time."""
    return (work(number) for number in numbers)


def _code() -> str:
    return sha256((code() + getsource(planted)).encode()).hexdigest()


def table(rows: list[Found]) -> Iterator[str]:
    """In Markdown."""
    yield "| fault | search, episodes | random, episodes | shrunk in | still fails |"
    yield "|---|---|---|---|---|"
    for fault in dict.fromkeys(row.fault for row in rows):
        mine = [r for r in rows if r.fault == fault and r.sampler != "random"]
        chance = [r.episodes for r in rows if r.fault == fault and r.sampler == "random"]
        drives = median(r.shrink_drives for r in mine)
        cells = (
            fault, median(r.episodes for r in mine), median(chance), drives,
            f"{sum(r.still_fails for r in mine)} of {len(mine)}",
        )  # fmt: skip
        yield "| " + " | ".join(str(cell) for cell in cells) + " |"


def main() -> None:
    """Search for all of them."""
    ask = ArgumentParser(description=__doc__)
    ask.add_argument("faults", nargs="*", default=list(PLANTED))
    ask.add_argument("--jobs", type=int, default=1)
    ask.add_argument("--repeats", type=int, default=10)
    ask.add_argument("--budget", type=int, default=150)
    ask.add_argument("--out", type=Path, default=Path("runs/bench_falsify"))
    asked = ask.parse_args()
    units = list(product(range(asked.repeats), asked.faults, SAMPLERS))
    work, rows = Searches(units, asked.budget, asked.out), list[Found]()
    for done in many(work, range(len(units)), asked.jobs):
        rows.append(done["found"])
        print(*rows[-1], file=sys.stderr, flush=True)
    print("\n".join(table(sorted(rows))))


if __name__ == "__main__":
    main()
