"""The file of `--out`, tried before the work begins."""

from pathlib import Path

from ion.errors import UsageError


def check_file(path: Path) -> None:
    """Make its folder, and see that it can be written; a file that is there stays as it is.

    Raises:
        UsageError: it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "ab"):
            pass
        if not path.stat().st_size:
            path.unlink()
    except OSError as error:
        raise UsageError(f"--out {path}: cannot be written: {error.strerror}") from error
