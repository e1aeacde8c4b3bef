"""Why no font reads the screen, and what a person has to change, as far as pixels and options tell."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mc_nested.errors import FontError, LiveError, UnreadableError
from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.layout import VANILLA, Overlay
from mc_nested.live.vision.overlay import SCALES, find_debug_screen
from mc_nested.live.vision.text_colours import INK_SPREAD

SHOWN = 6
"""Fonts that an error names."""

_LARGER_SCALES = range(max(SCALES) + 1, 13)
_TEXT_SHARE = 0.002
"""Least share of a picture's upper left that has the text's colour where there is a debug screen."""


@dataclass(frozen=True)
class Candidate:
    """A font, and the jar, pack or picture that it is from."""

    path: Path
    font: Font


def nothing_fits(
    frames: Sequence[Frame], candidates: Sequence[Candidate], options: Mapping[str, str]
) -> FontError | LiveError:
    """The error that says why none of the candidates reads any of these frames (height, width, 3).

    ``options`` are those of the game's options.txt.
    """
    if options.get("forceUnicodeFont") == "true":
        return FontError(
            "the game's Force Unicode Font is on, which can't be read: switch it off in its Language options"
        )
    for scale in _LARGER_SCALES:
        overlay = Overlay(scale, VANILLA, VANILLA.text_colour)
        if any(find_debug_screen(frame, each.font, overlay) for frame in frames for each in candidates):
            return UnreadableError(
                f"the GUI scale is {scale}: choose {min(SCALES)} to {max(SCALES)} in the game's Video Settings"
            )
    names = _names(candidates)
    if not any(_has_text(frame) for frame in frames):
        return UnreadableError(
            "no debug screen is to be seen, even after its key was pressed: close what is open in the game, turn it on "
            f"with F3, and run this again (fonts tried: {names})"
        )
    language = options.get("lang", "en_us")
    is_english = language.lower().startswith("en_")
    hint = "" if is_english else f", set the language to English (it is {language})"
    return FontError(
        f"the letters on the screen fit none of these fonts: {names}: name the jar of the version that runs, or the "
        f"resource pack in use, with --font; take off a pack with finer letters; switch Force Unicode Font off{hint}"
    )


def fits_in_part(problem: str, candidates: Sequence[Candidate]) -> LiveError:
    """The error where a debug screen is seen, but not read because of ``problem``: the font may be the cause."""
    return UnreadableError(f"{problem}; or is it the font of another version? Tried: {_names(candidates)}")


def _names(candidates: Sequence[Candidate]) -> str:
    more = f" and {len(candidates) - SHOWN} more" if len(candidates) > SHOWN else ""
    return ", ".join(str(each.path) for each in candidates[:SHOWN]) + more


def _has_text(frame: Frame) -> bool:
    """Whether so much of the upper left has the text's colour that there must be a debug screen."""
    part = frame[: frame.shape[0] // 2, : frame.shape[1] // 3]
    colour = np.array(VANILLA.text_colour, np.int16)
    inked = (np.abs(part.astype(np.int16) - colour) <= INK_SPREAD).all(2)
    return float(inked.mean()) > _TEXT_SHARE
