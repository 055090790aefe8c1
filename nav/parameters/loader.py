"""TOML text to frozen dataclasses; what is unknown, missing or of the wrong kind is refused."""

import tomllib
from dataclasses import MISSING, Field, fields, is_dataclass
from types import NoneType
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

from nav.errors import NavError

T = TypeVar("T")


class ParameterError(NavError):
    """A parameter file that cannot be used; says which key and what would have been right."""


def from_toml(cls: type[T], text: str, where: str) -> T:
    """Build the dataclass `cls` from TOML.

    Args:
        cls: a frozen dataclass; nested dataclasses, tuples and dicts of them are built too.
        text: the file's text.
        where: the file's name, for messages.

    Raises:
        ParameterError: not TOML, an unknown or missing key, or a value of the wrong kind.
    """
    return from_table(cls, table_of(text, where), where)


def from_table(cls: type[T], table: dict[str, Any], where: str) -> T:
    """Build the dataclass `cls` from plain tables, as `from_toml`."""
    return _value(cls, table, where)


def table_of(text: str, where: str) -> dict[str, Any]:
    """TOML as plain tables.

    Raises:
        ParameterError: not TOML.
    """
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ParameterError(f"{where}: not TOML: {error}") from error


def merged(kind: Any, base: dict[str, Any], over: dict[str, Any]) -> dict[str, Any]:
    """`base` with what `over` says instead: field by field in dataclasses, all else wholly."""
    hints = get_type_hints(kind)
    deeper = {
        key: merged(hints[key], base[key], over[key])
        for key in over
        if is_dataclass(hints.get(key)) and key in base and type(over[key]) is dict
    }
    return base | over | deeper


def _value(kind: Any, value: Any, path: str) -> Any:
    if is_dataclass(kind):
        return _dataclass(kind, value, path)
    if get_origin(kind) is tuple:
        return _tuple(get_args(kind), value, path)
    if get_origin(kind) is dict:
        items = _expect(dict, value, path).items()
        return {k: _value(get_args(kind)[1], v, f"{path}.{k}") for k, v in items}
    if kind is float and type(value) is int:
        return float(value)
    return _expect(kind, value, path)


def _dataclass(cls: Any, value: Any, path: str) -> Any:
    table: dict[str, Any] = _expect(dict, value, path)
    hints = get_type_hints(cls)
    known = {f.name: f for f in fields(cls)}
    if unknown := [key for key in table if key not in known]:
        raise ParameterError(f"{path}.{unknown[0]}: unknown key; known are {', '.join(known)}")
    if missing := [n for n, f in known.items() if n not in table and _required(f)]:
        raise ParameterError(f"{path}.{missing[0]}: missing")
    values = {k: _value(hints[k], v, f"{path}.{k}") for k, v in table.items()}
    try:
        return cls(**values)
    except ValueError as error:
        raise ParameterError(f"{path}: {error}") from error


def _required(f: "Field[Any]") -> bool:
    return f.default is MISSING and f.default_factory is MISSING


def _tuple(kinds: tuple[Any, ...], value: Any, path: str) -> tuple[Any, ...]:
    items = _expect(list, value, path)
    if kinds[-1] is Ellipsis:
        kinds = (kinds[0],) * len(items)
    if len(items) != len(kinds):
        raise ParameterError(f"{path}: has {len(items)} values, expected {len(kinds)}")
    pairs = enumerate(zip(kinds, items, strict=True))
    return tuple(_value(k, v, f"{path}[{i}]") for i, (k, v) in pairs)


def _expect(kind: Any, value: Any, path: str) -> Any:
    if type(value) is kind or (kind is NoneType and value is None):
        return value
    name = getattr(kind, "__name__", str(kind))
    raise ParameterError(f"{path}: {value!r} is {type(value).__name__}, expected {name}")
