"""`ion suite`: drive, judge, tell."""

import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from ion.suite import junit
from ion.suite.cases import Work, cases_of, code
from ion.suite.mutants import Hunt, told_of
from ion.suite.options import Options, suite_of
from ion.suite.results import Result, Results
from ion.telling import as_json, verdict
from scenarios.batch import many
from scenarios.suites import Suite

PASSED, FAILED, INTERRUPTED = 0, 1, 130


def suite(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option, or the suite's file, is wrong.
    """
    started, asked = time.perf_counter(), suite_of(options)
    folder, cases, present = options.out / asked.name, cases_of(asked), code()
    results = Results(folder, cases, present)
    _drive(asked, results, Work(cases, folder, options.log), options)
    if options.junit is not None:
        junit.write(options.junit, asked.name, list(results.found.values()))
    if results.missing:
        print(f"ion: {len(results.missing)} drives are missing: say it again", file=sys.stderr)
        return INTERRUPTED
    told = summary(asked, results)
    caught: dict[str, Any] = {}
    if options.mutants:
        caught = told_of(Hunt(cases, folder, results, present), options.jobs)
    told |= {"wall_time_s": time.perf_counter() - started} | caught
    print(as_json(told) if options.json else _words(told, results.path))
    escaped = told.get("mutants", 0) - told.get("caught", 0)
    return FAILED if told["failed"] or escaped else PASSED


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


def _drive(asked: Suite, results: Results, work: Work, options: Options) -> None:
    """All cases that have no result yet, with a progress bar."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
               TimeRemainingColumn())  # fmt: skip
    with Progress(*columns, console=Console(stderr=True)) as bar:
        total = len(work.cases)
        task = bar.add_task(asked.name, total=total, completed=len(results.found))
        for driven in many(work, results.missing, options.jobs) if results.missing else ():
            number = driven.pop("number", driven["seed"])
            result = results.add(number, driven | {"command": _command(work, number)})
            print(as_json(result) if options.json else line(result), flush=True)
            bar.advance(task)


def _command(work: Work, number: int) -> str:
    """What one types to drive it again: the scenario as it was driven lies on the tape."""
    case = work.cases[number]
    name = case.scenario.name
    again = name if name == case.scenario.course else f"{name}.toml"
    return f"ion drive {again} --seed {case.seed}"


def line(result: Result) -> str:
    """One drive, for people."""
    if not result["failed"]:
        return f"passed  {result['case']}"
    broken = [verdict(v) for v in result.get("verdicts", ()) if not v["passed"]]
    why = "; ".join(broken) or result.get("message", result["outcome"])
    return f"FAILED  {result['case']}: {why}  {result.get('log') or ''}"


def _words(told: Result, path: Path) -> str:
    lines = [f"{told['episodes'] - told['failed']} of {told['episodes']} drives passed"]
    lines += _caught(told.get("caught_by", {})) if "mutants" in told else []
    return "\n".join([*lines, f"results: {path}"])


def _caught(caught_by: dict[str, Any]) -> Sequence[str]:
    known = [f"caught  {name}: {by}" for name, by in caught_by.items() if by]
    free = [f"ESCAPED {name}" for name, by in caught_by.items() if not by]
    return [*known, *free, f"{len(known)} of {len(caught_by)} mutants caught"]
