"""The font of the game that was recorded, on this computer, which may not be the one that recorded it."""

from contextlib import suppress
from pathlib import Path

from calibration.installation.folders import System, client_jars
from mc_nested.errors import FontError, ProfileError
from mc_nested.live.profile.tables import ScreenTable
from mc_nested.live.profile.window_title import version_in
from mc_nested.live.recording.recording_file import facts_of
from mc_nested.live.recording.replay import profile_of
from mc_nested.live.vision.font import load_font


def font_of_recording(path: Path, system: System) -> Path:
    """The font that a recording's profile names, or the client jar on this computer that is nearest to its version.

    Raises:
        RecordingError: the recording can't be used, or says nothing of its profile.
        FontError: there is no font here that can be used.
    """
    facts = facts_of(path)
    sources = [*_own(profile_of(path, facts).screen), *client_jars(system, version_in(facts.get("title", "")))]
    for source in sources:
        with suppress(FontError):
            load_font(source)
            return source
    raise FontError(
        f"{path}: the font of the game that was recorded isn't on this computer: name its client jar with --font"
    )


def _own(screen: ScreenTable) -> list[Path]:
    with suppress(ProfileError):  # none is named, or one of another computer
        return [screen.font_path()]
    return []
