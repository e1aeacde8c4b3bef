"""The names of keys, as in profiles and in the game's own options, and pynput's names for them."""

from mc_nested.errors import ProfileError

_SAME = (
    *("space", "tab", "enter", "esc", "backspace", "delete", "insert", "home", "end"),
    *("up", "down", "left", "right", "caps_lock", "page_up", "page_down"),
    *(f"f{number}" for number in range(1, 21)),
)
_OTHER = {
    "escape": "esc",
    "caps.lock": "caps_lock",
    "page.up": "page_up",
    "page.down": "page_down",
    "left.shift": "shift_l",
    "right.shift": "shift_r",
    "left.control": "ctrl_l",
    "right.control": "ctrl_r",
    "left.alt": "alt_l",
    "right.alt": "alt_r",
    "left.win": "cmd_l",
    "right.win": "cmd_r",
}
WORDS = {name: name for name in _SAME} | _OTHER
"""Words that name keys, and their members of ``pynput.keyboard.Key``."""


def check_key(name: str) -> None:
    """ProfileError where ``name`` is neither one character nor a word that names a key."""
    if len(name) != 1 and name not in WORDS:
        raise ProfileError(
            f"no key is named {name!r}: write one character, or one of {', '.join(sorted(_OTHER))}, "
            "space, tab, enter, f1 to f20 and so on"
        )
