"""Find the game's own font: fonts are tried on the screen until one reads it, then read back for a person to compare.

candidates (packs, jars) -> the first whose glyphs read the debug screen -> scale, colour, phase -> side by side -> F3+C

Where none reads it, say why, and what a person has to change, as far as pixels and options tell.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from calibration.context import CalibrationContext, OpenContext, ReportPicture, StepResult
from calibration.cross_check import cross_check
from calibration.font.read_back import ReadLine, phase_of, read_back, side_by_side
from calibration.font.sources import FontSources, font_sources
from calibration.installation.folders import System
from calibration.step_profile import keep_result, starting_profile
from mc_nested.errors import ClipboardError, FontError, LiveError, NotConfirmedError, UnreadableError
from mc_nested.live.devices import SWITCH_KEYS, Frame
from mc_nested.live.menus.recovery import UNKNOWN_S, Recovery
from mc_nested.live.menus.wait_for_player import wait_for_front
from mc_nested.live.model.timing import PERSON_LOOK_S
from mc_nested.live.model.versions import version_in
from mc_nested.live.profile.fingerprint import game_in
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.font import Font, load_font
from mc_nested.live.vision.game_screen import WindowScreen
from mc_nested.live.vision.layout import VANILLA, Overlay
from mc_nested.live.vision.overlay import SCALES, find_debug_screen, find_overlay
from mc_nested.live.vision.text_lines import ink_of

SHOWN = 6
"""How many fonts an error names at most."""

_LARGER_SCALES = range(max(SCALES) + 1, 13)
_TEXT_SHARE = 0.002
"""With a debug screen, at least this share of a picture's upper left has the text's colour."""


@dataclass(frozen=True)
class Candidate:
    """A font, and the jar, pack or picture that it is from."""

    path: Path
    font: Font


def nothing_fits(
    frames: Sequence[Frame], candidates: Sequence[Candidate], options: Mapping[str, str]
) -> FontError | LiveError:
    """Return the error that says why none of the candidates reads any of these frames (height, width, 3).

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
    """Return the error where a debug screen is seen, but not read because of ``problem``: the font may be the cause."""
    return UnreadableError(f"{problem}; or is it the font of another version? Tried: {_names(candidates)}")


def _names(candidates: Sequence[Candidate]) -> str:
    more = f" and {len(candidates) - SHOWN} more" if len(candidates) > SHOWN else ""
    return ", ".join(str(each.path) for each in candidates[:SHOWN]) + more


