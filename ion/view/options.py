"""The arguments of `ion view`, as typed."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

LOCAL = "127.0.0.1"


@dataclass(frozen=True)
class Options:
    """What one can ask of the viewer."""

    log: Annotated[Positional[Path], arg(metavar="LOG")]
    """A tape, as `ion drive` writes it; of a drive that was killed too."""
    export: Annotated[Path | None, arg(metavar="FILE")] = None
    """Write one page (HTML) that plays the drive without a server, instead of serving it."""
    first: Annotated[float | None, arg(name="from", metavar="SECONDS")] = None
    """With --export: where the page begins. Default: at the start."""
    last: Annotated[float | None, arg(name="to", metavar="SECONDS")] = None
    """With --export: where the page ends. Default: with the tape."""
    port: Annotated[int | None, arg(metavar="N")] = None
    """Of the web page. Default: 8080, or the next that is free."""
    parameters: Annotated[Path, arg(metavar="FOLDER")] = Path("runs/parameters")
    """Where parameter files go that were tuned in the page."""
    host: Annotated[str, arg(metavar="ADDRESS")] = LOCAL
    """Where the page can be reached from. Default: this machine only; 0.0.0.0: from everywhere."""
