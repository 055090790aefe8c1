"""`ion report`: read a tape, draw, and put everything on one page."""

from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from ion.errors import UsageError
from ion.map_layers import Scene
from ion.map_picture import whole_map
from ion.recorded import Recorded, recorded
from ion.report.options import Options, page_path
from ion.report.page import Told, page
from ion.report.plots import curves
from ion.report.series import Floats, Series
from ion.style import png
from ion.telling import rows
from nav.messages import EgoEstimate
from scenarios.course import Course
from scenarios.vehicles import VEHICLES
from scenarios.verdicts.tracking import frames
from tape.reader import span_ns
from tape.truth import TrueState

KILLED = "The drive was ended from outside: its tape has neither figures nor events."
NO_TRUTH = "The tape has no true states (--log inputs, or the truck's): the map shows estimates."


def report(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: the page cannot be written.
        TapeError: no tape, or a damaged one.
    """
    path = page_path(options)
    drive = recorded(options.log)
    text = page(told(drive, _series(options.log)))
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise UsageError(f"--out {path}: cannot be written: {error.strerror}") from error
    print(f"report: {path}")
    return 0


def told(drive: Recorded, series: Series) -> Told:
    """What the page says of a drive."""
    course, figures = drive.course(), drive.figures
    outcome = figures.get("outcome", "ended from outside")
    verdict = f"Seed {drive.seed}: {outcome} after {series.end_s:.1f} s"
    missing = [] if figures else [KILLED]
    missing += [] if len(series.times(TrueState)) else [NO_TRUTH]
    return Told(
        title=course.title,
        verdict=verdict,
        good=outcome == "finished",
        command=drive.command,
        rows=rows(figures) if figures else [],
        map_png=png(whole_map(_scene(drive, series, course), verdict)),
        curves_png=png(curves(series, drive.events)),
        events=drive.events,
        left_out=" ".join(missing),
    )


def _series(log: Path) -> Series:
    """The columns, with a bar on standard error while they are read."""
    columns = (TextColumn("reading"), BarColumn(), TextColumn("{task.completed:.0f} s"))
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=span_ns(log)[1] * 1e-9)
        return Series(log, lambda seconds: progress.update(task, completed=seconds))


def _scene(drive: Recorded, series: Series, course: Course) -> Scene:
    gates = {kind: _gates(drive, kind) for kind in ("gate", "missed")}
    cells = np.concatenate(series.cells_m) if series.cells_m else np.zeros((0, 2))
    cells = frames(course).to_world(np.unique(cells, axis=0))
    outline = VEHICLES[course.vehicle].outline
    return Scene(course, outline, _track(series, course), cells, gates["gate"], gates["missed"])


def _gates(drive: Recorded, kind: str) -> frozenset[int]:
    return frozenset(int(e.text.split()[-1]) - 1 for e in drive.events if e.kind == kind)


def _track(series: Series, course: Course) -> Floats:
    """Shape (n, 3): x, y and speed in the world frame; where the truth is not told, as believed."""
    if len(series.times(TrueState)):
        place = series.of(TrueState, "position_m")[:, :2]
        return np.column_stack([place, series.of(TrueState, "speed_mps")])
    place = series.of(EgoEstimate, "position_m").reshape(-1, 2)
    return np.column_stack([frames(course).to_world(place), series.of(EgoEstimate, "speed_mps")])
