"""Reading a recording: one file, or a folder of them, one after the other. Whatever was written whole is read."""

import base64
import json
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mcap.exceptions import EndOfFile, McapError
from mcap.records import Channel, Footer, Message, Metadata
from mcap.stream_reader import StreamReader
from zstandard import ZstdError

from mc_nested.errors import RecordingError
from mc_nested.live.recording.call_encoder import KeptPicture
from mc_nested.live.recording.format import CALLS, FACTS, FORMAT, SUFFIX, WINDOW

LARGEST_RECORD = 256 * 2**20
"""Bytes: no record of ours is near it, and a damaged length must not fill the memory."""

ENDS_EARLY = "it ends early, as after a crash"

_DAMAGE = (
    McapError,
    ZstdError,
    EOFError,
    ValueError,
    KeyError,
    TypeError,
    struct.error,
    MemoryError,
)


@dataclass(frozen=True)
class TimedCall:
    """A call as plain values, and its time of day in nanoseconds."""

    at: int
    call: list[Any]


@dataclass(frozen=True)
class PartEnd:
    """The end of a file: how it ended. ``problem`` is None for one that was closed, and whole."""

    path: Path
    problem: str | None


def parts_of(path: Path) -> list[Path]:
    """The files of a recording, in order; RecordingError if there are none."""
    if path.is_file():
        return [path]
    parts = sorted(path.glob(f"*{SUFFIX}")) if path.is_dir() else []
    if not parts:
        raise RecordingError(f"{path}: no recording there: mc-nested recordings lists those that are kept")
    return parts


def facts_of(path: Path) -> Mapping[str, str]:
    """What a recording says it is of. RecordingError if it is none of ours, or of another format."""
    for part in parts_of(path):
        for record in _records(part):
            if isinstance(record, Metadata) and record.name == FACTS:
                if record.metadata.get("format") != str(FORMAT):
                    raise RecordingError(
                        f"{part}: is of another version of mc-nested: open it with that one, or record the run again"
                    )
                return dict(record.metadata)
    raise RecordingError(f"{path}: is no recording of mc-nested, or nothing of it was written: name another one")


def read_recording(path: Path) -> Iterator[TimedCall | KeptPicture | PartEnd]:
    """Everything in a recording, in order; each file is followed by how it ended.

    RecordingError as for ``facts_of``.
    """
    facts_of(path)
    for part in parts_of(path):
        yield from _read_part(part)


def _read_part(part: Path) -> Iterator[TimedCall | KeptPicture | PartEnd]:
    topics: dict[int, str] = {}
    is_closed = False
    for record in _records(part):
        if isinstance(record, Damage):
            yield PartEnd(part, record.problem)
            return
        if isinstance(record, Channel):
            topics[record.id] = record.topic
        elif isinstance(record, Footer):
            is_closed = True
        elif isinstance(record, Message) and topics.get(record.channel_id) in (CALLS, WINDOW):
            try:
                read = list(_message(topics[record.channel_id], record.data))
            except _DAMAGE as error:
                yield PartEnd(part, f"damaged: {error}")
                return
            yield from read
    yield PartEnd(part, None if is_closed else ENDS_EARLY)


def _message(topic: str, data: bytes) -> Iterator[TimedCall | KeptPicture]:
    value = json.loads(data)
    if topic == WINDOW:
        yield KeptPicture(int(value["index"]), value["region"], base64.b64decode(value["data"]))
        return
    for at, call in zip(value["times_ns"], value["list"], strict=True):
        yield TimedCall(at, call)


@dataclass(frozen=True)
class Damage:
    """What ends the reading of a file early."""

    problem: str


def _records(part: Path) -> Iterator[Any]:
    """The records of a file, then, unless it was closed, a Damage. RecordingError if the file can't be opened."""
    try:
        with part.open("rb") as file:
            size = part.stat().st_size
            try:
                yield from StreamReader(file, validate_crcs=True, record_size_limit=LARGEST_RECORD).records
            except _DAMAGE as error:
                # What ends in the middle of a record was read to its end.
                is_cut = isinstance(error, EndOfFile) or file.tell() >= size
                yield Damage(ENDS_EARLY if is_cut else f"damaged: {' '.join(str(error).split())[:100]}")
    except OSError as error:
        raise RecordingError(f"{part}: can't be read ({error.strerror or error})") from error
