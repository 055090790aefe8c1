"""The arguments of `ion explain`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from ion.out_file import check_file


@dataclass(frozen=True)
class Options:
    """What one can ask about a tape."""

    log: Annotated[Positional[Path], arg(metavar="LOG")]
    """A tape, as `ion drive` writes it with --log full or inputs."""
    at: Annotated[float, arg(metavar="SECONDS")]
    """The last decision until then is explained; simulated time, as the bar of a drive shows."""
    out: Annotated[Path | None, arg(metavar="FILE")] = None
    """Where the picture goes (PNG). Default: beside the tape; with --json: no picture."""
    json: bool = False
    """One JSON object on standard output, with all curves as arrays, instead of a table."""


def picture_path(options: Options) -> Path | None:
    """Where the picture goes, tried before the work begins.

    Raises:
        UsageError: a file cannot be written there.
    """
    if options.out is None and options.json:
        return None
    beside = options.log.with_name(f"{options.log.stem}_at{options.at:g}.png")
    path = options.out or beside
    check_file(path)
    return path
