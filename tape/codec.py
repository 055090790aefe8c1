"""The one lossless codec of `nav.messages` and of what stands beside them: decode(encode(m)) is m,
bit for bit."""

from dataclasses import fields
from enum import IntEnum
from functools import cache
from typing import Any, NamedTuple, TypeVar

import numpy as np
from google.protobuf.message import DecodeError
from numpy.typing import NDArray

from nav.messages import (
    LIDAR_COUNT_M,
    LIDAR_NO_RETURN_COUNT,
    MESSAGE_TYPES,
    Floats,
    Message,
    frozen,
    lidar_range_m,
)
from tape.errors import CodecError
from tape.instruments import DriveTorque
from tape.schemas import counts_name, is_counts, shape_name, wire_class
from tape.truth import TrueState

Carried = Message | TrueState | DriveTorque
M = TypeVar("M", bound=Carried)
KINDS: tuple[type[Any], ...] = (*MESSAGE_TYPES, TrueState, DriveTorque)
"""All that a tape may carry."""

_COUNTS = np.dtype("<u2")
_DOUBLES = np.dtype("<f8")


class _Plan(NamedTuple):
    """How one message type travels; worked out once."""

    wire: Any
    scalars: tuple[str, ...]
    enums: tuple[tuple[str, type[IntEnum]], ...]
    arrays: tuple[tuple[str, str], ...]
    """Name, and the wire's name of its shape."""
    counts: tuple[tuple[str, str], ...]
    """Name, and the wire's name of its counts."""


def encode(message: Carried) -> bytes:
    """The bytes of a message.

    Raises:
        CodecError: a value that would not come back bit for bit: a range that is no whole number
            of centimetres, an integer beyond 64 bits, a field of the wrong kind.
    """
    plan = _plan(type(message))
    try:
        return plan.wire(**_wire_values(plan, message)).SerializeToString()
    except (TypeError, ValueError) as error:
        raise CodecError(f"{type(message).__name__}: {error}") from error


def decode(kind: type[M], data: bytes) -> M:
    """The message of type `kind` that `encode` made these bytes from.

    Raises:
        CodecError: the bytes are no such message.
    """
    plan = _plan(kind)
    try:
        return _made(kind, _values(plan, plan.wire.FromString(data)))
    except (DecodeError, TypeError, ValueError) as error:
        raise CodecError(f"{len(data)} bytes are no {kind.__name__}: {error}") from error


def lidar_counts(range_m: Floats) -> NDArray[np.uint16]:
    """Ranges [m] as counts [cm]; the inverse of `nav.messages.lidar_range_m`.

    Raises:
        CodecError: a range that `lidar_range_m` would not give back bit for bit.
    """
    with np.errstate(invalid="ignore"):  # what is no number fails the comparison below
        counts = np.rint(range_m / LIDAR_COUNT_M).astype(_COUNTS)
    if lidar_range_m(counts).tobytes() != range_m.tobytes():
        raise CodecError(_not_a_count(range_m, lidar_range_m(counts)))
    return counts


def _not_a_count(range_m: Floats, survived_m: Floats) -> str:
    index = int(np.flatnonzero(range_m.view(np.int64) != survived_m.view(np.int64))[0])
    return (
        f"range_m[{index}] is {range_m[index]!r} m, expected lidar_range_m of a count: 0 to 65535 "
        f"times {LIDAR_COUNT_M}, {LIDAR_NO_RETURN_COUNT} meaning no return"
    )


def _wire_values(plan: _Plan, message: Carried) -> dict[str, Any]:
    values = vars(message).copy()  # scalars as they are: protobuf refuses the wrong kind
    for name, kind in plan.enums:
        values[name] = kind(values[name])
    for name, shape in plan.arrays:
        array = values[name]
        values[name] = array.tobytes()
        if array.ndim != 1:
            values[shape] = _shape(name, array)
    for name, counts in plan.counts:
        array = values.pop(name)
        if array.ndim != 1:
            raise CodecError(f"{name} has the shape {array.shape}, expected one dimension")
        values[counts] = _steps(lidar_counts(array)).tobytes()
    if None in values.values():  # protobuf would take it for a default
        raise CodecError("a field is None, expected a value")
    return values


def _steps(counts: NDArray[np.uint16]) -> NDArray[np.uint16]:
    """From each beam to the next, modulo 65536: a quarter smaller once compressed."""
    steps = counts.copy()
    steps[1:] -= counts[:-1]
    return steps


def _shape(name: str, array: Floats) -> tuple[int, ...]:
    if array.ndim == 0:
        raise CodecError(f"{name} is a single number, expected an array")
    return array.shape


def _made(kind: type[M], values: dict[str, Any]) -> M:
    """A message of all its fields, as unpickling makes one: its arrays are frozen already."""
    message = object.__new__(kind)
    vars(message).update(values)
    return message


def _values(plan: _Plan, wire: Any) -> dict[str, Any]:
    values = {name: getattr(wire, name) for name in plan.scalars}
    for name, kind in plan.enums:
        values[name] = kind(getattr(wire, name))
    for name, shape in plan.arrays:
        array = np.frombuffer(getattr(wire, name), _DOUBLES)
        several = getattr(wire, shape)
        values[name] = frozen(array.reshape(several) if several else array)
    for name, counts in plan.counts:
        steps = np.frombuffer(getattr(wire, counts), _COUNTS)
        values[name] = frozen(lidar_range_m(np.add.accumulate(steps, dtype=_COUNTS)))
    return values


@cache
def _plan(kind: type) -> _Plan:
    if kind not in KINDS:
        known = ", ".join(t.__name__ for t in KINDS)
        raise CodecError(f"{kind.__name__} is no message of ours; known are {known}")
    arrays = [f for f in fields(kind) if f.type is Floats]
    rest = [(f.name, f.type) for f in fields(kind) if f.type is not Floats]
    return _Plan(
        wire=wire_class(kind),
        scalars=tuple(n for n, t in rest if not _is_enum(t)),
        enums=tuple((n, t) for n, t in rest if _is_enum(t)),  # type: ignore[misc]
        arrays=tuple((f.name, shape_name(f.name)) for f in arrays if not is_counts(f)),
        counts=tuple((f.name, counts_name(f.name)) for f in arrays if is_counts(f)),
    )


def _is_enum(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, IntEnum)
