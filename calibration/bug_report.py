"""A bug report: the doctor's table, the profile, the versions and recordings' ends in one file, without names or chat.

The chat was never recorded. Home folders and names of accounts are taken out as in the calibration report.
"""

import json
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from calibration.doctor.check import Check
from calibration.report.page import SEEN
from calibration.report.privacy import Names
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import RecordingError
from mc_nested.live.recording.cut import cut
from mc_nested.live.recording.recording_file import facts_of, overview_of
from mc_nested.live.recording.run_recorder import versions_here

DOCTOR, PROFILE, VERSIONS, RECORDING = "doctor.json", "profile.toml", "versions.json", "recording.mcap"

_OF_RECORDING = ("what", "version", "python", "system", "size", "window", "monitors", "title")
"""What a recording says of itself that goes into the versions."""


def write_bug_report(
    out: Path,
    checks: Sequence[Check],
    profile: str | None,
    recordings: Mapping[str, Path],
    seconds: float,
    names: Names,
    texts: Mapping[str, str] | None = None,
) -> list[str]:
    """Write the report, and say what is in it, a line for each part.

    Args:
        out: the zip file to write.
        checks: the doctor's rows.
        profile: the profile's text; None if there is none.
        recordings: the recordings to take the ends of, by the names that they get.
        seconds: how much of each.
        names: what is taken out.
        texts: more files by their names, from which it was taken out already.

    Raises:
        RecordingError: the recording can't be used, or the file can't be written.
    """
    parts = {name: text.encode() for name, text in (texts or {}).items()}
    said = []
    rows = [{each: names.removed_from(str(said)) for each, said in vars(check).items()} for check in checks]
    parts[DOCTOR] = json.dumps({"checks": rows}, indent=2, ensure_ascii=False).encode()
    said.append(f"{DOCTOR}: the {len(rows)} rows of mc-nested doctor")
    if profile is not None:
        parts[PROFILE] = names.removed_from(profile).encode()
        said.append(f"{PROFILE}: the profile, {len(profile.splitlines())} lines")
    versions: dict[str, object] = {**versions_here()}
    said.append(about := f"{VERSIONS}: of mc-nested, Python and the system")
    for file_name, recording in recordings.items():
        facts = facts_of(recording)
        versions["recording"] = known = {name: facts[name] for name in _OF_RECORDING if name in facts}
        said[said.index(about)] = about = f"{about.split(';')[0]}; of the recording: {', '.join(known)}"
        parts[file_name], lines = _end_of(recording, file_name, seconds, names)
        said += lines
    parts[VERSIONS] = names.removed_from(json.dumps(versions, indent=2, ensure_ascii=False)).encode()
    with (
        refused_as(RecordingError, out, "name another file"),
        atomic_write(out) as unfinished,
        zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as file,
    ):
        for name, content in parts.items():
            file.writestr(name, content)
    return said


def _end_of(recording: Path, name: str, seconds: float, names: Names) -> tuple[bytes, list[str]]:
    """Return the end of a recording, and what is in it, in lines."""
    whole = overview_of(recording)
    if not whole.calls:
        raise RecordingError(f"{recording}: holds nothing: name another recording, or --no-recording")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        cut(recording, path, (whole.seconds or 0.0) - seconds, clean=names.removed_from)
        seen = overview_of(path)
        return path.read_bytes(), [
            f"{name}: the last {seen.seconds:.0f} s of {recording.name}: {seen.actions} actions",
            f"{name}: every key and click; {seen.pictures} pictures of the game's window, the chat blanked",
            f"what may be seen on its pictures: {SEEN}",
        ]
