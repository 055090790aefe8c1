"""`ion drive`: one episode or many, told as a table or as JSON."""

import sys
import time
from collections.abc import Sequence
from typing import Any

from rich.console import Console

from ion.drive.options import Options, checkpoint_of, job_of, seeds_of
from ion.job import Job
from ion.telling import Bar, Result, as_asked, as_json, line, summary, table
from scenarios.batch import many
from scenarios.run import Watch

FINISHED, NOT_FINISHED, INTERRUPTED = 0, 1, 130


def drive(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option is wrong.
        NavError: the route file is wrong.
    """
    if options.resume is not None:
        return _code([_resumed(options)])
    seeds, job = seeds_of(options), job_of(options)
    if options.view:
        return _shown(job, seeds[0], options)
    if options.seeds is None:
        return _code([_one(job, seeds[0], options.json)])
    return _many(job, seeds, options)


def _shown(job: Job, seed: int, options: Options) -> int:
    """Drive while people look, and until they have looked enough."""
    from ion.view.live import live

    with live(job, seed, options.host, options.port) as page:
        result = _one(job, seed, options.json, [page])
        page.ended(result["log"])
        page.stay()
    return _code([result])


def _resumed(options: Options) -> Result:
    """Go on from the last checkpoint."""
    start = checkpoint_of(options)
    with Bar(f"{start.job.source.title} {start.seed}") as bar:
        result = start.job.go_on(start, [bar])
    return _say(result, options.json)


def _one(job: Job, seed: int, json: bool, watches: Sequence[Watch] = ()) -> Result:
    with Bar(f"{job.source.title} {seed}") as bar:
        result = job.drive(seed, [bar, *watches])
    return _say(result, json)


def _say(result: Result, json: bool) -> Result:
    if json:
        print(as_json(result))
    else:
        Console().print(table(result))
        for what, path in (("tape", result["log"]), ("map", result["map"])):
            print(f"{what}: {path or 'not kept'}")
    return result


def _many(job: Job, seeds: list[int], options: Options) -> int:
    started, results = time.perf_counter(), list[dict[str, Any]]()
    for result in many(job.drive_in_worker, seeds, options.jobs):
        results.append({"scenario": job.source.title} | result)
        print(as_json(results[-1]) if options.json else line(result), flush=True)
        print(f"{len(results)} of {len(seeds)} episodes", file=sys.stderr)
    counts = {"scenario": job.source.title} | summary(results, time.perf_counter() - started)
    print(as_json(counts) if options.json else _told(counts))
    return _code(results)


def _told(counts: dict[str, Any]) -> str:
    failed = ", ".join(str(seed) for seed in counts["failed_seeds"])
    return f"{counts['finished']} of {counts['episodes']} finished" + (
        f"; not finished: seeds {failed}" if failed else ""
    )


def _code(results: list[dict[str, Any]]) -> int:
    if any(result["outcome"] == "interrupted" for result in results):
        return INTERRUPTED
    return FINISHED if all(map(as_asked, results)) else NOT_FINISHED
