"""The checks of the options on which it depends that a command can be typed, and be seen to be typed."""

from collections.abc import Mapping

from calibration.doctor.check import FIX, Check, CheckName
from calibration.installation.options_txt import NO_KEY, OptionsTxt, key_name

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
    """The check of each of these options."""
    values = options.values
    return [_visibility(values.get(_VISIBILITY)), _background(values), _friends(values.get(_FRIENDS))]


def chat_mends(options: OptionsTxt) -> dict[str, str]:
    """Safe values of the options whose check isn't passed."""
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
    """What is typed has the chosen opacity behind it only where the text background is set to be everywhere."""
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
    """The key that opens the list of friends, at once, in the world and in the game's menus."""
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
