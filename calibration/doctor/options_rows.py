"""The checks of options.txt: where it is, and each option that may keep an agent from playing.

Some of them decide whether a command can be typed, and whether it can be seen on the screen.
"""

from collections.abc import Mapping

from calibration.doctor.check import FIX, Check, CheckName, check_from_message
from calibration.installation.folders import GameFolder
from calibration.installation.options_txt import ACTIONS, FIXED, NO_KEY, OptionsTxt, key_name, load_options
from mc_nested.errors import ProfileError
from mc_nested.live.model.keys import canonical
from mc_nested.live.profile.tables import KeysTable
from mc_nested.live.vision.layout import largest_gui_scale
from mc_nested.live.vision.overlay import SCALES

CHAT_CHECKS = (CheckName.CHAT_VISIBILITY, CheckName.TEXT_BACKGROUND, CheckName.FRIENDS_KEY)

_VISIBILITY, _OPACITY, _CHAT_ONLY, _FRIENDS = (
    *("chatVisibility", "textBackgroundOpacity", "backgroundForChatOnly"),
    "key_key.friends",
)

_SEEN = {"0": "shown", "1": "answers of commands alone"}

FAINT = 0.3
"""The largest opacity behind what is typed at which that can't be read over snow; at 0.5, the default, it can
(FACTS: options.txt)."""


def chat_rows(options: OptionsTxt) -> list[Check]:
    """Return the check of each of these options."""
    values = options.values
    return [_visibility(values.get(_VISIBILITY)), _background(values), _friends(values.get(_FRIENDS))]


def chat_mends(options: OptionsTxt) -> dict[str, str]:
    """Return safe values of the options whose check isn't passed."""
    safe = {
        CheckName.CHAT_VISIBILITY: (_VISIBILITY, "0"),
        CheckName.TEXT_BACKGROUND: (_CHAT_ONLY, "true"),
        # No key, and not one that keyboards lack: the game's own files have that for other actions, so that every
        # version can read it (FACTS: options.txt).
        CheckName.FRIENDS_KEY: (_FRIENDS, NO_KEY),
    }
    return dict(safe[row.name] for row in chat_rows(options) if row.status in ("warn", "fail"))


def _visibility(value: str | None) -> Check:
    if value is None:
        return Check(CheckName.CHAT_VISIBILITY, "skip", "the file doesn't say")
    if value in _SEEN:
        return Check(CheckName.CHAT_VISIBILITY, "pass", f"{value}, {_SEEN[value]}")
    fix = f"Options > Chat Settings > Chat: Shown, or {FIX}"
    return Check(CheckName.CHAT_VISIBILITY, "fail", f"{value}, hidden: no command gets through", fix)


def _background(values: Mapping[str, str]) -> Check:
    """Check the text background: typed text has the chosen opacity behind it only if that is set to be everywhere."""
    row, opacity = CheckName.TEXT_BACKGROUND, values.get(_OPACITY)
    if opacity is None:
        return Check(row, "skip", "the file doesn't say: this version may not have it")
    if values.get(_CHAT_ONLY) != "false":
        return Check(row, "pass", f"{opacity}, of the chat alone")
    try:
        is_faint = float(opacity) <= FAINT
    except ValueError:
        return Check(row, "skip", f"{opacity}, which is no number")
    if not is_faint:
        return Check(row, "pass", opacity)
    fix = f"Options > Accessibility Settings > Text Background: Chat, or {FIX}"
    return Check(row, "warn", f"{opacity}, everywhere: over bright ground what is typed can't be read", fix)


def _friends(value: str | None) -> Check:
    """Check the key that at once opens the list of friends, in the world and in the game's menus."""
    row = CheckName.FRIENDS_KEY
    if value is None:
        return Check(row, "skip", "the file doesn't say: this version may not have it")
    key = key_name(value)
    if not key:
        return Check(row, "pass", "no key" if key == "" else value)
    if len(key) > 1:
        return Check(row, "pass", key)
    fix = f"Options > Controls > Key Binds > Friends: press Esc, or {FIX}"
    return Check(row, "warn", f"{key}: a command that the chat misses would open the list of friends", fix)


