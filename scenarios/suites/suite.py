"""A suite is a file that names scenarios and seeds, and says what else is asked of each.

    title = "What a change to the navigator must not break."
    [verdicts]                        # on every run
    departures = 0
    [[run]]
    scenario = "nqe"                  # a name, or the path of a file beside this one
    seeds = "0-9"
    [run.verdicts]                    # on this one
    min_clearance_m = { least = 0.3 }

A run may also have a name, and faults, ablate, options, time_limit_s and vary as a scenario's file.
With `each` it is several, of which every one puts other words into name and faults:

    [[run]]
    scenario = "nqe"
    each = { device = ["gps", "imu"], how = ["silent", "late"] }
    name = "{device}_{how}"
    faults = ["{device} {how} 60s"]
"""

import tomllib
from collections.abc import Callable
from importlib.resources import as_file, files
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import msgspec

from nav.errors import NavError
from scenarios.bounds import Expected
from scenarios.distribution import Varied
from scenarios.scenario_file import (
    ARRIVED,
    ScenarioFile,
    ScenarioFileError,
    built_in,
    checked,
    read_scenario,
)
from scenarios.seeds import listed
from scenarios.toml_place import PlacedError, converted, place

T = TypeVar("T")

SUFFIX = ".toml"


class SuiteError(ValueError):
    """A file that is no suite; says where, what, and what would be right."""


class Asked(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """One `[[run]]` of the file."""

    scenario: str
    seeds: str = "0"
    name: str = ""
    """The scenario's, if it is not said."""
    each: dict[str, tuple[str, ...]] = {}
    """A run for each choice of one word of every list."""
    options: dict[str, Any] = {}
    faults: tuple[str, ...] = ()
    ablate: tuple[str, ...] = ()
    time_limit_s: float | None = None
    vary: dict[str, Varied] = {}
    verdicts: dict[str, Expected] = {}


class File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """The whole file."""

    title: str
    run: tuple[Asked, ...]
    verdicts: dict[str, Expected] = {}


class Run(NamedTuple):
    """A scenario with what the suite adds to it, and its seeds."""

    scenario: ScenarioFile
    """Under the name of the run."""
    seeds: tuple[int, ...]


class Suite(NamedTuple):
    """A suite that was read and checked."""

    name: str
    title: str
    runs: tuple[Run, ...]


def suite_names() -> list[str]:
    """Those that come with ION."""
    names = (Path(f.name) for f in files("scenarios.suites").iterdir())
    return sorted(name.stem for name in names if name.suffix == SUFFIX)


def read_suite(name: str) -> Suite:
    """A suite by its name, or by the path of its file.

    Raises:
        SuiteError: there is none, or the file is none; one line that names the key, its line, and
            what would be right.
    """
    if name.endswith(SUFFIX):
        return _read(Path(name))
    if name not in suite_names():
        known = ", ".join(suite_names())
        raise SuiteError(f"suite {name!r} is unknown; there are {known}, or a file's path")
    with as_file(files("scenarios.suites") / f"{name}{SUFFIX}") as path:
        return _read(path)


def _read(path: Path) -> Suite:
    try:
        text = path.read_text(encoding="utf-8")
        table = tomllib.loads(text)
    except OSError as error:
        raise SuiteError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise SuiteError(f"{path}: not TOML: {error}") from error
    try:
        file = converted(table, File, ())
        runs = [_runs(k, file, path.parent) for k in range(len(file.run))]
        _names_differ(runs)
    except PlacedError as error:
        raise SuiteError(f"{path}: {place(text, error)}") from error
    return Suite(path.stem, file.title, tuple(run for each in runs for run in each))


def _runs(number: int, file: File, folder: Path) -> list[Run]:
    asked = _told(number, "each", lambda: _each(file.run[number]))
    return [_run(number, one, file.verdicts, folder) for one in asked]


def _each(asked: Asked) -> list[Asked]:
    """Its words put in; a name in braces that is no list of `each` is refused."""
    choices = [dict(zip(asked.each, words, strict=True)) for words in product(*asked.each.values())]
    return [
        msgspec.structs.replace(
            asked,
            name=_filled(asked.name, words),
            faults=tuple(_filled(fault, words) for fault in asked.faults),
        )
        for words in choices
    ]


def _filled(text: str, words: dict[str, str]) -> str:
    try:
        return text.format_map(words)
    except (KeyError, ValueError, IndexError) as error:
        known = ", ".join(f"{{{name}}}" for name in words) or "each"
        raise ValueError(f"{text!r}: expected only {known} in braces") from error


def _run(number: int, asked: Asked, common: dict[str, Expected], folder: Path) -> Run:
    scenario = _told(number, "scenario", lambda: _scenario(asked, folder))
    seeds = _told(number, "seeds", lambda: listed(asked.seeds))
    more = msgspec.structs.replace(
        scenario,
        name=asked.name or scenario.name,
        options=scenario.options | asked.options,
        faults=(*scenario.faults, *asked.faults),
        ablate=(*scenario.ablate, *asked.ablate),
        time_limit_s=asked.time_limit_s or scenario.time_limit_s,
        vary=scenario.vary | asked.vary,
        verdicts=(scenario.verdicts or ARRIVED) | common | asked.verdicts,
    )
    return Run(_told(number, "scenario", lambda: checked(more)), tuple(seeds))


def _scenario(asked: Asked, folder: Path) -> ScenarioFile:
    if asked.scenario.endswith(SUFFIX):
        return read_scenario(folder / asked.scenario)
    return built_in(asked.scenario)


def _told(number: int, key: str, do: Callable[[], T]) -> T:
    """What it gives; what it raises is told with its run and key."""
    try:
        return do()
    except PlacedError as error:
        raise PlacedError(("run", number, *error.path), str(error)) from error
    except (ScenarioFileError, NavError, ValueError) as error:
        raise PlacedError(("run", number, key), str(error)) from error


def _names_differ(runs: list[list[Run]]) -> None:
    seen: set[str] = set()
    for number, each in enumerate(runs):
        for run in each:
            name = run.scenario.name
            if name in seen:
                why = f"two runs are called {name!r}: name one of them"
                raise PlacedError(("run", number), why)
            seen.add(name)
