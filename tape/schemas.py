"""Protobuf descriptors made from the dataclasses of `nav.messages`.

Each type gets two descriptors with the same bytes on the wire. The published one calls an array
`repeated double`, so that Foxglove plots it. The codec's own calls it `bytes`, so that numpy
copies it whole: a packed repeated double is, on the wire, nothing but little-endian doubles.
"""

from dataclasses import Field, fields
from enum import IntEnum
from functools import cache
from typing import Any

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

from nav.messages import Floats

PACKAGE = "ion"

_Proto = descriptor_pb2.FieldDescriptorProto
_SCALARS = {
    bool: _Proto.TYPE_BOOL,
    int: _Proto.TYPE_INT64,
    float: _Proto.TYPE_DOUBLE,
    str: _Proto.TYPE_STRING,
}
_SHAPE_NUMBER = 100
"""Field numbers from here on hold the shapes of arrays that have more than one dimension."""


def schema_name(kind: type) -> str:
    """The full protobuf name of a message type, `ion.GpsFix`."""
    return f"{PACKAGE}.{kind.__name__}"


@cache
def schema(kind: type) -> bytes:
    """The published descriptor of a message type: a serialized FileDescriptorSet."""
    file = _file(kind, _Proto.TYPE_DOUBLE, _Proto.LABEL_REPEATED)
    return descriptor_pb2.FileDescriptorSet(file=[file]).SerializeToString(deterministic=True)


@cache
def wire_class(kind: type) -> Any:
    """The protobuf class that the codec uses for a message type: arrays are bytes."""
    pool = descriptor_pool.DescriptorPool()
    pool.Add(_file(kind, _Proto.TYPE_BYTES, _Proto.LABEL_OPTIONAL))
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(schema_name(kind)))


def is_counts(field: "Field[Any]") -> bool:
    """Whether an array field travels as uint16 counts, each less the one before, not as doubles."""
    return "count" in field.metadata


def counts_name(name: str) -> str:
    """The wire's name of a field that travels as counts: `range_m` becomes `range_count`."""
    return name.removesuffix("_m") + "_count"


def shape_name(name: str) -> str:
    """The wire's name of an array's shape; it is absent for one dimension."""
    return name + "_shape"


def _file(kind: type, array_type: Any, array_label: Any) -> descriptor_pb2.FileDescriptorProto:
    file = descriptor_pb2.FileDescriptorProto(
        name=f"{PACKAGE}/{kind.__name__}.proto", package=PACKAGE, syntax="proto3"
    )
    message = file.message_type.add(name=kind.__name__)
    for number, field in enumerate(fields(kind), start=1):
        if field.type is not Floats:
            _add_scalar(message, field, number)
        elif is_counts(field):
            name = counts_name(field.name)
            _add(message, name, number, _Proto.TYPE_BYTES, _Proto.LABEL_OPTIONAL)
        else:
            _add(message, field.name, number, array_type, array_label)
            shape = shape_name(field.name)
            _add(message, shape, _SHAPE_NUMBER + number, _Proto.TYPE_UINT32, _Proto.LABEL_REPEATED)
    return file


def _add_scalar(message: Any, field: "Field[Any]", number: int) -> None:
    kind = field.type
    if isinstance(kind, type) and issubclass(kind, IntEnum):
        added = _add(message, field.name, number, _Proto.TYPE_ENUM, _Proto.LABEL_OPTIONAL)
        added.type_name = f".{PACKAGE}.{message.name}.{kind.__name__}"
        enum = message.enum_type.add(name=kind.__name__)
        for member in sorted(kind):  # proto3 wants the zero first
            enum.value.add(name=member.name, number=member.value)
        return
    _add(message, field.name, number, _SCALARS[kind], _Proto.LABEL_OPTIONAL)  # type: ignore[index]


def _add(message: Any, name: str, number: int, kind: Any, label: Any) -> Any:
    return message.field.add(name=name, number=number, type=kind, label=label)
