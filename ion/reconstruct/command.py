"""`ion reconstruct`: read a tape, write the scenario, its route and its picture."""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import ceil
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table

from ion.errors import UsageError
from ion.out_file import write_whole
from ion.reconstruct.evidence import Evidence, Part, evidence
from ion.reconstruct.options import Options, Paths, paths
from ion.reconstruct.rebuilt import Rebuilt, rebuilt
from ion.reconstruct.scenario_text import route_text, scenario_text
from ion.recorded import FIGURES
from ion.replay.scans import check_scans
from nav.parameters import ION
from nav.route import rddf
from nav.route.rddf import Route
from scenarios.replay import Tick, route_of
from scenarios.route import build
from tape.reader import attachments, metadata, span_ns

SLOWER, MORE_S = 2.0, 300.0
"""The time limit: so many times what the tape lasts, and more, and no less than a route has."""


def reconstruct(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: a file cannot be written, or the tape has nothing to rebuild a world from.
        TapeError: no tape, or a damaged one.
        NavError: its route is none, or has no such stretch.
    """
    where = paths(options)
    _check(options.log)
    name, text = route_of(options.log)
    part = part_of(rddf.parse(text, name), options)
    with _bar(options.log) as shown:
        found = rebuilt(evidence(options.log, shown, part))
    if not len(found.evidence.way_m):
        where_to = "the navigator knows where it is" if part.first is None else "this part begins"
        raise UsageError(f"{options.log}: ends before {where_to}")
    _write(found, options, (name, text), where)
    _tell(numbers(found, options.log, where), options.json)
    return 0


def part_of(route: Route, options: Options) -> Part:
    """What is asked for, by places in the route instead of numbers.

    Raises:
        NavError: the route has no such stretch.
    """
    low, high, asked = int(route.number[0]), int(route.number[-1]), options.stretch
    route.stretch(asked.get("from", low), asked.get("to", high))
    places = {name: number - low for name, number in asked.items()}
    return Part(places.get("from"), places.get("to"))


def numbers(found: Rebuilt, log: Path, where: Paths) -> dict[str, Any]:
    """What was found, for JSON."""
    return {
        "log": str(log),
        "outcome": outcome(log, found.evidence),
        "duration_s": round(found.evidence.end_s, 2),
        "things": len(found.things),
        "shapes": dict(Counter(thing.shape for thing in found.things)),
        "faults": [str(fault) for fault in found.faults],
        "scenario": str(where.scenario),
        "route": str(where.route),
        "picture": str(where.picture),
    }


def outcome(log: Path, told: Evidence) -> str:
    """How the drive or its part ended, as far as the tape says."""
    if told.arrived:
        return "arrived"
    figures = json.loads(attachments(log).get(FIGURES, b"{}"))
    return figures.get("outcome", "unknown")


def title(options: Options, ended: str, end_s: float) -> str:
    """Of the scenario: a sentence."""
    part = "".join(f", {word} waypoint {n}" for word, n in options.stretch.items())
    how = "ends" if ended == "unknown" else ended
    return f"Rebuilt from the tape {options.log.resolve().stem}{part}: {how} after {end_s:.0f} s."


def _check(log: Path) -> None:
    """Before the work begins.

    Raises:
        UsageError: another vehicle, or no scans.
        TapeError: no tape.
    """
    vehicle = metadata(log).get("vehicle", ION)
    if vehicle != ION:
        raise UsageError(f"{log}: a tape of {vehicle}; expected one of {ION}")
    check_scans(log)


def _write(found: Rebuilt, options: Options, route: tuple[str, str], where: Paths) -> None:
    from ion.reconstruct.picture import draw
    from ion.style import png

    name, text = route
    course = build(text, name, options.first, options.last, 0)
    limit_s = float(ceil(max(course.time_limit_s, SLOWER * found.evidence.end_s + MORE_S)))
    sentence = title(options, outcome(options.log, found.evidence), found.evidence.end_s)
    write_whole(where.route, text)
    route_lines = route_text(where.route.name, options.stretch)
    write_whole(where.scenario, scenario_text(found, sentence, route_lines, limit_s))
    where.picture.write_bytes(png(draw(found, rddf.parse(text, name), sentence)))


def _tell(result: dict[str, Any], as_json: bool) -> None:
    if as_json:
        print(json.dumps(result))
        return
    table = Table(title=result["log"], title_justify="left", show_header=False)
    for name in ("outcome", "things"):
        table.add_row(name, str(result[name]))
    table.add_row("faults", "\n".join(result["faults"]) or "none")
    for name in ("scenario", "route", "picture"):
        table.add_row(name, result[name])
    Console().print(table)
    print(f"drive it: ion drive {result['scenario']}")


@contextmanager
def _bar(log: Path) -> Iterator[Callable[[Tick], None]]:
    """A bar on standard error."""
    start_ns, end_ns = span_ns(log)
    columns = (TextColumn("reconstruct"), BarColumn(), TextColumn("{task.completed:.0f} s"))
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task, seconds = progress.add_task("", total=(end_ns - start_ns) * 1e-9), 0

        def shown(tick: Tick) -> None:
            nonlocal seconds
            if (tick.time_ns - start_ns) // 10**9 != seconds:
                seconds = (tick.time_ns - start_ns) // 10**9
                progress.update(task, completed=seconds)

        yield shown
