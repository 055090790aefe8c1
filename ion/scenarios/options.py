"""The arguments of `ion scenarios`."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg


@dataclass(frozen=True)
class Options:
    """What one can ask of the list."""

    folder: Annotated[Positional[Path | None], arg(metavar="FOLDER")] = None
    """Also the scenario files that lie there."""
    settings: bool = False
    """Instead: every name that [vary] may hold, and the value that it has."""
    json: bool = False
    """One JSON object a line on standard output instead of a table."""
