"""`ion explain`: why a decision came out as it did, as numbers and as a picture."""

import json
import sys
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from ion.explain.asked import Answer, check, decision_at
from ion.explain.numbers import numbers
from ion.explain.options import Options, picture_path
from ion.explain.picture import draw
from ion.explain.table import tables
from ion.explain.words import title
from ion.style import png


def explain(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: there is nothing to explain at that time, or the picture cannot be written.
        TapeError: no tape, or a damaged one.
    """
    check(options.log, options.at)
    path = picture_path(options)
    answer = _replayed(options.log, options.at)
    if path:
        name = f"{options.log.stem}"
        path.write_bytes(png(draw(answer.explanation, title(answer.explanation, name))))
    if options.json:
        found = {"log": str(options.log), "at_s": options.at, **numbers(answer)}
        print(json.dumps(found | {"picture": path and str(path)}, allow_nan=False))
    else:
        _tell(answer, path)
    return 0


def _replayed(log: Path, at_s: float) -> Answer:
    """The answer, with a bar on standard error while it is looked for."""
    columns = (TextColumn("replay"), BarColumn(), TextColumn("{task.completed:.0f} s"))
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=max(at_s, 0.0))
        return decision_at(log, at_s, lambda seconds: progress.update(task, completed=seconds))


def _tell(answer: Answer, path: Path | None) -> None:
    console = Console()
    for table in tables(answer.explanation):
        console.print(table)
    print(_trust(answer))
    print(f"picture: {path}")
    sys.stdout.flush()


def _trust(answer: Answer) -> str:
    """Whether the replay is what the tape says."""
    if answer.difference:
        return f"The replayed decision DIFFERS from the logged one: {answer.difference}"
    if answer.first_difference:
        return (
            "The replayed decision equals the logged one, but the replay differed before: "
            f"{answer.first_difference}"
        )
    return "The replayed decision equals the logged one."
