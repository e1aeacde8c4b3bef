"""The contents of a recording: an MCAP file's topics and facts, and calls as plain values of JSON.

/calls    every call that crossed the devices, in order: what a replay needs
/window   pictures of the window, as Foxglove's CompressedImage, the chat blanked

A call is a list of plain values: its name, what it was asked, what it answered. Calls of the thread that plays are in
their order. Nothing else decides what it does next but the keys that another thread releases, which lie among them. So
the same calls, answered alike, are the same run.

["now", 12.5]                        the clock's time            ["key", "press", "w"]     a key goes down
["sleep", 12.55]                     until then                  ["screen", "read", [], answer, pixels]
["front", true]                      whether it is in front      ["note", "acts", {...}]   what the journal was told
["hands", "yielded"]                 a player has taken over
"""

import json
import threading
import time
from collections import deque
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any

from mc_nested.live.devices import Region

FORMAT = 2
"""Of the calls: counted up where a run of before asks other things of its window than one of today.

A recording of another format is refused: every episode would differ at its first press, which says nothing of this
version.
"""

CALLS, WINDOW = "/calls", "/window"

FACTS = "mc-nested"
"""The name of the metadata record: format, versions, what was run, the profile, the scenario and the window."""

SUFFIX = ".mcap"

_CALLS = {"type": "object", "title": "mc_nested.Calls", "properties": {"list": {"type": "array"}}}

_IMAGE = {
    "type": "object",
    "title": "foxglove.CompressedImage",
    "properties": {
        "timestamp": {"type": "object", "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}},
        "frame_id": {"type": "string"},
        "data": {"type": "string", "contentEncoding": "base64"},
        "format": {"type": "string"},
        "index": {"type": "integer"},
        "region": {"type": ["array", "null"], "items": {"type": "integer"}},
    },
}


SCHEMAS = {
    CALLS: ("mc_nested.Calls", json.dumps(_CALLS)),
    WINDOW: ("foxglove.CompressedImage", json.dumps(_IMAGE)),
}
"""Each topic's schema: its name, and the JSON Schema of its messages."""


Call = list[Any]


class Tape:
    """Collects calls, for a writer to take.

    It belongs to the thread that makes it. What another thread does is set down as ``["elsewhere", ...]``, where it
    happened: a key that the watchdog released is up for the calls that follow.
    """

    def __init__(self) -> None:
        self._thread = threading.get_ident()
        self._calls: deque[tuple[int, Call]] = deque()
        self.inside = False
        """Whether a call is under way whose own calls to the devices are part of it."""

    def add(self, *call: Any) -> None:
        """Add a call, at the time of now."""
        if threading.get_ident() != self._thread:
            call = ("elsewhere", *call)
        elif self.inside:
            return
        self._calls.append((time.time_ns(), list(call)))

    def take(self) -> list[tuple[int, Call]]:
        """Take what was added since the last time, with the time of day in nanoseconds; any thread may do so."""
        taken: list[tuple[int, Call]] = []
        while self._calls:
            taken.append(self._calls.popleft())
        return taken


def plain_value(value: Any) -> Any:
    """Return regions, readings and buttons as their fields, tuples as lists; everything else must be plain already."""
    if isinstance(value, Region):
        return [value.left, value.top, value.width, value.height]
    if is_dataclass(value) and not isinstance(value, type):
        return {name: plain_value(part) for name, part in asdict(value).items() if part is not None}
    if isinstance(value, Mapping):
        return {name: plain_value(part) for name, part in value.items()}
    if isinstance(value, tuple | list):
        return [plain_value(part) for part in value]
    return value
