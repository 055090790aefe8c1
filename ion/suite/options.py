"""The arguments of `ion suite`, as typed; and what they mean, checked."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from tyro.conf import Positional, UseAppendAction, arg

from ion.drive.options import Log
from ion.errors import UsageError
from ion.out_file import check_folder
from ion.seeds import listed

if TYPE_CHECKING:
    from scenarios.suites import Suite


@dataclass(frozen=True)
class Options:
    """What one can ask of a suite."""

    suite: Annotated[Positional[str], arg(metavar="SUITE")]
    """Name of a suite, such as smoke, or the path of its file."""
    seeds: Annotated[str | None, arg(metavar="N-M")] = None
    """Instead of those that the suite names, for each of its runs."""
    run: Annotated[UseAppendAction[tuple[str, ...]], arg(metavar="NAME")] = ()
    """Only this run of the suite. May be said more than once."""
    jobs: Annotated[int, arg(metavar="N")] = 1
    """How many episodes at a time, one process each."""
    out: Annotated[Path, arg(metavar="FOLDER")] = Path("runs")
    """Results go into a folder there that has the suite's name. What stands in it and still holds
    is not driven again: a suite that was stopped goes on."""
    cluster: Annotated[str | None, arg(metavar="ADDRESS")] = None
    """Drive on the workers of a Dask cluster, such as tcp://127.0.0.1:8786, instead of here."""
    log: Annotated[Log, arg(metavar="full|inputs|light|off")] = "inputs"
    """What goes on the tapes of drives that fail; the others are not kept."""
    baseline: Annotated[Path | None, arg(metavar="FILE")] = None
    """Compare with the results of an earlier time: say which verdicts and figures moved; only what
    passed then and fails now makes the suite fail."""
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

    if options.mutants and options.cluster:
        raise UsageError("--mutants: expected no --cluster beside it: they are driven here")
    if options.jobs < 1:
        raise UsageError(f"--jobs {options.jobs}: expected 1 or more")
    try:
        suite = read_suite(options.suite)
    except SuiteError as error:
        raise UsageError(str(error)) from error
    check_folder(options.out / suite.name)
    if options.baseline is not None and not options.baseline.is_file():
        raise UsageError(f"--baseline {options.baseline}: expected a file such as results.jsonl")
    if options.junit is not None and not options.junit.parent.is_dir():
        raise UsageError(f"--junit {options.junit}: expected a file in a folder that exists")
    runs = {run.scenario.name: run for run in suite.runs}
    if unknown := [name for name in options.run if name not in runs]:
        raise UsageError(f"--run {unknown[0]}: unknown; there are {', '.join(runs)}")
    if options.run:
        suite = suite._replace(runs=tuple(runs[name] for name in dict.fromkeys(options.run)))
    if options.seeds is None:
        return suite
    seeds = tuple(listed(options.seeds, "--seeds"))
    return suite._replace(runs=tuple(run._replace(seeds=seeds) for run in suite.runs))
