"""From a scenario's name, or a route file, to what a seed draws of it."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ion.errors import UsageError
from scenarios.scenario import scenario_names

if TYPE_CHECKING:
    from nav.parameters import Parameters
    from scenarios.course import Course
    from scenarios.episode import Episode
    from scenarios.scenario_file import ScenarioFile

SUFFIX = ".toml"
"""Of a scenario's file."""
SCENARIO_FILE = "scenario_file.json"
"""What a tape calls it, read and with all that it needs."""


@dataclass(frozen=True)
class Source:
    """Where a course comes from. Small, so that it travels to other processes."""

    scenario: str
    """Name of a scenario, empty for a route file."""
    route_text: str = ""
    route_name: str = ""
    first: int = 0
    """Waypoint number where the stretch of the route begins."""
    last: int = 0
    options: tuple[tuple[str, Any], ...] = ()
    """What the scenario was told beyond the seed: names and values."""
    faults: tuple[str, ...] = ()
    """What fails beyond the scenario's own, one line each."""
    file: "ScenarioFile | None" = None
    """A scenario of the user's own, and then no other."""

    @property
    def title(self) -> str:
        """For tables."""
        if self.file:
            return self.file.name
        return self.scenario or f"{Path(self.route_name).stem}_{self.first}-{self.last}"

    @property
    def name(self) -> str:
        """For files: two drives of different options have different ones."""
        words = (*(str(value) for _, value in self.options), *self.faults)
        return "_".join((self.title, *(re.sub(r"\W+", "_", word) for word in words)))

    @property
    def said(self) -> dict[str, str]:
        """All but the seed and the route's text, as short texts."""
        said = {"faults": "; ".join(self.faults)} if self.faults else {}
        if self.scenario or self.file:
            return said | {name: str(value) for name, value in self.options}
        return said | {"from": str(self.first), "to": str(self.last)}

    def course(self, seed: int) -> "Course":
        """The course as `seed` draws it.

        Raises:
            NavError: the route cannot be driven.
            ValueError: a line that is no fault.
        """
        from scenarios.failing import failing

        return failing(self._course(seed), self.faults)

    def episode(
        self, seed: int, ablate: tuple[str, ...], parameters: "Parameters | None" = None
    ) -> "Episode":
        """The drive at its start, with the navigator's own parameters or with others.

        Raises:
            NavError: a route or parameters that the navigator refuses.
            ValueError: a line that is no fault, or an unknown ablation.
        """
        from scenarios.episode import Episode

        if self.file:
            return self.file.failing(self.faults, ablate).episode(seed, parameters)
        return Episode(self.course(seed), seed, ablate, parameters)

    def _course(self, seed: int) -> "Course":
        if self.file:
            return self.file.drawn_course(seed)
        if self.scenario:
            course = import_module(f"scenarios.{self.scenario}.course")
            return course.build(seed, **dict(self.options))
        from scenarios.route import build

        return build(self.route_text, self.route_name, self.first, self.last, seed)


def scenario_source(name: str, options: Mapping[str, Any] | None = None) -> Source:
    """A scenario by its name, with options of its own, or by the path of its file.

    Raises:
        UsageError: there is none of this name; lists those that exist. Or an option that it does
            not take, or a value that it does not allow. Or the file is no scenario.
    """
    from scenarios.scenario import check_options

    if name.endswith(SUFFIX):
        return _file_source(Path(name), options or {})
    if name not in scenario_names():
        raise UsageError(f"scenario {name!r} is unknown; there are: {', '.join(scenario_names())}")
    given = dict(options or {})
    try:
        check_options(name, given)
    except ValueError as error:
        raise UsageError(str(error)) from error
    return Source(name, options=tuple(given.items()))


def _file_source(path: Path, options: Mapping[str, Any]) -> Source:
    from scenarios.scenario_file import ScenarioFileError, read_scenario

    if options:
        raise UsageError(f"--{next(iter(options))}: expected in the file, under [options]")
    try:
        return Source("", file=read_scenario(path))
    except ScenarioFileError as error:
        raise UsageError(str(error)) from error


def route_source(path: Path, first: int | None, last: int | None) -> Source:
    """A stretch of a route file, read and checked.

    Raises:
        UsageError: the file cannot be read or is no text.
        NavError: the file is no route, or has no such stretch.
    """
    from nav.route.rddf import parse

    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise UsageError(f"{path}: no route file: expected lines of text") from error
    route = parse(text, str(path))
    first = int(route.number[0]) if first is None else first
    last = int(route.number[-1]) if last is None else last
    route.stretch(first, last)
    return Source("", text, str(path), first, last)
