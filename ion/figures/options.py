"""The arguments of `ion figures`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import arg


@dataclass(frozen=True)
class Options:
    """Where the page goes."""

    out: Annotated[Path, arg(metavar="FOLDER")] = Path("runs")
    """The folder that gets `figures.html`."""
