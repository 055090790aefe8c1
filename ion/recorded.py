"""A drive as its tape tells it: its course, how it was judged, and what happened when."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ion.courses import SCENARIO_FILE, Source, scenario_names
from nav.parameters import parameters_from
from scenarios.events import Event
from scenarios.scenario_file import from_json
from tape.errors import TapeError
from tape.reader import attachments, metadata

if TYPE_CHECKING:
    from scenarios.course import Course
    from scenarios.episode import Episode

FIGURES, EVENTS = "figures.json", "events.json"
"""Attached to a tape when the drive has ended: a drive that was killed has none."""


@dataclass(frozen=True)
class Recorded:
    """What stands on a tape beside its messages."""

    log: Path
    said: dict[str, str]
    """Scenario, seed, ablations, vehicle, options, versions."""
    files: dict[str, str]
    """Attached: the route, the scenario, the navigator's parameters."""
    figures: dict[str, Any]
    """As `ion drive --json` gives them; empty for a drive that was killed."""
    events: tuple[Event, ...]

    @property
    def seed(self) -> int:
        """The seed of the drive."""
        return int(self.said["seed"])

    @property
    def command(self) -> str:
        """What one types to drive it again."""
        said, words = self.said, ["ion drive"]
        if SCENARIO_FILE in self.files:
            words += [f"{said['scenario']}.toml"]
        elif said["scenario"] in scenario_names():
            words += [said["scenario"], *(f"--{k} {said[k]}" for k in _options(said))]
        else:
            words += [f"--route ROUTE --from {said['from']} --to {said['to']}"]
        words += [f"--seed {said['seed']}", *(f"--fault '{line}'" for line in _faults(said))]
        return " ".join([*words, *([f"--ablate {said['ablate']}"] if said["ablate"] else [])])

    def course(self) -> "Course":
        """The course, drawn again.

        Raises:
            TapeError: its scenario is not known here.
        """
        try:
            return _source(self.said, self.files).course(self.seed)
        except (KeyError, ValueError) as error:
            raise TapeError(f"{self.log}: its course cannot be drawn: {error}") from error

    def episode(self) -> "Episode":
        """The drive, at its start again: same course, seed, ablations and parameters.

        Raises:
            TapeError: as `course`.
        """
        source = _source(self.said, self.files)
        parameters = parameters_from(self.files, self.said["vehicle"])
        return source.episode(self.seed, tuple(self.said["ablate"].split()), parameters)


def recorded(log: Path) -> Recorded:
    """Read what stands on a tape beside its messages.

    Raises:
        TapeError: no tape, or none that `ion drive` wrote.
    """
    said = metadata(log)
    files = {name: data.decode() for name, data in attachments(log).items()}
    if missing := [name for name in ("scenario", "seed", "vehicle") if name not in said]:
        raise TapeError(f"{log}: does not say its {missing[0]}; expected a tape of ion drive")
    figures = json.loads(files.pop(FIGURES, "{}"))
    rows = json.loads(files.pop(EVENTS, "[]"))
    return Recorded(log, said, files, figures, tuple(Event(**row) for row in rows))


def _source(said: dict[str, str], files: dict[str, str]) -> Source:
    name, faults = said["scenario"], _faults(said)
    if SCENARIO_FILE in files:
        return Source("", file=from_json(files[SCENARIO_FILE]), faults=faults)
    if name in scenario_names():
        return Source(name, options=tuple(_options(said).items()), faults=faults)
    route = next(iter(files))  # attached first
    return Source("", files[route], route, int(said["from"]), int(said["to"]), faults=faults)


def _faults(said: dict[str, str]) -> tuple[str, ...]:
    return tuple(line for line in said.get("faults", "").split("; ") if line)


def _options(said: dict[str, str]) -> dict[str, Any]:
    """Of the scenario, as it takes them."""
    from scenarios.scenario import load_scenario

    known = load_scenario(said["scenario"]).options
    given = {name: said[name] for name in known if name in said}
    return {k: v if known[k].choices else int(v) for k, v in given.items()}
