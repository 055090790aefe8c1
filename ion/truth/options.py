"""The arguments of `ion truth`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from ion.errors import UsageError
from ion.out_file import check_file


@dataclass(frozen=True)
class Options:
    """Which checks, and where their page goes."""

    names: Annotated[Positional[tuple[str, ...]], arg(metavar="[NAME...]")] = ()
    """Names of checks. Default: all of them."""
    out: Annotated[Path, arg(metavar="FILE")] = Path("runs/truth.html")
    """Where the page goes (HTML)."""
    json: bool = False
    """One JSON object a check on standard output instead of a table."""


def checked(options: Options) -> tuple[str, ...]:
    """The names of the checks that are asked for; all that can be wrong is found first.

    Raises:
        UsageError: an unknown name, or a file that cannot be written.
    """
    from scenarios.truth import CHECKS

    for name in options.names:
        if name not in CHECKS:
            raise UsageError(f"check {name!r} is unknown; there are: {', '.join(CHECKS)}")
    check_file(options.out)
    return options.names or tuple(CHECKS)
