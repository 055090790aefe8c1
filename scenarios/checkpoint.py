"""A run put on disk in its middle, to go on from: written whole or not at all, read only if ours.

A checkpoint is a pickle, and a pickle can do anything to who reads it. So each is signed with a key
that is drawn once for a user and stays in a file of his own; what bears no such signature is not
unpickled.
"""

import hashlib
import hmac
import os
import pickle
import secrets
from pathlib import Path
from typing import Any, BinaryIO

MAGIC = b"ION checkpoint 1\n"
KEY_BYTES = SIGNATURE_BYTES = 32


class CheckpointError(ValueError):
    """A checkpoint that cannot be read or written; says what, where, and what would be right."""


def save(path: Path, state: Any) -> None:
    """Write a state, instead of what was there.

    Raises:
        CheckpointError: it cannot be written.
    """
    part = path.with_name(path.name + ".part")
    try:
        with open(part, "wb") as file:
            _write(file, state)
            os.fsync(file.fileno())
        part.replace(path)
    except OSError as error:
        raise CheckpointError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        part.unlink(missing_ok=True)


def _write(file: BinaryIO, state: Any) -> None:
    """The pickle as it comes: a copy of all that a long drive knows would be its largest part."""
    file.write(MAGIC + bytes(SIGNATURE_BYTES))
    signing = _Signing(file)
    pickle.Pickler(signing, pickle.HIGHEST_PROTOCOL).dump(state)
    file.seek(len(MAGIC))
    file.write(signing.signature.digest())
    file.flush()


class _Signing:
    """Writes to a file, and signs what it writes."""

    def __init__(self, file: BinaryIO) -> None:
        self._file, self.signature = file, _signature()

    def write(self, content: bytes) -> int:
        """Take a part."""
        self.signature.update(content)
        return self._file.write(content)


def load(path: Path) -> Any:
    """The state that a checkpoint holds.

    Raises:
        CheckpointError: no checkpoint, a damaged one, one of somebody else, or of another version.
    """
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise CheckpointError(f"{path}: cannot be read: {error.strerror}") from error
    if not raw.startswith(MAGIC):
        raise CheckpointError(f"{path}: no checkpoint; expected one that ion drive wrote")
    begin = len(MAGIC) + SIGNATURE_BYTES
    said, content = raw[len(MAGIC) : begin], memoryview(raw)[begin:]
    signature = _signature()
    signature.update(content)
    if not hmac.compare_digest(said, signature.digest()):
        raise CheckpointError(
            f"{path}: damaged, or of another user; expected one that ion drive wrote here"
        )
    try:
        return pickle.loads(content)
    except (AttributeError, ImportError, TypeError, pickle.UnpicklingError) as error:
        raise CheckpointError(f"{path}: of another version of ion: {error}") from error


def _signature() -> hmac.HMAC:
    """Of nothing yet."""
    return hmac.new(_key(), digestmod=hashlib.sha256)


def _key() -> bytes:
    """The user's own, drawn when it is needed for the first time.

    Raises:
        CheckpointError: its file cannot be written or read.
    """
    state = os.environ.get("XDG_STATE_HOME") or "~/.local/state"
    path = Path(state).expanduser() / "ion-twin" / "checkpoint.key"
    try:
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            new = path.with_name(f"{path.name}.{secrets.token_hex(8)}")
            with open(os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
                file.write(secrets.token_bytes(KEY_BYTES))
            _put(new, path)
        return path.read_bytes()
    except OSError as error:
        raise CheckpointError(f"{path}: no key for checkpoints: {error.strerror}") from error


def _put(new: Path, path: Path) -> None:
    """In place, unless another process was quicker."""
    try:
        os.link(new, path)
    except FileExistsError:
        pass
    finally:
        new.unlink()
