"""The arguments of `ion replay`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from ion.errors import UsageError
from ion.out_file import check_file
from nav.parameters import files_of


@dataclass(frozen=True)
class Options:
    """What one can ask of a replay."""

    logs: Annotated[Positional[tuple[Path, ...]], arg(metavar="LOG...")]
    """Tapes, as `ion drive` writes them with --log full or inputs."""
    parameters: Annotated[Path | None, arg(metavar="FOLDER")] = None
    """Parameter files (TOML) that replace those of the same name on the tape."""
    out: Annotated[Path | None, arg(metavar="FILE")] = None
    """Where the picture of what moved goes (PNG). Default: beside the tape; with --json: none."""
    json: bool = False
    """One JSON object a tape on standard output instead of a table."""
    jobs: Annotated[int, arg(metavar="N")] = 1
    """How many tapes at a time, one process each."""


def check(options: Options) -> None:
    """Find what is wrong before anything is run.

    Raises:
        UsageError: no tape is named, one picture for many tapes is, or a number is wrong.
    """
    if not options.logs:
        raise UsageError("expected a tape, as `ion drive` writes it")
    if options.jobs < 1:
        raise UsageError(f"--jobs {options.jobs}: expected 1 or more")
    if options.out and len(options.logs) > 1:
        raise UsageError(f"--out {options.out}: expected one tape with it")


def picture_path(log: Path, out: Path | None, json: bool) -> Path | None:
    """Where the picture of a tape goes, tried before the work begins.

    Raises:
        UsageError: a file cannot be written there.
    """
    if out is None and json:
        return None
    path = out or log.with_name(f"{log.stem}_replay.png")
    check_file(path)
    return path


def texts_of(folder: Path | None, vehicle: str) -> dict[str, str]:
    """The parameter files of a folder by name; all else that lies in it is left alone.

    Raises:
        UsageError: there is none, or one that the vehicle does not have.
    """
    if folder is None:
        return {}
    known = files_of(vehicle)
    try:
        texts = {path.name: path.read_text("utf-8") for path in sorted(folder.glob("*.toml"))}
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"--parameters {folder}: cannot be read: {error}") from error
    if not texts:
        raise UsageError(f"--parameters {folder}: no TOML file is there; known: {', '.join(known)}")
    if unknown := [name for name in texts if name not in known]:
        names = ", ".join(known)
        raise UsageError(f"{folder / unknown[0]}: no parameter file of {vehicle}; known: {names}")
    return texts
