"""Reads a tape in order of delivery, also one whose writer was killed."""

import os
import struct
from collections.abc import Iterator
from typing import Any, BinaryIO, NamedTuple

from mcap.exceptions import EndOfFile, McapError
from mcap.records import Attachment, Channel, Chunk, Header, Metadata, Schema
from mcap.stream_reader import CRCValidationError
from zstandard import ZstdError

from tape.codec import KINDS, Carried, decode
from tape.errors import TapeError
from tape.mcap_records import MAGIC, Raw, records, unpacked
from tape.record import PREFIX, PROFILE, Record
from tape.schemas import schema_name

Path = str | os.PathLike[str]

_KINDS = {schema_name(kind): kind for kind in KINDS}


class Packed(NamedTuple):
    """One line of the tape whose message is still bytes: most are never looked at."""

    topic: str
    delivery_ns: int
    kind: Any
    """The message's type."""
    payload: bytes

    def message(self) -> Carried:
        """Unpack it.

        Raises:
            CodecError: the bytes are no such message.
        """
        return decode(self.kind, self.payload)


def read(path: Path, prefix: str | tuple[str, ...] = PREFIX) -> Iterator[Record]:
    """The records of a tape, in order of delivery; a cut end is simply where it ends.

    Args:
        path: of the tape, or of the folder that holds its segments.
        prefix: of the topics; by default those that crossed the navigator's boundary.

    Raises:
        TapeError: no file, no MCAP file, no tape of ours, or damage before the end.
    """
    for item in read_packed(path, prefix):
        yield Record(item.topic, item.delivery_ns, item.message(), item.payload)


def read_packed(path: Path, prefix: str | tuple[str, ...] = PREFIX) -> Iterator[Packed]:
    """As `read`, without unpacking the messages.

    Raises:
        TapeError: as `read`.
    """
    schemas: dict[int, str] = {}
    channels: dict[int, tuple[str, Any]] = {}
    for item in _items(path):
        if isinstance(item, Raw):
            if item.channel_id in channels:
                topic, kind = channels[item.channel_id]
                yield Packed(topic, item.log_time, kind, item.data)
        elif isinstance(item, Schema):
            schemas[item.id] = item.name
        elif isinstance(item, Channel):
            channels.pop(item.id, None)  # of the segment before
            if item.topic.startswith(prefix):
                channels[item.id] = (item.topic, _kind(path, item.topic, schemas[item.schema_id]))


def attachments(path: Path) -> dict[str, bytes]:
    """The files attached to a tape, by name.

    Raises:
        TapeError: as `read`.
    """
    found = _items(path, chunks=True)
    return {item.name: item.data for item in found if isinstance(item, Attachment)}


def metadata(path: Path) -> dict[str, str]:
    """The short texts of a tape: seed, versions, fingerprint.

    Raises:
        TapeError: as `read`.
    """
    for item in _items(path, chunks=True):
        if isinstance(item, Metadata):
            return item.metadata
    return {}


def span_ns(path: Path) -> tuple[int, int]:
    """First and last time of delivery; found without unpacking a message.

    Raises:
        TapeError: as `read`; or nothing is on it.
    """
    chunks = [item for item in _items(path, chunks=True) if isinstance(item, Chunk)]
    ends = [(c.message_start_time, c.message_end_time) for c in chunks if c.message_end_time]
    if not ends:
        raise TapeError(f"{path}: an empty tape; expected one with messages")
    return min(start for start, _ in ends), max(end for _, end in ends)


def _kind(path: Path, topic: str, name: str) -> Any:
    if name not in _KINDS:
        known = ", ".join(_KINDS)
        raise TapeError(f"{path}: {topic} carries {name}, which is unknown; known are {known}")
    return _KINDS[name]


def segments(path: Path) -> list[Path]:
    """The files of a tape: those of a folder in their order, or the file itself.

    Raises:
        TapeError: a folder without any.
    """
    if not os.path.isdir(path):
        return [path]
    files = sorted(name for name in os.listdir(path) if name.endswith(".mcap"))
    if not files:
        raise TapeError(f"{path}: no tape in this folder; expected segments 0000.mcap, ...")
    return [os.path.join(path, name) for name in files]


def _items(path: Path, chunks: bool = False) -> Iterator[Any]:
    """All records of all segments in their order; with `chunks`, messages stay packed."""
    for segment in segments(path):
        yield from _items_of(segment, chunks)


def _items_of(path: Path, chunks: bool) -> Iterator[Any]:
    """All records of the file in its own order."""
    try:
        with open(path, "rb") as file:
            closed = _check(path, file)
            for item in _until_cut(path, file, closed):
                if isinstance(item, Chunk) and not chunks:
                    yield from unpacked(item)
                else:
                    yield item
    except OSError as error:
        raise TapeError(f"{path}: cannot be read: {error.strerror}") from error
    except (McapError, CRCValidationError, ZstdError, struct.error) as error:
        raise TapeError(f"{path}: damaged: {error}") from error


def _check(path: Path, file: BinaryIO) -> bool:
    """Refuse what is no MCAP file; say whether its writer closed it."""
    if file.read(len(MAGIC)) != MAGIC:
        raise TapeError(f"{path}: not a tape; expected an MCAP file written by tape.TapeWriter")
    file.seek(-len(MAGIC), os.SEEK_END)
    return file.tell() > 0 and file.read() == MAGIC


def _until_cut(path: Path, file: BinaryIO, closed: bool) -> Iterator[Any]:
    try:
        for item in records(file):
            if isinstance(item, Header) and item.profile != PROFILE:
                raise TapeError(f"{path}: MCAP of profile {item.profile!r}, expected {PROFILE!r}")
            yield item
    except EndOfFile as error:
        if closed:
            raise TapeError(f"{path}: damaged: a record is longer than the file") from error
