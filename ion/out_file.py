"""The file or folder that an option names: tried before the work begins; a file is written whole or
not at all."""

from pathlib import Path
from tempfile import TemporaryFile

from ion.errors import UsageError


def check_file(path: Path, option: str = "--out") -> None:
    """Make its folder, and see that it can be written; a file that is there stays as it is.

    Raises:
        UsageError: it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        there = path.exists()
        with open(path, "ab"):
            pass
        if not there:
            path.unlink()
    except OSError as error:
        raise UsageError(f"{option} {path}: cannot be written: {error.strerror}") from error


def check_folder(folder: Path) -> None:
    """Make the folder of `--out`, and try it before the work begins.

    Raises:
        UsageError: it cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise UsageError(f"--out {folder}: cannot be written: {error.strerror}") from error


def write_whole(path: Path, text: str) -> None:
    """Written beside it and moved there: Ctrl-C and a full disk leave what was there before."""
    if path.exists() and not path.is_file():  # a device or a pipe
        path.write_text(text, encoding="utf-8")
        return
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(text, encoding="utf-8")
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