SWITCHES = (
    Check(
        CheckName.PAUSE_ON_LOST_FOCUS, "warn", "the game pauses whenever another window is in front", "press F3+P once"
    ),
    Check(CheckName.AUTO_JUMP, "fail", "the player would climb onto the blocks", "Options > Controls > Auto-Jump: OFF"),
    Check(
        CheckName.FORCE_UNICODE_FONT, "fail", "that font can't be read", "Options > Language > Force Unicode Font: OFF"
    ),
    Check(CheckName.FULLSCREEN, "warn", "a game that fills the screen hides all else", "press F11 in the game"),
    Check(CheckName.TOGGLE_CROUCH, "fail", "a sneak key let go goes on sneaking", "Options > Controls > Sneak: Hold"),
    Check(
        CheckName.TOGGLE_ATTACK,
        "fail",
        "one click goes on breaking blocks",
        "Options > Controls > Attack/Destroy: Hold",
    ),
    Check(
        CheckName.TOGGLE_USE,
        "fail",
        "one click goes on placing blocks",
        "Options > Controls > Use Item/Place Block: Hold",
    ),
    Check(
        CheckName.SAVE_CHAT_DRAFTS,
        "warn",
        "a line that was broken off comes back when the chat is opened, and has to be emptied first",
        "Options > Chat Settings > Save Unsent Chats: OFF",
    ),
)
"""The check of each option that should be false, if it is true."""

SAFE = {**{row.name.value: "false" for row in SWITCHES}, "reducedDebugInfo": "false", "lang": "en_us"}
"""Safe values, whatever the window's size and the player's keys."""

OPTION_CHECKS = (
    *(row.name for row in SWITCHES),
    *(CheckName.GUI_SCALE, CheckName.DEBUG_GUI_SCALE, *CHAT_CHECKS, CheckName.LANGUAGE, CheckName.KEYS),
)

_ENGLISH = "en_"

_AS_GUI = -1
"""``debugGuiScale`` for the GUI scale's own value."""


def options_row(folder: GameFolder | None) -> tuple[OptionsTxt | None, Check]:
    """Return the options of a game folder, if they can be read, and their check."""
    if folder is None:
        fix = "start the game once; a folder of your own is found while its game runs"
        return None, Check(CheckName.OPTIONS, "skip", "no launcher's game folder holds one", fix)
    try:
        options = load_options(folder.options)
    except ProfileError as error:
        return None, check_from_message(CheckName.OPTIONS, "fail", str(error).removeprefix(f"{folder.options}: "))
    return options, Check(CheckName.OPTIONS, "pass", f"{folder.launcher}: {folder.options}")


def option_rows(options: OptionsTxt | None, keys: KeysTable, window: tuple[int, int] | None) -> list[Check]:
    """Return a check for each option; ``window`` is the game's width and height in pixels, None if it isn't seen."""
    if options is None:
        return [Check(name, "skip", "no options.txt to read") for name in OPTION_CHECKS]
    return [
        *(_switch(row, options.values.get(row.name.value)) for row in SWITCHES),
        gui_scale_row(options.values.get("guiScale"), window),
        debug_scale_row(options.values.get("debugGuiScale"), options.values.get("guiScale"), window),
        *chat_rows(options),
        _language(options.values.get("lang")),
        keys_row(options, keys),
    ]


