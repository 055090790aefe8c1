"""Writes a tape: an MCAP file that stays readable when its writer is killed."""

import os
from collections.abc import Callable, Mapping
from types import TracebackType
from typing import Any, NamedTuple, Self

import foxglove
from foxglove import Channel, Context, Schema
from foxglove.mcap import MCAPWriteOptions, MCAPWriter

from nav.messages import LidarScan
from tape.errors import TapeError
from tape.record import PROFILE, Record
from tape.schemas import schema, schema_name
from tape.truth import TrueState
from tape.view import View, view_channel

FLUSH_NS = 10**9
"""A killed writer loses at most this much delivered time."""


class Mode(NamedTuple):
    """What goes into the file."""

    scans: bool
    view: bool


MODES: dict[str, Mode | None] = {
    "full": Mode(scans=True, view=True),
    "inputs": Mode(scans=True, view=False),
    "light": Mode(scans=False, view=True),
    "off": None,
}


class TapeWriter:
    """Writes records, and what people's tools show of them; a context manager.

    `full` writes all, `inputs` neither `/view/` nor `/truth/`, `light` no LIDAR scans, `off` no
    file at all.
    MCAP's log time is the delivery time. The SDK sets the publish time equal to it; the time of
    measurement is `time_ns` in every message.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        attachments: Mapping[str, str | bytes] | None = None,
        metadata: Mapping[str, str] | None = None,
        mode: str = "full",
        view: View | None = None,
    ) -> None:
        """Open the file; one that exists is replaced.

        Args:
            path: the file to write.
            attachments: whole files that belong to the run, by name: scenario, route, parameters.
            metadata: seed, versions, fingerprint: short texts by name.
            mode: a key of `MODES`.
            view: draws `/view/`; without one, scans are not drawn, as their mountings are unknown.

        Raises:
            TapeError: an unknown mode, or a file that cannot be written.
        """
        if mode not in MODES:
            raise TapeError(f"mode {mode!r} is unknown; known are {', '.join(MODES)}")
        self._mode = MODES[mode]
        self._view = view or View()
        self._context = Context()
        self._channels: dict[str, Any] = {}
        self._second = 0
        self._path = os.fspath(path)
        self._file = None if self._mode is None else _open(self._path, self._context)
        if self._file and metadata:
            self._call(self._file.write_metadata, "tape", dict(metadata))
        for name, data in (attachments or {}).items():
            self.attach(name, data)
        self._flush()

    def write(self, record: Record) -> None:
        """Write a record, and what follows from it for `/view/`."""
        mode = self._mode
        if mode is None or not _wanted(record, mode):
            return
        if record.delivery_ns // FLUSH_NS != self._second:
            self._second = record.delivery_ns // FLUSH_NS
            self._flush()
        channel = self._channels.get(record.topic) or self._tape_channel(record)
        channel.log(record.payload, log_time=record.delivery_ns)
        if mode.view:
            for topic, drawn in self._view.update(record):
                channel = self._channels.get(topic) or self._view_channel(topic, drawn)
                channel.log(drawn, log_time=record.delivery_ns)

    def attach(self, name: str, data: str | bytes) -> None:
        """Attach a file, also later than at the opening: a summary, a picture."""
        if self._file:
            raw = data.encode() if isinstance(data, str) else data
            kind = "text/plain" if isinstance(data, str) else "application/octet-stream"
            options = {"log_time": 0, "create_time": 0, "media_type": kind}
            self._call(self._file.attach, name=name, data=raw, **options)

    def close(self) -> None:
        """Write what is left, and the index that makes the file quick to open."""
        file, self._file, self._mode = self._file, None, None
        if file:
            self._call(file.close)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _flush(self) -> None:
        if self._file:
            self._call(self._file.flush)

    def _call(self, write: Callable[..., None], *arguments: Any, **options: Any) -> None:
        try:
            write(*arguments, **options)
        except RuntimeError as error:  # the SDK's own, a full disk among them
            raise TapeError(f"{self._path}: cannot be written: {error}") from error

    def _tape_channel(self, record: Record) -> Channel:
        kind = type(record.message)
        described = Schema(name=schema_name(kind), encoding="protobuf", data=schema(kind))
        channel = Channel(
            record.topic, schema=described, message_encoding="protobuf", context=self._context
        )
        self._channels[record.topic] = channel
        return channel

    def _view_channel(self, topic: str, drawn: Any) -> Any:
        self._channels[topic] = view_channel(topic, drawn, self._context)
        return self._channels[topic]


def _wanted(record: Record, mode: Mode) -> bool:
    if isinstance(record.message, TrueState):
        return mode.view
    return mode.scans or not isinstance(record.message, LidarScan)


def _open(path: str, context: Context) -> MCAPWriter:
    options = MCAPWriteOptions(
        profile=PROFILE,
        disable_seeking=True,  # never go back to patch: what is written is valid
        compression_threads=0,  # episodes already run one a core
    )
    try:
        return foxglove.open_mcap(
            path, allow_overwrite=True, context=context, writer_options=options
        )
    except (OSError, RuntimeError) as error:
        raise TapeError(f"{path}: cannot be written: {error}") from error
