"""The events of a recording, for people: which calls they are, and in which words."""

from typing import Any


def event_of(call: list[Any]) -> dict[str, Any] | None:
    """What a call, as plain values, is as an event; None where it is none, as a look at the clock."""
    name, *said = call
    if name == "note":
        return {"event": said[0], **said[1]}
    if name in ("key", "mouse", "error", "reset", "act", "stop"):
        return {"event": name, "what": " ".join(str(each) for each in said)}
    if name == "elsewhere":
        return event_of(said)
    return None