def gui_scale_row(value: str | None, window: tuple[int, int] | None) -> Check:
    """Check whether text can be read at the option's GUI scale (FACTS: The F3 debug screen)."""
    row, fix = CheckName.GUI_SCALE, f"Video Settings > GUI Scale: 2, or {FIX}"
    if value is None or not value.isdecimal():
        return Check(row, "skip", "the file doesn't say")
    wanted, most = int(value), max(SCALES)
    if window is None:
        if wanted == 0:
            return Check(row, "warn", "Auto: with the window's size it changes too", fix)
        return Check(row, "pass", value) if wanted <= most else Check(row, "fail", f"{value}: {most} at most", fix)
    largest = largest_gui_scale(window)
    scale, said = (min(wanted, largest), value) if wanted else (largest, "Auto")
    if scale > most:
        return Check(row, "fail", f"{said}, {scale} in this window: {most} at most can be read", fix)
    if wanted == 0:
        return Check(row, "warn", f"Auto, {scale} in this window: with its size it changes too", fix)
    return Check(row, "pass", f"{said}, {scale} in this window" if scale != wanted else said)


def debug_scale_row(value: str | None, gui: str | None, window: tuple[int, int] | None) -> Check:
    """Check the scale of the debug screen's text, from 26.3 on: any will do (FACTS: The F3 debug screen)."""
    row, fix = CheckName.DEBUG_GUI_SCALE, f"press F3+F6 > GUI Scale: Auto, or {FIX}"
    if value is None:
        return Check(row, "skip", "the file doesn't say: this version may not have it")
    if not value.removeprefix("-").isdecimal() or int(value) < _AS_GUI:
        return Check(row, "warn", f"{value}, which is no scale", fix)
    said = {_AS_GUI: f"{value}, as the GUI scale", 0: "Auto"}.get(int(value), value)
    if window is None or gui is None or not gui.isdecimal():
        return Check(row, "pass", said)
    largest = largest_gui_scale(window)
    of_gui = min(int(gui), largest) or largest
    scale = min(int(value), largest) or largest // 2
    # It counts only where it is the smaller one.
    return Check(row, "pass", f"{said}, {scale if 0 < scale < of_gui else of_gui} in this window")


def keys_row(options: OptionsTxt, keys: KeysTable) -> Check:
    """Check whether the game's keys are those that the profile presses."""
    wanted = {action: getattr(keys, name) for action, name in ACTIONS.items()}
    wanted |= {f"hotbar.{slot}": key for slot, key in enumerate(keys.hotbar, 1)} | FIXED
    bound = {action: options.key(action) for action in wanted if f"key_key.{action}" in options.values}
    if not bound:
        return Check(CheckName.KEYS, "skip", "the file doesn't say")
    different = {each: key for each, key in bound.items() if key is None or canonical(key) != canonical(wanted[each])}
    if not different:
        return Check(CheckName.KEYS, "pass", f"{len(bound)} are as the profile has them")
    now = {action: "another key" if key is None else key or "no key" for action, key in different.items()}
    detail = ", ".join(f"{action}: {text} for {wanted[action]}" for action, text in now.items())
    # The game names keys by their position on a QWERTY keyboard, a profile by what is printed on them.
    if all(key is not None and len(key) == 1 == len(wanted[action]) for action, key in different.items()):
        return Check(
            CheckName.KEYS, "warn", detail, "unless your keyboard's layout is why, make [keys] in the profile the same"
        )
    return Check(CheckName.KEYS, "fail", detail, "Options > Controls, or [keys] in the profile: make them the same")


def _switch(row: Check, value: str | None) -> Check:
    if value is None:
        return Check(row.name, "skip", "the file doesn't say: this version may not have it")
    if value != "true":
        return Check(row.name, "pass", value)
    return Check(row.name, row.status, f"{value}: {row.detail}", f"{row.fix}, or {FIX}")


def _language(value: str | None) -> Check:
    if value is None:
        return Check(CheckName.LANGUAGE, "skip", "the file doesn't say")
    if value.lower().startswith(_ENGLISH):
        return Check(CheckName.LANGUAGE, "pass", value)
    fix = f"Options > Language > English (US), or {FIX}"
    return Check(CheckName.LANGUAGE, "warn", f"{value}: menus are known by their English labels", fix)
