"""The arguments of `ion report`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from ion.errors import UsageError
from ion.out_file import check_file


@dataclass(frozen=True)
class Options:
    """Which drive, and where its page goes."""

    log: Annotated[Positional[Path], arg(metavar="LOG")]
    """A tape, as `ion drive` writes it."""
    out: Annotated[Path | None, arg(metavar="FILE")] = None
    """Where the page goes (HTML). Default: beside the tape."""


def page_path(options: Options) -> Path:
    """Where the page goes.

    Raises:
        UsageError: the page would replace the tape, or it cannot be written.
    """
    path = options.out or options.log.with_suffix(".html")
    if path.resolve() == options.log.resolve():
        raise UsageError(f"--out {path}: is the tape itself; expected another file")
    check_file(path)
    return path
