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
from typing import Any

MAGIC = b"ION checkpoint 1\n"
KEY_BYTES = 32


class CheckpointError(ValueError):
    """A checkpoint that cannot be read or written; says what, where, and what would be right."""


def save(path: Path, state: Any) -> None:
    """Write a state, instead of what was there.

    Raises:
        CheckpointError: it cannot be written.
    """
    content = pickle.dumps(state, protocol=pickle.HIGHEST_PROTOCOL)
    part = path.with_name(path.name + ".part")
    try:
        with open(part, "wb") as file:
            file.write(MAGIC + _signature(content) + content)
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    except OSError as error:
        raise CheckpointError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        part.unlink(missing_ok=True)


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
    signature, content = raw[len(MAGIC) :][:KEY_BYTES], raw[len(MAGIC) + KEY_BYTES :]
    if not hmac.compare_digest(signature, _signature(content)):
        raise CheckpointError(
            f"{path}: damaged, or of another user; expected one that ion drive wrote here"
        )
    try:
        return pickle.loads(content)
    except (AttributeError, ImportError, TypeError, pickle.UnpicklingError) as error:
        raise CheckpointError(f"{path}: of another version of ion: {error}") from error


def _signature(content: bytes) -> bytes:
    return hmac.new(_key(), content, hashlib.sha256).digest()


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
