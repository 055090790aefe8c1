"""`ion figures`: drive, draw, and put everything on one page."""

from rich.console import Console
from rich.progress import track

from ion.figures import (
    fig_6_05,
    fig_6_06,
    fig_6_07,
    fig_6_08,
    fig_6_09,
    fig_6_10,
    fig_6_11,
    fig_6_12,
    fig_6_13,
)
from ion.figures.drives import Drives, drive_all
from ion.figures.options import Options
from ion.figures.page import Drawn, page
from ion.out_file import check_folder
from ion.style import png

FIGURES = (
    fig_6_05, fig_6_06, fig_6_07, fig_6_08, fig_6_09, fig_6_10, fig_6_11, fig_6_12, fig_6_13,
)  # fmt: skip
NAME = "figures.html"


def figures(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: the folder cannot be written.
    """
    check_folder(options.out)
    path = options.out / NAME
    path.write_text(page(drawn(drive_all())), encoding="utf-8")
    print(f"figures: {path}")
    return 0


def drawn(drives: Drives) -> list[Drawn]:
    """All figures, with a bar on standard error."""
    console = Console(stderr=True)
    return [
        Drawn(f.NAME, f.TITLE, f.SHOWS, f.DIFFERS, png(f.draw(drives)))
        for f in track(FIGURES, "drawing", console=console)
    ]
