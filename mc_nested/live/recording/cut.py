"""Cutting a recording: a part of it as one file, from a reset on, so that it can be replayed."""

import math
import re
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import tomlkit

from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import RecordingError
from mc_nested.live.recording.recording_file import PartWriter, TimedCall, facts_of, parts_of, read_recording
from mc_nested.toml_file import parse_document

_BATCH = 500
"""Calls that are written at once."""

_WORDS_AT = {"title": 1, "stop": 1, "error": 3}
"""Calls that hold words of others, in which a name or a path can be, and where in the call those are."""

_WORDS_OF_NOTE = "problem"
"""What of a note they can be in. Typed lines are this program's own commands, which hold neither."""

_PATHS = (("screen", "font"), ("world", "folder"), ("world", "template"))
"""What of a profile are paths: each one's table and key."""

_SEPARATORS = r"[\\/]"
"""Of the parts of a path, on any system."""


def cut(
    path: Path,
    out: Path,
    first: float = 0.0,
    last: float = math.inf,
    clean: Callable[[str], str] | None = None,
    *,
    with_pictures: bool = True,
) -> int:
    """Write what was recorded between two times, in seconds from its beginning; return how many calls that is.

    Unless ``first`` is the recording's beginning, the file begins with the first reset from there on, if there is one.
    ``clean`` takes out of its texts what others mustn't read; of its profile's paths the last part alone is kept then.
    Without it, all texts stay.

    Raises:
        RecordingError: nothing was recorded then, or the recording can't be used, or the file can't be written.
    """
    facts = dict(facts_of(path))
    if clean is not None:
        if "profile" in facts:
            facts["profile"] = _without_folders(facts["profile"], path)
        facts = {name: clean(text) for name, text in facts.items()}
    if first > 0:
        resets = (since for since, each in _calls_in(path) if each.call[:2] == ["note", "resets"])
        first = next((since for since in resets if first <= since <= last), first)
    chosen = (
        TimedCall(each.at, _cleaned(each.call, clean) if clean else each.call, each.pictures if with_pictures else ())
        for since, each in _calls_in(path)
        if first <= since <= last
    )
    written = 0
    with refused_as(RecordingError, out, "name another file"), atomic_write(out) as unfinished:
        unfinished.unlink(missing_ok=True)
        writer = PartWriter(unfinished, facts)
        try:
            while calls := list(islice(chosen, _BATCH)):
                writer.write(calls)
                written += len(calls)
        finally:
            writer.close()
        if not written:
            raise RecordingError(f"{path}: nothing was recorded then: choose another time, or another recording")
    return written


def trim(path: Path, seconds: float) -> None:
    """Keep only a recording's last seconds; if that can't be done, raise RecordingError and leave it as it was."""
    parts = parts_of(path)
    kept = parts[-1].with_name("trimmed.tmp")
    lasts = max((since for since, _ in _calls_in(path)), default=0.0)
    try:
        cut(path, kept, lasts - seconds)
        for part in parts[:-1]:
            part.unlink()
        kept.replace(parts[-1])
    except OSError as error:
        raise RecordingError(f"{path}: can't be trimmed ({error.strerror or error})") from error
    finally:
        kept.unlink(missing_ok=True)


def _calls_in(path: Path) -> Iterator[tuple[float, TimedCall]]:
    """Return each call with its seconds from the recording's beginning."""
    began = None
    for each in read_recording(path):
        if isinstance(each, TimedCall):
            began = each.at if began is None else began
            yield (each.at - began) / 1e9, each


def _without_folders(profile: str, recording: Path) -> str:
    """Return a profile's text with its paths as ``~/1.20.1.jar``: on another computer their folders are of no use."""
    document = parse_document(profile, f"{recording}: its profile", RecordingError)
    for table, key in _PATHS:
        if key in (values := document.get(table, {})):
            values[key] = f"~/{re.split(_SEPARATORS, str(values[key]))[-1]}"
    return tomlkit.dumps(document)


def _cleaned(call: list[Any], clean: Callable[[str], str]) -> list[Any]:
    """Return the call without what others mustn't read. Keys, commands, readings and pixels stay as they are."""
    if call[0] == "elsewhere":
        return ["elsewhere", *_cleaned(call[1:], clean)]
    if call[0] == "note":
        facts = {name: clean(value) if name == _WORDS_OF_NOTE and value else value for name, value in call[2].items()}
        return [*call[:2], facts, *call[3:]]
    at = _WORDS_AT.get(call[0])
    return call if at is None else [*call[:at], clean(call[at]), *call[at + 1 :]]
