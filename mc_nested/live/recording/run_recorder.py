"""Opening a live run's recorder: where recordings lie, what they say of themselves, and how many are kept."""

import datetime
import importlib.metadata
import platform
import shutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import platformdirs
import tomlkit

from mc_nested.live.devices import DesktopArea, Devices
from mc_nested.live.profile.tables import Profile
from mc_nested.live.recording.format import FORMAT, SUFFIX
from mc_nested.live.recording.recorder import Recorder

MOST_RECORDINGS = 10
"""Recordings that are kept where they lie by default; the oldest one makes room for a new one."""

UNKNOWN = "unknown"
"""What a fact is where the system doesn't say."""


def recordings_folder() -> Path:
    """Return where recordings lie by default, by the system's convention."""
    return platformdirs.user_state_path("mc-nested", appauthor=False) / "recordings"


def kept_recordings() -> list[Path]:
    """Return the recordings in their folder, the oldest first: folders of files, and single files."""
    folder = recordings_folder()
    if not folder.is_dir():
        return []
    kept = [each for each in folder.iterdir() if each.suffix == SUFFIX or any(each.glob(f"*{SUFFIX}"))]
    return sorted(kept, key=lambda each: (each.stat().st_mtime_ns, each.name))


@contextmanager
def open_recorder(
    where: Path | None,
    what: str,
    say: Callable[[str], None],
    profile: Profile,
    devices: Devices,
    facts: Mapping[str, str],
) -> Iterator[Recorder | None]:
    """Open the recorder of a run in a window; yields None where nothing can be recorded.

    Args:
        where: a new folder for the recording; None for one by its date among the others.
        what: the run, in a word or two, as "train-line".
        say: shows the person one line, where nothing can be recorded.
        profile: what it is played with.
        devices: the window's.
        facts: more of the run: its scenario as TOML, whether a server is allowed.
    """
    said = {**_facts(what, profile, devices), **facts}
    folder = where or _new_folder(what)
    try:
        recorder = Recorder(folder, said, devices.display.size(), say)
    except OSError as error:
        say(f"nothing is recorded: {folder}: {error.strerror or error}")
        yield None
        return
    with recorder:
        yield recorder


def versions_here() -> dict[str, str]:
    """Return the versions of this program, of Python and of the system."""
    return {
        "version": importlib.metadata.version("mc-nested"),
        "python": platform.python_version(),
        "system": platform.platform(),
    }


def make_room() -> None:
    """Delete the oldest recordings where they lie by default, so that there is room for one more."""
    for old in kept_recordings()[: 1 - MOST_RECORDINGS]:
        if old.is_dir() and not old.is_symlink():
            shutil.rmtree(old, ignore_errors=True)
        else:
            old.unlink(missing_ok=True)


def _new_folder(what: str) -> Path:
    make_room()
    now = datetime.datetime.now().astimezone()
    return recordings_folder() / f"{what}-{now:%Y-%m-%d-%H%M%S}"


def _facts(what: str, profile: Profile, devices: Devices) -> dict[str, str]:
    width, height = devices.display.size()
    document = tomlkit.document()
    document.update(profile.model_dump(mode="json", exclude_none=True, exclude_defaults=True))
    return {
        "format": str(FORMAT),
        "what": what,
        **versions_here(),
        "size": f"{width}x{height}",
        "title": devices.display.title(),
        "profile": tomlkit.dumps(document),
        "window": _area_words(devices.area()) if devices.area else UNKNOWN,
        "monitors": ", ".join(map(_area_words, devices.monitors() if devices.monitors else ())) or UNKNOWN,
    }


def _area_words(area: DesktopArea) -> str:
    """Write an area as "854x480 at 100 50", in points of the desktop."""
    return f"{area.width}x{area.height} at {area.left} {area.top}"
