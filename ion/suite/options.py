"""The arguments of `ion suite`, as typed; and what they mean, checked."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from tyro.conf import Positional, arg

from ion.errors import UsageError
from ion.options import Log, check_folder, listed

if TYPE_CHECKING:
    from scenarios.suites import Suite


@dataclass(frozen=True)
class Options:
    """What one can ask of a suite."""

    suite: Annotated[Positional[str], arg(metavar="SUITE")]
    """Name of a suite, such as smoke, or the path of its file."""
    seeds: Annotated[str | None, arg(metavar="N-M")] = None
    """Instead of those that the suite names, for each of its runs."""
    jobs: Annotated[int, arg(metavar="N")] = 1
    """How many episodes at a time, one process each."""
    out: Annotated[Path, arg(metavar="FOLDER")] = Path("runs")
    """Results go into a folder there that has the suite's name. What stands in it and still holds
    is not driven again: a suite that was stopped goes on."""
    log: Annotated[Log, arg(metavar="full|inputs|light|off")] = "inputs"
    """What goes on the tapes of drives that fail; the others are not kept."""
    mutants: bool = False
    """Then let broken navigators drive it, and say which verdict catches each."""
    junit: Annotated[Path | None, arg(metavar="FILE")] = None
    """Also write the verdicts as JUnit XML."""
    json: bool = False
    """One JSON object a line on standard output, the last of them about the whole suite."""


def suite_of(options: Options) -> "Suite":
    """The suite that the options describe; all that can be wrong is found before anything starts.

    Raises:
        UsageError: an option, or the suite's file, is wrong.
    """
    from scenarios.suites import SuiteError, read_suite

    if options.jobs < 1:
        raise UsageError(f"--jobs {options.jobs}: expected 1 or more")
    try:
        suite = read_suite(options.suite)
    except SuiteError as error:
        raise UsageError(str(error)) from error
    check_folder(options.out / suite.name)
    if options.junit is not None and not options.junit.parent.is_dir():
        raise UsageError(f"--junit {options.junit}: expected a file in a folder that exists")
    if options.seeds is None:
        return suite
    seeds = tuple(listed(options.seeds, "--seeds"))
    return suite._replace(runs=tuple(run._replace(seeds=seeds) for run in suite.runs))
