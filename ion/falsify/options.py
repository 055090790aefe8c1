"""The arguments of `ion falsify`, as typed; and what they mean, checked."""

import shlex
import tomllib
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple

from tyro.conf import Positional, arg

from ion.courses import SUFFIX, scenario_source
from ion.errors import UsageError
from ion.out_file import check_folder
from ion.seeds import listed

if TYPE_CHECKING:
    from ion.falsify.space import Space


@dataclass(frozen=True)
class Options:
    """Which scenario, and how long to look."""

    scenario: Annotated[Positional[str], arg(metavar="SCENARIO")]
    """Name of a scenario, or the path of its file; what its [vary] draws is searched."""
    budget: Annotated[int, arg(metavar="N")] = 100
    """How many drives the search may take."""
    seeds: Annotated[str, arg(metavar="N-M")] = "0-99"
    """The drives take turns with these."""
    whole: bool = False
    """Go on after the first failed verdict, use the whole budget, and take the worst."""
    shrink: Annotated[int, arg(metavar="N")] = 40
    """How many drives may go into making simple what was found; 0 leaves it as it is."""
    jobs: Annotated[int, arg(metavar="N")] = 1
    """How many drives at a time, one process each."""
    sampler: Annotated[Literal["model", "random"], arg(metavar="model|random")] = "model"
    """Look where a model of what is known says, or anywhere, for comparison."""
    search_seed: Annotated[int, arg(metavar="N")] = 0
    """Another search of the same; one is the same each time."""
    out: Annotated[Path, arg(metavar="FOLDER")] = Path("runs")
    """Results go into a folder there that has the scenario's name. What stands in it and still
    holds is not driven again: a search that was stopped goes on."""
    json: bool = False
    """One JSON object on standard output."""

    @property
    def command(self) -> str:
        """What one types to search the same again."""
        words = ["ion", "falsify", self.scenario, "--budget", str(self.budget)]
        words += ["--seeds", self.seeds, "--search-seed", str(self.search_seed)]
        words += ["--sampler", self.sampler, "--jobs", str(self.jobs)]
        return shlex.join(words + ["--whole"] * self.whole)


class Asked(NamedTuple):
    """What is searched."""

    space: "Space"
    table: dict[str, Any]
    """What the scenario's file says, or one that names the scenario would."""
    folder: Path
    """Where results go."""


def asked_of(options: Options) -> Asked:
    """What the options describe; all that can be wrong is found before anything starts.

    Raises:
        UsageError: an option, or the scenario's file, is wrong.
    """
    from ion.falsify.space import Space

    _check_numbers(options)
    seeds = tuple(listed(options.seeds, "--seeds"))
    scenario, table = _scenario(options.scenario)
    space = Space(scenario, seeds)
    if not space.varied and len(seeds) == 1:
        raise UsageError(
            f"{options.scenario}: nothing to search: expected a distribution in its [vary], "
            "or more seeds than one"
        )
    if space.varied and options.sampler == "model" and find_spec("sklearn") is None:
        raise UsageError("falsify: needs pip install 'ion-twin[search]'; or say --sampler random")
    folder = options.out / f"falsify_{scenario.name}"
    check_folder(folder)
    return Asked(space, table, folder)


def _check_numbers(options: Options) -> None:
    least = {"budget": 1, "jobs": 1, "shrink": 0, "search_seed": 0}
    for name, bound in least.items():
        if (value := getattr(options, name)) < bound:
            flag = name.replace("_", "-")
            raise UsageError(f"--{flag} {value}: expected {bound} or more")


def _scenario(name: str) -> tuple[Any, dict[str, Any]]:
    """As if it were a file, and what that says."""
    from scenarios.scenario_file import built_in

    source = scenario_source(name)
    if source.file is None:
        scenario = built_in(name)
        return scenario, {"title": scenario.title, "course": name}
    assert name.endswith(SUFFIX)
    return source.file, tomllib.loads(Path(name).read_text(encoding="utf-8"))
