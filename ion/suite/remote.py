"""One drive in a process of its own, on whatever machine a worker of a cluster runs.

The worker may have loaded numpy long ago, and may not have children of multiprocessing's; so it
starts this as a program, with the case on standard input and the result on standard output.
"""

import os
import pickle
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from scenarios.processor import fix_processor

FILES = ("log", "map")
"""Where a result names what a drive left."""
POLL_S = 1.0


def drive_apart(work: Any, number: int, code: str) -> dict[str, Any]:
    """On a worker: the result of a case, with the bytes of what it left.

    Args:
        work: `ion.suite.cases.Work`.
        number: of the case.
        code: what this machine must run.

    Raises:
        RuntimeError: it runs something else, or the drive broke; the last line that it said.
    """
    asked = pickle.dumps((work, number, code))
    done = subprocess.run([sys.executable, "-m", __name__], input=asked, capture_output=True)
    if done.returncode:
        said = done.stderr.decode(errors="replace").strip().splitlines()
        raise RuntimeError(said[-1] if said else f"exit code {done.returncode}")
    return pickle.loads(done.stdout)


def _drive(work: Any, number: int, code_asked: str) -> dict[str, Any]:
    from ion.code import code

    if code() != code_asked:
        raise RuntimeError("this worker has another version of ION, or another kind of processor")
    with TemporaryDirectory() as folder:
        result = replace(work, out=Path(folder))(number)
        left = {what: Path(result[what]) for what in FILES if result.get(what)}
        return result | {"files": {w: (path.name, path.read_bytes()) for w, path in left.items()}}


def _end_with(parent: int) -> None:
    """With a worker that was killed, nobody is left who would take the result."""
    while os.getppid() == parent:
        time.sleep(POLL_S)
    os._exit(1)


def main() -> None:
    """The program."""
    fix_processor()
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    answer, sys.stdout = sys.stdout.buffer, sys.stderr
    answer.write(pickle.dumps(_drive(*pickle.load(sys.stdin.buffer))))


if __name__ == "__main__":
    main()