def _has_text(frame: Frame) -> bool:
    """Return whether so much of the upper left has the text's colour that there must be a debug screen."""
    part = frame[: frame.shape[0] // 2, : frame.shape[1] // 3]
    return float((ink_of(part, VANILLA.text_colour) > 0).mean()) > _TEXT_SHARE


STEP = "font"

PATIENCE_S = 15.0
"""How long a debug screen that is found may stay unreadable: chat messages disappear after ten seconds."""


def sources_here(version: str | None) -> FontSources:
    """Return what this computer's launchers have for a game of that version."""
    return font_sources(System.here(), version)


def calibrate_font(
    profile_name: str | Path,
    context_of: OpenContext,
    font: Path | None = None,
    sources: Callable[[str | None], FontSources] = sources_here,
) -> tuple[StepResult, Path]:
    """Find the font of a profile's game and write it into the profile, with a picture beside it; both.

    Args:
        profile_name: a name or a file; a new profile is made where there is none.
        context_of: opens the window.
        font: the client jar, resource pack or font picture to take, instead of looking for one.
        sources: gives what may be tried for a game of a version.

    Raises as ``find_font``, and ProfileError where the profile can't be used or written.
    """
    path, profile = starting_profile(profile_name)
    if font is not None:
        load_font(font.expanduser())  # before a window is looked for
    with context_of(profile) as context:
        found = find_font(context, profile, sources_for(context, profile, font, sources))
    return keep_result(found, path, path.with_name(f"{path.stem}-font.png"), context.say)


def sources_for(
    context: CalibrationContext,
    profile: Profile,
    font: Path | None = None,
    sources: Callable[[str | None], FontSources] = sources_here,
) -> FontSources:
    """Return the sources to try: only ``font``, if given, else what ``sources`` has for the title's version.

    The profile's own font comes last, which may be of another version.
    """
    if font is not None:
        return FontSources((font.expanduser().resolve(),))
    found = sources(version_in(context.devices.display.title()))
    own = (profile.screen.font_path(),) if profile.screen.font else ()
    return FontSources((*found.paths, *own), found.options)


def find_font(context: CalibrationContext, profile: Profile, sources: FontSources) -> StepResult:
    """Return the profile with the first font of the sources that reads the debug screen, and that screen read back.

    A menu that lies over the world is left, and the debug screen switched on.

    Raises:
        FontError: there is no font to try, or none that fits what is seen.
        UnreadableError: no debug screen is seen, or F3+C doesn't say what is read.
        LiveError: the world was not reached; what the input controller raises.
    """
    candidates, unusable = _loaded(sources.paths)
    if not candidates:
        raise FontError(
            "no client jar of the game can be used: name it with --font (versions/1.20.1/1.20.1.jar in the game's "
            f"folder){': ' if unusable else ''}{'; '.join(unusable[:1])}"
        )
    context.say(f"Switch to the game with {SWITCH_KEYS}, in a world, with the debug screen on (F3), and stand still.")
    wait_for_front(context.devices)
    chosen = _on_screen(context, profile, candidates, sources)
    frame = context.devices.display.grab()
    lines = read_back(frame, chosen.font)
    screen = profile.screen.model_copy(update={"font": str(chosen.path)})
    findings = _findings(chosen, candidates, unusable, frame, lines)
    found = profile.model_copy(update={"screen": screen})
    picture = ReportPicture(
        "The debug screen, and what is read of it", side_by_side(lines), "left what is seen, right what is read"
    )
    return StepResult(STEP, found, (*findings, *_compared_with_clipboard(context, found)), len(lines), (picture,))


def _on_screen(
    context: CalibrationContext, profile: Profile, candidates: Sequence[Candidate], sources: FontSources
) -> Candidate:
    """Return the first candidate that reads what is on the screen, once that is a world with its debug screen."""
    display, clock = context.devices.display, context.devices.clock
    controller, debug = context.controller, profile.keys.debug
    # The debug screen may be off, or a screen without labels may be open. A key without effect is pressed again.
    presses = iter(((debug,), (debug, "esc"), ("esc",)))
    began, unknown_since, unknown = clock.now(), clock.now(), [display.grab()]
    while True:
        controller.check_front()
        frame = display.grab()
        for each in candidates:
            if read_debug_screen(frame, each.font).problem is None:
                return each
        if way := _way_from_menu(context, profile, candidates):
            way.recover()
            unknown_since = clock.now()
        elif seen := next((each for each in candidates if find_overlay(frame, each.font)), None):
            unknown_since = clock.now()
            if clock.now() - began > PATIENCE_S:
                raise fits_in_part(str(read_debug_screen(frame, seen.font).problem), candidates)
        elif clock.now() - unknown_since > UNKNOWN_S:
            unknown.append(frame)
            keys = next(presses, None)
            if keys is None:
                raise nothing_fits(unknown, candidates, sources.options)
            for key in keys:
                controller.confirm_screen("menu")
                controller.tap(key, on="menu")
                controller.wait(PERSON_LOOK_S)
            unknown_since = clock.now()
        controller.wait(PERSON_LOOK_S)


def _way_from_menu(context: CalibrationContext, profile: Profile, candidates: Sequence[Candidate]) -> Recovery | None:
    """Return the way out of the menu that one of the fonts reads; None where none does."""
    connection = context.connection
    for each in candidates:
        display = connection.devices.display
        screen = WindowScreen(display, each.font, version=game_in(display.title(), profile.game).version)
        way = Recovery(profile, connection.with_screen(screen))
        if way.screen_name() not in ("unknown", "world"):
            return way
    return None


def _loaded(paths: Sequence[Path]) -> tuple[list[Candidate], list[str]]:
    """Return the different fonts of these files, and what is wrong with the files that hold none."""
    candidates: list[Candidate] = []
    unusable = []
    for path in paths:
        try:
            font = load_font(path)
        except FontError as error:
            unusable.append(str(error))
            continue
        if all(font != each.font for each in candidates):
            candidates.append(Candidate(path, font))
    return candidates, unusable


def _findings(
    chosen: Candidate, candidates: Sequence[Candidate], unusable: Sequence[str], frame: Frame, lines: Sequence[ReadLine]
) -> list[str]:
    overlay, phase = find_overlay(frame, chosen.font), phase_of(frame, chosen.font)
    if overlay is None or phase is None:
        raise UnreadableError("the debug screen was there and is gone: leave mouse and keys alone, and run this again")
    begin = "dots from the corner on" if phase == (0, 0) else f"dots shifted by {phase[0]}, {phase[1]} pixels"
    known = sum(line.is_known for line in lines)
    findings = [
        f"font: {chosen.path}{f', of {len(candidates)} different ones' if len(candidates) > 1 else ''}",
        f"GUI scale {overlay.scale}, text {overlay.colour}, a line every {overlay.pitch} dots, {begin}",
        f"read back: {known} of {len(lines)} lines without an unknown glyph",
    ]
    return [*findings, *(f"not used: {problem}" for problem in unusable)]


def _compared_with_clipboard(context: CalibrationContext, profile: Profile) -> tuple[str, ...]:
    """Return what F3+C says about the reading, where the version has it."""
    try:
        return cross_check(context, profile).lines
    except (ClipboardError, NotConfirmedError) as error:
        return (f"not compared with F3+C: {error}",)
