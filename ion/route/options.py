"""The arguments of `ion route`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from ion.courses import route_source
from ion.out_file import check_file

RACE = "gc05_route"


@dataclass(frozen=True)
class Options:
    """Which route, and where its picture goes."""

    route: Annotated[Positional[Path], arg(metavar="FILE")]
    """A route definition file (RDDF), or gc05_route for the one of that scenario."""
    out: Annotated[Path, arg(metavar="FILE")] = Path("runs/route.png")
    """Where the picture goes (PNG)."""
    write: Annotated[Path | None, arg(metavar="FILE")] = None
    """Write the route definition file there, too."""
    json: bool = False
    """One JSON object on standard output instead of a table."""


def read(options: Options) -> tuple[str, str]:
    """The text of the route file and its name; all that can be wrong is found first.

    Raises:
        UsageError: a file that cannot be read or written.
        NavError: the file is no route.
    """
    for option, path in (("--out", options.out), ("--write", options.write)):
        if path is not None:
            check_file(path, option)
    if str(options.route) == RACE:
        from scenarios.gc05_route.route import NAME, text

        return text(), NAME
    return route_source(options.route, None, None).route_text, str(options.route)
