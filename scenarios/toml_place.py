"""Where in a TOML file something is wrong: its key, its line, and the names that would be right."""

import re
import tomllib
from collections.abc import Sequence
from typing import Any, get_args, get_origin, get_type_hints

import msgspec

Path = tuple[str | int, ...]
"""Keys, and of tables in an array also which."""

_MESSAGE = re.compile(r"(?P<what>.*?)(?: - at `\$?\.?(?P<at>.*)`)?$", re.DOTALL)
_UNKNOWN = re.compile(r"Object contains unknown field `(.+)`")
_HEADER = re.compile(r"\s*\[\[?.*\]\]?\s*(#.*)?$")
_KEY = re.compile(r"""\s*((?:[\w-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[\w-]+|"[^"]*"|'[^']*'))*)\s*=""")


class PlacedError(ValueError):
    """What is wrong with the value of one key."""

    def __init__(self, path: Sequence[str | int], what: str) -> None:
        super().__init__(what)
        self.path = tuple(path)


def place(text: str, error: PlacedError) -> str:
    """One line: where in a file's text, and what."""
    line = line_of(text, error.path)
    where = [*([f"line {line}"] if line else []), *([dotted(error.path)] if error.path else [])]
    return ": ".join([*where, str(error)])


def dotted(path: Path) -> str:
    """As people write it."""
    return ".".join(str(key) for key in path if isinstance(key, str))


def line_of(text: str, path: Sequence[str | int]) -> int | None:
    """The line, counted from 1, that says the longest part of a path of keys; None if none does."""
    best, found, table, tables = 0, None, Path(), dict[Path, int]()
    for number, line in enumerate(text.splitlines(), 1):
        here = table
        if _HEADER.match(line):
            here = table = _numbered(_keys(line), line.lstrip().startswith("[["), tables)
        elif key := _KEY.match(line):
            here = (*table, *_keys(f"{key[1]} = 0"))
        alike = len(here) if tuple(path[: len(here)]) == here else 0
        if alike > best:
            best, found = alike, number
    return found


def _numbered(keys: Path, array: bool, tables: dict[Path, int]) -> Path:
    """The path of a header: which table of an array it is, or lies in."""
    if array:
        tables[keys] = tables.get(keys, -1) + 1
    path = Path()
    for k, key in enumerate(keys, 1):
        path = (*path, key, *([tables[keys[:k]]] if keys[:k] in tables else []))
    return path


def _keys(line: str) -> Path:
    """The path that a line of TOML names."""
    try:
        value: Any = tomllib.loads(line)
    except tomllib.TOMLDecodeError:
        return ()
    path: tuple[str, ...] = ()
    while isinstance(value, dict | list) and value:
        if isinstance(value, list):
            value = value[0]
            continue
        (key, value), *_ = value.items()
        path = (*path, key)
    return path


def _split(error: Exception, kind: Any) -> tuple[Path, str]:
    """Path and text of what msgspec says of a conversion into `kind`; of an unknown key, with those
    that there are."""
    match = _MESSAGE.match(str(error))
    assert match is not None
    parts = re.findall(r"[^.\[\]]+", match["at"] or "")
    path = tuple(int(part) if part.isdigit() else part for part in parts)
    unknown = _UNKNOWN.match(match["what"])
    if unknown is None:
        return path, match["what"][:1].lower() + match["what"][1:]
    names = ", ".join(_names(kind, path))
    return (*path, unknown[1]), f"unknown key; there are {names}"


def _names(kind: Any, path: Path) -> list[str]:
    """The keys of the table that a path leads to."""
    for key in path:
        struct = _struct(kind)
        kind = get_type_hints(struct).get(str(key), kind) if struct else kind
    struct = _struct(kind)
    return [f.encode_name for f in msgspec.structs.fields(struct)] if struct else []


def _struct(kind: Any) -> Any:
    """The struct that a type is, or holds."""
    if isinstance(kind, type) and issubclass(kind, msgspec.Struct):
        return kind
    inner = get_args(kind)[1:] if get_origin(kind) is dict else get_args(kind)
    return next(filter(None, map(_struct, inner)), None)


def converted(value: Any, kind: Any, path: Path) -> Any:
    """As `msgspec.convert`, with the whole path in what it raises.

    Raises:
        PlacedError: the value is no `kind`.
    """
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        inner, what = _split(error, kind)
        raise PlacedError((*path, *inner), what) from error
