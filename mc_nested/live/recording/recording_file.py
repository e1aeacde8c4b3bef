"""The files of a recording, written and read again, one after the other where a folder has several.

A file can be read at any moment, up to the last batch that was written: whatever was written whole is read.
"""

import base64
import contextlib
import datetime
import json
import struct
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from mcap.exceptions import EndOfFile, McapError
from mcap.records import Channel, Footer, Message, Metadata
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType, Writer
from zstandard import ZstdError

from mc_nested.errors import RecordingError
from mc_nested.live.recording.call_encoder import KeptPicture
from mc_nested.live.recording.format import CALLS, FACTS, FORMAT, SCHEMAS, SUFFIX, WINDOW

LARGEST_RECORD = 256 * 2**20
"""Bytes: no record of ours is near it, and a damaged length must not fill the memory."""

ENDS_EARLY = "it ends early, as after a crash"

_DAMAGE = (McapError, ZstdError, EOFError, ValueError, KeyError, TypeError, struct.error, MemoryError)


@dataclass(frozen=True)
class TimedCall:
    """A call as plain values, its time of day in nanoseconds, and the pictures that were taken in it."""

    at: int
    call: list[Any]
    pictures: Sequence[KeptPicture] = ()


@dataclass(frozen=True)
class Lost:
    """Stands where calls may be missing: which file is damaged, and how, in a line."""

    what: str


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


def read_recording(path: Path) -> Iterator[TimedCall | Lost]:
    """Return everything in a recording, in order.

    Raise RecordingError as for ``facts_of``.
    """
    facts_of(path)
    for part in parts_of(path):
        yield from _read_part(part)


def _read_part(part: Path) -> Iterator[TimedCall | Lost]:
    topics: dict[int, str] = {}
    pictures = deque[tuple[int, KeptPicture]]()
    is_closed = False
    for record in _records(part):
        if isinstance(record, str):
            yield Lost(f"{part.name}: {record}")
            return
        if isinstance(record, Channel):
            topics[record.id] = record.topic
        elif isinstance(record, Footer):
            is_closed = True
        elif isinstance(record, Message) and topics.get(record.channel_id) in (CALLS, WINDOW):
            try:
                value = json.loads(record.data)
                if topics[record.channel_id] == WINDOW:
                    pictures.append(_picture(value))
                    continue
                calls = list(zip(value["times_ns"], value["list"], strict=True))
            except _DAMAGE as error:
                yield Lost(f"{part.name}: damaged: {error}")
                return
            for at, call in calls:
                taken = [pictures.popleft()[1] for _ in range(sum(when <= at for when, _ in pictures))]
                yield TimedCall(at, call, taken)
    if not is_closed:
        yield Lost(f"{part.name}: {ENDS_EARLY}")


def _picture(value: Mapping[str, Any]) -> tuple[int, KeptPicture]:
    """Return a picture, and the time of day of its call in nanoseconds."""
    at = value["timestamp"]["sec"] * 10**9 + value["timestamp"]["nsec"]
    return at, KeptPicture(int(value["index"]), value["region"], base64.b64decode(value["data"]))


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

    def write(self, calls: Sequence[TimedCall]) -> None:
        """Write a batch, the pictures first: a call that names one never stands before it."""
        for each in calls:
            for picture in each.pictures:
                self._message(WINDOW, each.at, _image(each.at, picture))
        if calls:
            said = {"list": [each.call for each in calls], "times_ns": [each.at for each in calls]}
            self._message(CALLS, calls[-1].at, said)
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
    """A recording at a glance. Of one that can't be read, only what is wrong with it is known."""

    recording: Annotated[Path, "its folder or file"]
    what: Annotated[str | None, "what was recorded, as build-house"] = None
    version: Annotated[str | None, "of mc-nested that wrote it"] = None
    began: Annotated[datetime.datetime | None, "local time; null if it holds no call"] = None
    seconds: Annotated[float | None, "its length"] = None
    calls: Annotated[int | None, "of devices, screen and journal"] = None
    actions: Annotated[int | None, "in it"] = None
    pictures: Annotated[int | None, "in it"] = None
    size: Annotated[int | None, "bytes of all its files"] = None
    damage: Annotated[Sequence[str], "what of it is lost"] = ()


def overview_of(path: Path) -> Overview:
    """Read a recording as a whole, its checksums too; raise RecordingError as for ``facts_of``."""
    facts = facts_of(path)
    times: list[int] = []
    actions = pictures = 0
    damage = []
    for each in read_recording(path):
        if isinstance(each, Lost):
            damage.append(each.what)
            continue
        times.append(each.at)
        pictures += len(each.pictures)
        actions += each.call[:2] == ["note", "acts"]
    what, version = (facts.get(name, "unknown") for name in ("what", "version"))
    began, seconds = None, 0.0
    if times:
        began = datetime.datetime.fromtimestamp(times[0] / 1e9)
        seconds = (times[-1] - times[0]) / 1e9
    size = sum(part.stat().st_size for part in parts_of(path))
    return Overview(path, what, version, began, seconds, len(times), actions, pictures, size, tuple(damage))
