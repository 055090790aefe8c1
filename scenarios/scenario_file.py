"""A scenario as a file of one's own: TOML, anywhere, driven by its path.

    title = "The qualification course on slick ground, without the roof scanner."
    course = "nqe"                    # a scenario that comes with ION, or route = "my.rddf"
    faults = ["lidar_roof silent 120s"]
    [vary]                            # drawn anew for each seed; see `scenarios.settings`
    "world.friction" = { uniform = [0.4, 0.6] }
    [verdicts]                        # see `scenarios.bounds`
    outcome = "finished"
    min_clearance_m = { least = 0.3 }

With a `route`, the file may place `things` along it, and leave out what the seed would draw there
(`roadside = false`, `bumps = 0.0`). With `course = "trial"` it holds the whole course, as those of
the trials do (`scenarios.trial.plan`).
"""

import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from importlib.resources import files
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from nav.errors import NavError
from nav.parameters import Parameters
from scenarios.ablation import disabled_sensors
from scenarios.bounds import Expected, Verdict, judged
from scenarios.course import Course
from scenarios.distribution import Number, Varied, draw, values_of
from scenarios.episode import Episode
from scenarios.failing import failing
from scenarios.figure_names import check_figure
from scenarios.planned import Thing
from scenarios.scenario import check_options, load_scenario, scenario_names
from scenarios.settings import begin, check
from scenarios.toml_place import PlacedError, converted, place
from scenarios.trial.course import course_of
from scenarios.trial.plan import Trial
from scenarios.vehicles import VEHICLES

T = TypeVar("T")

TRIAL = "trial"
COMMON = ("title", "course", "faults", "ablate", "time_limit_s", "vary", "verdicts")
"""What files of trials and others have alike ..."""
ALSO_TRIAL = ("title", "course", "time_limit_s")
"""... and what of it belongs to the course of a trial, too."""
ONLY_ROUTE = {"things": (), "roadside": True, "bumps": 1.0}
"""What only files with a route may change."""
ARRIVED: dict[str, Expected] = {"outcome": "finished"}
"""What is asked of a drive where a file asks nothing."""


class ScenarioFileError(ValueError):
    """A file that is no scenario; says where, what, and what would be right."""


