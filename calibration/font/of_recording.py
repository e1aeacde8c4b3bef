"""The font of the game that was recorded, on this computer, which may not be the one that recorded it."""

from pathlib import Path

from calibration.font.sources import font_sources
from calibration.installation.folders import System
from mc_nested.errors import FontError
from mc_nested.live.profile.window_title import version_in
from mc_nested.live.recording.recording_file import facts_of
from mc_nested.live.recording.replay import profile_of
from mc_nested.live.vision.font import Font, load_font


def font_of_recording(path: Path, system: System) -> Font:
    """The font that a recording's profile names, or the likeliest one of the games on this computer.

    Raises:
        RecordingError: the recording can't be used, or says nothing of its profile.
        FontError: there is no such font here.
    """
    facts = facts_of(path)
    own = profile_of(path, facts).screen.font
    here = font_sources(system, version_in(facts.get("title", ""))).paths
    for source in (*([Path(own).expanduser()] if own else []), *here):
        try:
            return load_font(source)
        except FontError:  # noqa: PERF203 - a jar may be empty, and the next one whole
            continue
    raise FontError(
        f"{path}: the font of the game that was recorded isn't on this computer: name its client jar with --font"
    )
