"""What a drive's result depends on beside what was asked: the code, and the kind of processor."""

from functools import cache
from hashlib import sha256
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

from scenarios.processor import fingerprint

PACKAGES = ("nav", "twin", "scenarios", "models")
"""What a result depends on."""


@cache
def code() -> str:
    """What is the same as long as the code and the processor are; a process asks its files once."""
    found = sha256(repr(sorted(fingerprint().items())).encode())
    for package in PACKAGES:
        _add(found, files(package))
    return found.hexdigest()


def _add(found: Any, folder: Traversable) -> None:
    for item in sorted(folder.iterdir(), key=lambda item: item.name):
        if item.is_dir() and item.name != "__pycache__":
            _add(found, item)
        elif item.name.endswith((".py", ".toml", ".xml")):
            found.update(item.name.encode() + item.read_bytes())
