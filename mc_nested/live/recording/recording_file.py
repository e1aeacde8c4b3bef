"""The files of a recording, written and read again, one after the other where a folder has several.

A file can be read at any moment, up to the last batch that was written: whatever was written whole is read.
"""

import base64
import contextlib
import json
import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mcap.exceptions import EndOfFile, McapError
from mcap.records import Channel, Footer, Message, Metadata
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType, Writer
from zstandard import ZstdError

from mc_nested.errors import RecordingError
from mc_nested.live.recording.call_encoder import KeptPicture
from mc_nested.live.recording.format import CALLS, EVENTS, FACTS, FORMAT, SCHEMAS, SUFFIX, WINDOW

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
    """Return the files of a recording, in order; raise RecordingError if there are none."""
    if path.is_file():
        return [path]
    parts = sorted(path.glob(f"*{SUFFIX}")) if path.is_dir() else []
    if not parts:
        raise RecordingError(f"{path}: no recording there: mc-nested recordings lists those that are kept")
    return parts


def facts_of(path: Path) -> Mapping[str, str]:
    """Return the facts that a recording states. Raise RecordingError if it is foreign, or of another format."""
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
    """Return everything in a recording, in order; each file is followed by how it ended.

    Raise RecordingError as for ``facts_of``.
    """
    facts_of(path)
    for part in parts_of(path):
        yield from _read_part(part)


def _read_part(part: Path) -> Iterator[TimedCall | KeptPicture | PartEnd]:
    topics: dict[int, str] = {}
    is_closed = False
    for record in _records(part):
        if isinstance(record, str):
            yield PartEnd(part, record)
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
        at = value["timestamp"]["sec"] * 10**9 + value["timestamp"]["nsec"]
        yield KeptPicture(int(value["index"]), value["region"], base64.b64decode(value["data"]), at)
        return
    for at, call in zip(value["times_ns"], value["list"], strict=True):
        yield TimedCall(at, call)


def _records(part: Path) -> Iterator[Any]:
    """Return the records of a file, then, if it ends early, what is damaged, as a text.

    Raise RecordingError if the file can't be opened.
    """
    try:
        with part.open("rb") as file:
            size = part.stat().st_size
            try:
                yield from StreamReader(file, validate_crcs=True, record_size_limit=LARGEST_RECORD).records
            except _DAMAGE as error:
                # What ends in the middle of a record was read to its end.
                is_cut = isinstance(error, EndOfFile) or file.tell() >= size
                yield ENDS_EARLY if is_cut else f"damaged: {' '.join(str(error).split())[:100]}"
    except OSError as error:
        raise RecordingError(f"{part}: can't be read ({error.strerror or error})") from error


Timed = tuple[int, Any]
"""Nanoseconds of the time of day, and what it was."""


class PartWriter:
    """Writes an MCAP file, message by message. Each is packed, has a checksum, and is the system's at once.

    Args:
        path: the file, a new one.
        facts: what the recording is of.

    Raises (everything): OSError where the disk refuses.
    """

    def __init__(self, path: Path, facts: Mapping[str, str]) -> None:
        self.path = path
        self._file = path.open("xb")
        # A chunk ends with each message: whatever is written later, this one is whole.
        self._writer = Writer(self._file, chunk_size=1, compression=CompressionType.ZSTD)
        self._writer.start(profile="", library="mc-nested")
        self._channels = {}
        for topic, (name, schema) in SCHEMAS.items():
            schema_id = self._writer.register_schema(name, "jsonschema", schema.encode())
            self._channels[topic] = self._writer.register_channel(topic, "json", schema_id)
        self._writer.add_metadata(FACTS, dict(facts))

    def write(
        self, calls: Sequence[Timed], events: Sequence[Timed], pictures: Sequence[tuple[int, KeptPicture]]
    ) -> None:
        """Write a batch, the pictures first: a call that names one never stands before it."""
        for at, picture in pictures:
            self._message(WINDOW, at, _image(at, picture))
        if events:
            self._message(EVENTS, events[-1][0], {"list": [{"time_ns": at, **event} for at, event in events]})
        if calls:
            times, said = zip(*calls, strict=True)
            self._message(CALLS, times[-1], {"list": said, "times_ns": times})
        self._file.flush()

    def close(self) -> None:
        """Write the index, and close the file."""
        try:
            self._writer.finish()  # type: ignore[no-untyped-call]  # mcap leaves it untyped
        finally:
            self._file.close()

    def abandon(self) -> None:
        """Close the file as it is, where the disk refuses."""
        with contextlib.suppress(OSError):
            self._file.close()

    def _message(self, topic: str, at: int, value: Mapping[str, Any]) -> None:
        data = json.dumps(value, separators=(",", ":")).encode()
        self._writer.add_message(self._channels[topic], at, data, at)


def _image(at: int, picture: KeptPicture) -> dict[str, Any]:
    return {
        "timestamp": {"sec": at // 10**9, "nsec": at % 10**9},
        "frame_id": "window",
        "format": "png",
        "data": base64.b64encode(picture.png).decode("ascii"),
        "index": picture.index,
        "region": picture.region,
    }


@dataclass(frozen=True)
class Overview:
    """A recording at a glance; times are nanoseconds of the time of day, None if it holds no call."""

    what: str
    version: str
    began: int | None
    ended: int | None
    calls: int
    actions: int
    pictures: int
    size: int
    damage: tuple[str, ...]

    @property
    def seconds(self) -> float:
        """From its first call to its last."""
        return 0.0 if self.began is None or self.ended is None else (self.ended - self.began) / 1e9


def overview_of(path: Path) -> Overview:
    """Read a recording as a whole, its checksums too; raise RecordingError as for ``facts_of``."""
    facts = facts_of(path)
    began = ended = None
    calls = actions = pictures = 0
    damage = []
    for each in read_recording(path):
        if isinstance(each, KeptPicture):
            pictures += 1
        elif isinstance(each, PartEnd):
            if each.problem:
                damage.append(f"{each.path.name}: {each.problem}")
        else:
            began = each.at if began is None else began
            ended = each.at
            calls += 1
            actions += each.call[:2] == ["note", "acts"]
    size = sum(part.stat().st_size for part in parts_of(path))
    what, version = facts.get("what", "unknown"), facts.get("version", "unknown")
    return Overview(what, version, began, ended, calls, actions, pictures, size, tuple(damage))
