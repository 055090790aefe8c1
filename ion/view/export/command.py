"""`ion view LOG --export FILE`: one page that plays the drive without a server."""

import json
import logging
from importlib.resources import files
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from ion.errors import UsageError
from ion.out_file import check_file, write_whole
from ion.recorded import recorded
from ion.view.export.recording import Passed, recorded_html
from ion.view.export.told import told
from ion.view.options import LOCAL, Options
from ion.view.server import opened
from ion.view.show import Show
from ion.view.timeline import Timeline
from tape.reader import span_ns

MOST_MB = 30.0


def export(options: Options, path: Path) -> int:
    """Write the page; returns the exit code.

    Raises:
        UsageError: the file cannot be written, or the span is none of the tape.
        TapeError: no tape, or one that `ion drive` did not write.
    """
    check_file(path, "--export")
    span_s = _span(options)
    show = Show(recorded(options.log), Timeline(options.log))
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.completed:.0f} s"))
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("read the tape", total=None)
        show.timeline.read()
        span_s = (max(span_s[0], show.timeline.start_s), span_s[1])
        progress.update(task, description="draw", total=span_s[1] - span_s[0])
        page = _page(show, span_s, lambda s: progress.update(task, completed=s - span_s[0]))
    write_whole(path, page)
    size_mb = path.stat().st_size / 1e6
    print(f"{path}: {size_mb:.1f} MB, {span_s[0]:.1f} to {span_s[1]:.1f} s")
    if size_mb > MOST_MB:
        print(f"that is more than {MOST_MB:.0f} MB: --from and --to make it shorter")
    return 0


def _span(options: Options) -> tuple[float, float]:
    """The asked part of the tape.

    Raises:
        UsageError: it is empty, or not on the tape.
        TapeError: no tape.
    """
    ends_s = span_ns(options.log)[1] * 1e-9
    start_s = 0.0 if options.first is None else options.first
    end_s = ends_s if options.last is None else options.last
    if not 0.0 <= start_s < end_s <= ends_s + 0.05:
        there = f"expected a part of 0 to {ends_s:.2f} s"
        raise UsageError(f"--from {start_s:g} --to {end_s:g}: {there}")
    return start_s, end_s


def _page(show: Show, span_s: tuple[float, float], passed: Passed) -> str:
    """The client with the recording, and what is told beside it."""
    logging.getLogger("websockets").setLevel(logging.CRITICAL)  # nobody connects
    with opened(LOCAL, None) as server:
        html = recorded_html(server, show, span_s, passed)
    title = show.title(show.recorded.course())
    beside = (files("ion.view.export") / "beside.html").read_text(encoding="utf-8")
    data = json.dumps(told(show, title, span_s), allow_nan=False).replace("</", "<\\/")
    return html.replace("</head>", beside.replace("TOLD", data, 1) + "</head>", 1)
