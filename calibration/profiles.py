"""Named profiles: all files of each, which renaming and deleting take along, and what it says in a few facts.

default.toml                  the profile; beside it .before, .undone, .broken (earlier ones), .ground (arena/undo.py)
default-points/               pictures of the click points
default-calibration/          what calibrations found, for default-calibration.html
default-font.png ...          pictures to look at, one a step
"""

import shutil
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from calibration.arena.undo import note_path
from mc_nested.errors import ProfileError
from mc_nested.live.profile.fingerprint import Fingerprint, mismatch
from mc_nested.live.profile.folder import profile_folder
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile

BESIDE_FILE = (".toml.before", ".toml.undone", ".toml.ground", ".toml")
"""The file itself comes last: whatever is interrupted before can be done again."""

BESIDE_NAME = (
    *("-points", "-calibration", "-calibration.html"),
    *("-font.png", "-walk.png", "-clicks.png", "-clicks-now.png"),
)


def named_profiles() -> list[Path]:
    """Return the files of all named profiles, by name."""
    files = (path for path in profile_folder().glob("*.toml") if path.is_file())
    return sorted(files, key=lambda path: path.stem)


def named_profile(name: str) -> Path:
    """Return the file of the profile of that name, whatever is in it; ProfileError if there is none."""
    for path in named_profiles():
        if path.stem == name:
            return path
    known = ", ".join(path.stem for path in named_profiles()) or "none yet"
    raise ProfileError(f"no profile is named {name!r}: known are: {known}")


def files_of(profile: Path) -> list[Path]:
    """Return what there is of a profile, its own file last."""
    folder, stem = profile.parent, profile.stem
    named = [folder / f"{stem}{ending}" for ending in (*BESIDE_NAME, *BESIDE_FILE)]
    broken = sorted(path for path in folder.iterdir() if path.name.startswith(f"{profile.name}.broken"))
    return [*broken, *(path for path in named if path.exists() or path.is_symlink())]


def rename_profile(profile: Path, name: str) -> Path:
    """Rename a profile with all its files; ProfileError, and nothing is changed, if that can't be."""
    if not name.strip(". ") or Path(name).name != name or name.endswith(".toml"):
        raise ProfileError(f"{name!r} is no profile's name: give one without a folder and an ending")
    renamed = profile.with_name(f"{name}.toml")
    if taken := files_of(renamed):
        raise ProfileError(f"{taken[-1]}: exists already: choose another name, nothing was changed")
    with ExitStack() as undo:
        for path in files_of(profile):
            try:
                new = path.rename(path.with_name(name + path.name[len(profile.stem) :]))
            except OSError as error:
                raise ProfileError(f"{path}: can't be renamed, {error.strerror}: nothing was changed") from error
            undo.callback(new.rename, path)
        undo.pop_all()
    return renamed


def delete_profile(profile: Path) -> None:
    """Delete a profile with all its files, but of a link only the link; ProfileError if the disk refuses."""
    try:
        for path in files_of(profile):
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            else:
                path.unlink()
    except OSError as error:
        raise ProfileError(f"{error.filename}: can't be deleted, {error.strerror}: the rest is still there") from error


def holds_a_copy(profile: Path) -> bool:
    """Return whether it alone knows where the copy is of what stood where its arena was built."""
    if note_path(profile).exists():
        return True
    try:
        arena = load_profile(profile).arena
    except ProfileError:
        return False
    return arena is not None and arena.copied_to is not None


def names_of(files: Sequence[Path]) -> str:
    """Name files in words."""
    return ", ".join(f"{path.name}/" if path.is_dir() else path.name for path in files)


Look = Callable[[str], Fingerprint | None]
"""The open window in whose title that regular expression is found, if there is one."""


@dataclass(frozen=True)
class ProfileFacts:
    """The facts of a profile, each with its meaning; a damaged one has no more than a name."""

    name: Annotated[str, "its name"]
    file: Annotated[Path, "its file"]
    is_damaged: Annotated[bool, "whether it can't be read"] = False
    fits: Annotated[bool | None, "whether it fits the open window and its font is there"] = None
    why: Annotated[str | None, "what doesn't fit, or is damaged or unknown"] = None
    version: Annotated[str | None, "of Minecraft"] = None
    window: Annotated[tuple[int, int] | None, "width and height in pixels"] = None
    gui_scale: Annotated[int | None, "screen pixels to a dot of the menus' and the chat's font"] = None
    debug_scale: Annotated[int | None, "screen pixels to a dot of the debug screen's font"] = None
    arena_size: Annotated[int | None, "cells along each side"] = None
    date: Annotated[str | None, "day of the calibration"] = None


def facts_of(file: Path, look: Look) -> ProfileFacts:
    """Return the facts of the profile in a file."""
    try:
        profile = load_profile(file)
    except ProfileError as error:
        return ProfileFacts(file.stem, file, is_damaged=True, why=str(error))
    fits, why = _fit(file.stem, profile, look)
    calibrated = profile.calibrated
    scales = calibrated.scales if calibrated else None
    return ProfileFacts(
        file.stem,
        file,
        fits=fits,
        why=why,
        version=(calibrated.version if calibrated else None) or profile.game.version,
        window=calibrated.window if calibrated else None,
        gui_scale=scales.gui if scales else None,
        debug_scale=scales.debug if scales else None,
        arena_size=profile.arena.size if profile.arena else None,
        date=calibrated.date if calibrated else None,
    )


def _fit(name: str, profile: Profile, look: Look) -> tuple[bool | None, str | None]:
    """Return whether it fits, and why not."""
    if profile.screen.font is not None and not profile.screen.font_path().is_file():
        return False, f"its font {profile.screen.font} is gone: mc-nested calibrate font --profile {name} --font JAR"
    if profile.calibrated is None:
        return None, f"it was never calibrated as a whole: mc-nested calibrate all --profile {name}"
    window = look(profile.window.title)
    if window is None:
        return None, "no window of the game is open to compare it with"
    problem = mismatch(profile.calibrated, window, name)
    return problem is None, problem
