"""What a value can be: names that are shipped, one's own profiles, and runs. Quick: nothing heavy is loaded.

Where nothing fits, the shell completes a file's name.
"""

import contextlib
from collections.abc import Callable, Iterable
from pathlib import Path

from mc_nested.cli.runs_folder import RUNS
from mc_nested.live.profile.folder import profile_folder

Values = Callable[[str], list[str]]
"""The values that begin with what is typed so far."""

CONFIG = "config.toml"


def runs(typed: str) -> list[str]:
    """Folders of runs: those in runs/, and those where the typed path leads."""
    places = [RUNS] if typed in ("", ".", "./") else [RUNS, Path(typed) if typed.endswith("/") else Path(typed).parent]
    found = (str(entry) for place in dict.fromkeys(places) for entry in _inside(place) if (entry / CONFIG).is_file())
    return [name for name in found if name.startswith(typed)]


def profiles(typed: str) -> list[str]:
    """Names of one's profiles."""
    return [file.stem for file in _inside(profile_folder()) if file.suffix == ".toml" and file.stem.startswith(typed)]


def of(choices: Iterable[str]) -> Values:
    """Some of these; after a comma, the same with what stands before it."""

    def values(typed: str) -> list[str]:
        before, comma, last = typed.rpartition(",")
        return [before + comma + choice for choice in choices if choice.startswith(last)]

    return values


def _inside(folder: Path) -> list[Path]:
    with contextlib.suppress(OSError):
        return sorted(folder.iterdir())
    return []
