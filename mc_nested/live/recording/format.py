"""What a recording holds: an MCAP file's topics and facts.

/calls    every call that crossed the devices, in order: what a replay needs
/events   what happened, for people: keys, buttons, notes and errors, each with its time of day
/window   pictures of the window, as Foxglove's CompressedImage, the chat blanked
"""

import json

FORMAT = 2
"""Of the calls: counted up where a run of before asks other things of its window than one of today.

A recording of another format is refused: every episode would differ at its first press, which says nothing of this
version.
"""

CALLS, EVENTS, WINDOW = "/calls", "/events", "/window"

FACTS = "mc-nested"
"""The name of the metadata record: format, versions, what was run, the profile, the scenario and the window."""

SUFFIX = ".mcap"

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


def _list_of(name: str) -> dict[str, object]:
    return {"type": "object", "title": name, "properties": {"list": {"type": "array"}}}


SCHEMAS = {
    CALLS: ("mc_nested.Calls", json.dumps(_list_of("mc_nested.Calls"))),
    EVENTS: ("mc_nested.Events", json.dumps(_list_of("mc_nested.Events"))),
    WINDOW: ("foxglove.CompressedImage", json.dumps(_IMAGE)),
}
"""Each topic's schema: its name, and the JSON Schema of its messages."""
