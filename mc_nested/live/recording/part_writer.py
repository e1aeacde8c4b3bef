"""One file of a recording: it can be read at any moment, up to the last batch that was written."""

import base64
import contextlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mcap.writer import CompressionType, Writer

from mc_nested.live.recording.call_encoder import KeptPicture
from mc_nested.live.recording.format import CALLS, EVENTS, FACTS, SCHEMAS, WINDOW

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
