"""The records of an MCAP file, one after the other, also of one whose end is missing.

As mcap's own stream reader, but nothing is made of what a tape's reader does not look at (indices,
above all), and little of a message: there are some 450 in a second.
"""

import os
from collections.abc import Callable, Iterator
from io import BytesIO
from struct import Struct
from typing import Any, BinaryIO, NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Header, Metadata, Schema
from mcap.stream_reader import get_chunk_data_stream

MAGIC = b"\x89MCAP0\r\n"
_HEAD = Struct("<BQ")
"""Opcode and length of a record's content."""
_MESSAGE = Struct("<HIQQ")
"""Channel, sequence, log time and publish time, before the payload."""
_READERS: dict[int, Callable[[ReadDataStream], Any]] = {
    Opcode.HEADER: Header.read, Opcode.SCHEMA: Schema.read, Opcode.CHANNEL: Channel.read,
    Opcode.CHUNK: Chunk.read, Opcode.ATTACHMENT: Attachment.read, Opcode.METADATA: Metadata.read,
}  # fmt: skip
"""All other records are passed over."""


class Raw(NamedTuple):
    """A message of any topic, not decoded."""

    channel_id: int
    log_time: int
    data: bytes


def records(file: BinaryIO) -> Iterator[Any]:
    """The records of a file behind its magic, up to its footer; chunks as they are.

    Raises:
        EndOfFile: it ends before.
    """
    size, opcode = os.fstat(file.fileno()).st_size, 0
    file.seek(len(MAGIC))
    while opcode != Opcode.FOOTER:
        opcode, length = _HEAD.unpack(_whole(file, _HEAD.size, size))
        yield from _record(opcode, _whole(file, length, size), 0, length)


def unpacked(chunk: Chunk) -> Iterator[Any]:
    """The records of a chunk.

    Raises:
        ZstdError, CRCValidationError: it is damaged.
    """
    stream, size = get_chunk_data_stream(chunk, validate_crc=True)
    data, at = stream.read(size), 0
    while at < size:
        opcode, length = _HEAD.unpack_from(data, at)
        at += _HEAD.size
        yield from _record(opcode, data, at, length)
        at += length


def _record(opcode: int, data: bytes, at: int, length: int) -> tuple[Any, ...]:
    """The record of these bytes, if it is of a kind that is looked at."""
    if opcode == Opcode.MESSAGE:
        channel_id, _, log_time, _ = _MESSAGE.unpack_from(data, at)
        return (Raw(channel_id, log_time, data[at + _MESSAGE.size : at + length]),)
    if opcode in _READERS:
        return (_READERS[opcode](ReadDataStream(_Whole(data[at : at + length]))),)
    return ()


class _Whole(BytesIO):
    """Bytes of which all are given that are asked for."""

    def read(self, size: int | None = -1) -> bytes:
        data = super().read(size)
        if size is not None and len(data) < size:
            raise EndOfFile
        return data


def _whole(file: BinaryIO, length: int, size: int) -> bytes:
    """All the bytes asked for, of a file of this size."""
    if length > size - file.tell():
        raise EndOfFile
    return file.read(length)
