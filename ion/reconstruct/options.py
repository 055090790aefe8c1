"""The arguments of `ion reconstruct`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, NamedTuple

from tyro.conf import Positional, arg

from ion.errors import UsageError
from ion.out_file import check_file

SUFFIX = ".toml"


@dataclass(frozen=True)
class Options:
    """Which tape, and where its scenario goes."""

    log: Annotated[Positional[Path], arg(metavar="LOG")]
    """A tape of --log full or inputs, the twin's or the truck's, or the folder of a long drive."""
    out: Annotated[Path | None, arg(metavar="FILE")] = None
    """Where the scenario goes (TOML); its route and its picture go beside it. Default: beside the
    tape."""
    first: Annotated[int | None, arg(name="from", metavar="WAYPOINT")] = None
    """Rebuild only what lies behind the waypoint of this number ..."""
    last: Annotated[int | None, arg(name="to", metavar="WAYPOINT")] = None
    """... and only up to this one."""
    json: bool = False
    """One JSON object on standard output instead of a table."""

    @property
    def stretch(self) -> dict[str, int]:
        """What of `from` and `to` was asked for, by name."""
        asked = {"from": self.first, "to": self.last}
        return {name: number for name, number in asked.items() if number is not None}


class Paths(NamedTuple):
    """The files that are written."""

    scenario: Path
    route: Path
    picture: Path


def paths(options: Options) -> Paths:
    """Where the files go, tried before the work begins.

    Raises:
        UsageError: the scenario's name does not end in .toml, or a file cannot be written; or the
            scenario or its route is there already, for people edit them.
    """
    scenario = options.out or options.log.resolve().with_name(_name(options))
    if scenario.suffix != SUFFIX:
        raise UsageError(f"--out {scenario}: expected a name that ends in {SUFFIX}")
    found = Paths(scenario, scenario.with_suffix(".rddf"), scenario.with_suffix(".png"))
    for path in (found.scenario, found.route):
        if path.is_file():
            raise UsageError(f"{path}: is there already; remove it, or name another with --out")
    for path in found:
        check_file(path)
    return found


def _name(options: Options) -> str:
    part = "".join(f"_{word}{number}" for word, number in options.stretch.items())
    return f"{options.log.resolve().stem}{part}_rebuilt{SUFFIX}"
