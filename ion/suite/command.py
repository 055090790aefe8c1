"""`ion suite`: drive, judge, tell."""

import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from ion.code import code
from ion.suite import junit
from ion.suite.baseline import Changes, changes, read
from ion.suite.cases import Case, Work, cases_of
from ion.suite.cluster import connected, on_cluster
from ion.suite.mutants import Hunt, caught_by
from ion.suite.options import Options, suite_of
from ion.suite.page import write_page
from ion.suite.results import Results, reasons
from ion.telling import Result, as_json
from scenarios.batch import many
from scenarios.suites import Suite

PASSED, FAILED, BROKE, INTERRUPTED = 0, 1, 3, 130


def suite(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option, or the suite's file, is wrong.
    """
    started, asked = time.perf_counter(), suite_of(options)
    then = read(options.baseline) if options.baseline else None
    folder, cases, present = options.out / asked.name, cases_of(asked), code()
    results = Results(folder, cases, present)
    _drive(asked, results, Work(cases, folder, options.log), options)
    found = [result for _, result in sorted(results.found.items())]
    if options.junit is not None:
        junit.write(options.junit, asked.name, found)
    if results.missing:
        print(f"ion: {len(results.missing)} drives are missing: say it again", file=sys.stderr)
        return INTERRUPTED
    told = summary(asked, results)
    moved = changes(found, then) if then is not None else None
    told |= told_of_changes(moved) if moved else {}
    told |= caught_by(Hunt(cases, folder, results, present), options) if options.mutants else {}
    told |= {"wall_time_s": time.perf_counter() - started}
    page = write_page(folder, asked, found, moved)
    print(as_json(told) if options.json else _words(told, moved, page))
    return _code(told, found, moved)


def _code(told: Result, found: Sequence[Result], moved: Changes | None) -> int:
    if any(result["outcome"] == "error" for result in found):
        return BROKE
    escaped = told.get("mutants", 0) - told.get("caught", 0)
    failed = moved.regressions if moved else told["failed"]
    return FAILED if failed or escaped else PASSED


def summary(asked: Suite, results: Results) -> Result:
    """The one object at the end of `--json`."""
    return {
        "summary": True,
        "suite": asked.name,
        "episodes": len(results.found),
        "failed": len(results.failures),
        "failures": [_failure(result) for result in results.failures],
    }


def _failure(result: Result) -> Result:
    return {key: result.get(key) for key in ("case", "seed", "failed", "command", "log")}


def told_of_changes(moved: Changes) -> Result:
    """For JSON: what was not so in the baseline."""
    return {
        "regressions": [verdict._asdict() for verdict in moved.regressions],
        "turned": [verdict._asdict() for verdict in moved.turned],
        "moved": [figure._asdict() for figure in moved.moved],
        "other_digests": moved.other,
    }


def _drive(asked: Suite, results: Results, work: Work, options: Options) -> None:
    """All cases that have no result yet, with a progress bar."""
    if not results.missing:
        return
    drives = _driven(work, results.missing, options)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
               TimeRemainingColumn())  # fmt: skip
    with Progress(*columns, console=Console(stderr=True)) as bar:
        total = len(work.cases)
        task = bar.add_task(asked.name, total=total, completed=len(results.found))
        for driven in drives:
            number = driven.pop("number", driven["seed"])
            again = {"command": _command(work.cases[number], options)}
            result = results.add(number, driven | again)
            print(as_json(result) if options.json else line(result), flush=True)
            bar.advance(task)


def _driven(work: Work, numbers: list[int], options: Options) -> Iterator[Result]:
    if options.cluster:
        return on_cluster(work, numbers, connected(options.cluster))
    return many(work, numbers, options.jobs)


def _command(case: Case, options: Options) -> str:
    """What one types to drive it again, tape and all."""
    return f"ion suite {options.suite} --run {case.scenario.name} --seeds {case.seed} --out again"


def line(result: Result) -> str:
    """One drive, for people."""
    if not result["failed"]:
        return f"passed  {result['case']}"
    return f"FAILED  {result['case']}: {'; '.join(reasons(result))}  {result.get('log') or ''}"


def _words(told: Result, moved: Changes | None, page: Path) -> str:
    lines = [f"{told['episodes'] - told['failed']} of {told['episodes']} drives passed"]
    lines += _changed(moved) if moved else []
    lines += _caught(told["caught_by"]) if "mutants" in told else []
    return "\n".join([*lines, f"report: {page}"])


def _changed(moved: Changes) -> list[str]:
    first = f"; the first: {moved.other[0]}" if moved.other else ""
    lines = [f"{len(moved.other)} drives went otherwise than in the baseline{first}"]
    for v in moved.turned:
        how = "passes now" if v.passes else "FAILS NOW"
        lines.append(f"{how}  {v.case}: {v.figure} {v.then} -> {v.now}")
    for f in moved.moved:
        lines.append(
            f"moved  {f.run}: {f.figure} {f.then:.4g} -> {f.now:.4g} "
            f"(difference {f.low:.3g} to {f.high:.3g}, {f.seeds} seeds)"
        )
    return lines


def _caught(caught_by: dict[str, Any]) -> list[str]:
    known = [
        f"caught  {name}: {by['case']}, {by['figure']} {by['value']}"
        for name, by in caught_by.items()
        if by
    ]
    free = [f"ESCAPED {name}" for name, by in caught_by.items() if not by]
    return [*known, *free, f"{len(known)} of {len(caught_by)} mutants caught"]