class Said(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """What a file may say."""

    title: str
    """A sentence."""
    course: str = ""
    route: str = ""
    """A route definition file, beside this one."""
    first: int | None = msgspec.field(default=None, name="from")
    """Of the route: number of the waypoint where the drive begins ..."""
    last: int | None = msgspec.field(default=None, name="to")
    """... and where it ends."""
    options: dict[str, Any] = {}
    """What the course takes beyond the seed."""
    faults: tuple[str, ...] = ()
    """See `twin.faults.parse`."""
    ablate: tuple[str, ...] = ()
    """See `scenarios.ablation`."""
    time_limit_s: float | None = None
    """Instead of the course's own."""
    things: tuple[Thing, ...] = ()
    """Along a route, in metres east and north of its first waypoint."""
    roadside: bool = True
    """Of a route: whether the seed puts things beside the track, too."""
    bumps: float = 1.0
    """Of a route: factor on the height of its rolling ground."""
    vary: dict[str, Varied] = {}
    """By the names of `scenarios.settings`."""
    verdicts: dict[str, Expected] = {}
    """By the names of the figures."""


class ScenarioFile(Said, frozen=True):
    """A file that was read. It travels to other processes and machines with all that it needs."""

    name: str = ""
    """What results and tapes call it."""
    route_text: str = ""
    trial: Trial | None = None
    """With `course = "trial"`, all else that the file says."""

    def as_json(self) -> str:
        """For `from_json`, with all that it needs."""
        return msgspec.json.encode(self).decode()

    def failing(self, faults: Sequence[str], ablate: Sequence[str]) -> "ScenarioFile":
        """The same, and more fails."""
        return msgspec.structs.replace(
            self, faults=(*self.faults, *faults), ablate=(*self.ablate, *ablate)
        )

    def drawn(self, seed: int) -> dict[str, Number]:
        """What varies, as a seed has it."""
        return {name: draw(name, varied, seed) for name, varied in self.vary.items()}

    def drawn_course(self, seed: int) -> Course:
        """The course as a seed draws it.

        Raises:
            NavError: the route cannot be driven.
            ValueError: a line that is no fault.
        """
        course = failing(self._course(seed), self.faults)
        limit_s = self.time_limit_s or course.time_limit_s
        return replace(course, title=self.title, time_limit_s=limit_s)

    def _course(self, seed: int) -> Course:
        if self.trial:
            return course_of(self.name, self.trial, seed)
        if self.route:
            route = import_module("scenarios.route")
            given = route.Surroundings(self.things, self.roadside, self.bumps)
            return route.build(self.route_text, self.route, self.first, self.last, seed, given)
        return import_module(f"scenarios.{self.course}.course").build(seed, **self.options)

    def episode(self, seed: int, parameters: Parameters | None = None) -> Episode:
        """The drive at its start, with the navigator's own parameters or with others, in which what
        varies is set.

        Raises:
            NavError: a route or parameters that the navigator refuses.
        """
        return begin(self.drawn_course(seed), seed, self.ablate, self.drawn(seed), parameters)

    def judged(self, figures: Mapping[str, Any]) -> list[Verdict]:
        """The verdicts on a drive's figures."""
        return judged(figures, self.verdicts or ARRIVED)


def from_json(text: str) -> ScenarioFile:
    """What `as_json` wrote.

    Raises:
        msgspec.DecodeError: something else.
    """
    return msgspec.json.decode(text, type=ScenarioFile)


def built_in(name: str) -> ScenarioFile:
    """A scenario that comes with ION, as if it were a file.

    Raises:
        ScenarioFileError: there is none of this name.
    """
    if name not in scenario_names():
        known = ", ".join(scenario_names())
        raise ScenarioFileError(f"{name!r}: no scenario; there are {known}, or a file's path")
    text = (files("scenarios") / name / "scenario.toml").read_text(encoding="utf-8")
    said = {k: v for k, v in tomllib.loads(text).items() if k in ("vary", "verdicts")}
    told = msgspec.convert({"title": load_scenario(name).title, **said, "course": name}, Said)
    return _named(name, told)


def read_scenario(path: Path) -> ScenarioFile:
    """A file, checked.

    Raises:
        ScenarioFileError: it cannot be read, or is no scenario; one line that names the key, its
            line, and what would be right.
    """
    text = _text(path)
    try:
        scenario = checked(_converted(path, tomllib.loads(text)))
    except tomllib.TOMLDecodeError as error:
        raise ScenarioFileError(f"{path}: not TOML: {error}") from error
    except PlacedError as error:
        raise ScenarioFileError(f"{path}: {place(text, error)}") from error
    return scenario


def _converted(path: Path, table: dict[str, Any]) -> ScenarioFile:
    """Of a trial, what belongs to every scenario apart from what belongs to its course."""
    for key, kind in (("vary", Varied), ("verdicts", Expected)):
        for name, value in _table(table, key).items():
            converted(value, kind, (key, name))
    if table.get("course") != TRIAL:
        said = converted(table, Said, ())
        text = _route(path.parent / said.route) if said.route else ""
        return _named(path.stem, said, route_text=text)
    rest = {k: v for k, v in table.items() if k not in COMMON or k in ALSO_TRIAL}
    trial = converted(rest, Trial, ())
    said = converted({k: v for k, v in table.items() if k in COMMON}, Said, ())
    return _named(path.stem, said, trial=trial)


def _named(name: str, said: Said, **more: Any) -> ScenarioFile:
    return ScenarioFile(**msgspec.structs.asdict(said), name=name, **more)


def _table(table: dict[str, Any], key: str) -> dict[str, Any]:
    inner = table.get(key, {})
    if not isinstance(inner, dict):
        raise PlacedError((key,), f"expected a table, found {inner!r}")
    return inner


def _route(path: Path) -> str:
    try:
        return _text(path)
    except ScenarioFileError as error:
        raise PlacedError(("route",), str(error)) from error


def checked(scenario: ScenarioFile) -> ScenarioFile:
    """The scenario itself, if it can be driven and judged: what a type cannot say.

    Raises:
        PlacedError: it cannot; says which key is wrong.
    """
    if bool(scenario.course) == bool(scenario.route):
        raise PlacedError(
            ("course",) if scenario.course else ("title",), "expected a course or a route"
        )
    for key, usual in ONLY_ROUTE.items():
        if scenario.course and getattr(scenario, key) != usual:
            raise PlacedError((key,), "expected with a route only")
    if scenario.bumps < 0.0:
        raise PlacedError(("bumps",), f"expected 0 or more, found {scenario.bumps:g}")
    if scenario.course and scenario.course not in (*scenario_names(), TRIAL):
        known = ", ".join((*scenario_names(), TRIAL))
        raise PlacedError(("course",), f"{scenario.course!r} is unknown; there are {known}")
    vehicle = _try(("faults",), lambda: _course(scenario)).vehicle
    for name, expected in scenario.verdicts.items():
        _try(("verdicts", name), lambda n=name, e=expected: check_figure(n, e))
    for name, varied in scenario.vary.items():
        for value in values_of(varied):
            _try(("vary", name), lambda n=name, v=value: check(n, v, vehicle))
    silent = VEHICLES[vehicle]
    _try(("ablate",), lambda: disabled_sensors(scenario.ablate, silent.lidars, silent.radars))
    return scenario


def _course(scenario: ScenarioFile) -> Course:
    if scenario.course and scenario.course != TRIAL:
        _try(("options",), lambda: check_options(scenario.course, scenario.options))
    return scenario.drawn_course(0)


def _try(path: tuple[str, ...], do: Callable[[], T]) -> T:
    """What it gives; what it raises is told with its place."""
    try:
        return do()
    except PlacedError:
        raise
    except (ValueError, NavError) as error:
        raise PlacedError(path, str(error)) from error


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise ScenarioFileError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ScenarioFileError(f"{path}: no text") from error
