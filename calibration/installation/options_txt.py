"""Reads and patches the game's ``options.txt``; every other line stays the same, to the byte.

A line is ``name:value``. A key is a word from 1.13 on (``key.keyboard.left.shift``) and a number of LWJGL 2 before
(42); both become the profile's key names (FACTS: options.txt).
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from mc_nested.errors import ProfileError
from mc_nested.live.model.keys import EXTENDED, PLACES, is_key

ACTIONS: Mapping[str, str] = {
    "forward": "forward",
    "back": "back",
    "left": "left",
    "right": "right",
    "sneak": "sneak",
    "chat": "chat",
    "debug.overlay": "debug",
    "debug.modifier": "debug",
}
"""Actions by the game's names, and the profile's name of the key; the hotbar's are ``hotbar.1`` to ``hotbar.9``."""

FIXED = {"attack": "left button", "use": "right button", "debug.copyLocation": "c"}
"""Actions by the game's names, and the key or button for each, which profiles can't change."""

NO_KEY = "key.keyboard.unknown"
"""What an action without a key is bound to, from 1.13 on."""

_MARKS = {
    "apostrophe": "'",
    "backslash": "\\",
    "comma": ",",
    "equal": "=",
    "grave.accent": "`",
    "left.bracket": "[",
    "right.bracket": "]",
    "minus": "-",
    "period": ".",
    "semicolon": ";",
    "slash": "/",
}

_NUMBERS = {
    **{place.scan & 0x7F | (0x80 if place.scan & EXTENDED else 0): name for name, place in PLACES.items()},
    **{index - 100: f"{name} button" for index, name in enumerate(("left", "right", "middle"))},
}
"""LWJGL 2's numbers: a key's scancode, 128 more behind the prefix E0; a mouse button's own number minus 100."""

_OPTION = re.compile(rb"[A-Za-z][\w. -]*:")

_BUTTONS = {f"key.mouse.{name}": f"{name} button" for name in ("left", "right", "middle")}
_KEYBOARD = "key.keyboard."


@dataclass(frozen=True)
class OptionsTxt:
    """The lines of an options.txt, with their line ends; ``path`` is for error messages."""

    path: Path
    lines: tuple[bytes, ...]

    @property
    def values(self) -> dict[str, str]:
        """Each option's value; of a repeated option the last one, as in the game."""
        pairs = (_text(line).partition(":") for line in self.lines)
        return {name: value for name, colon, value in pairs if colon}

    def key(self, action: str) -> str | None:
        """Return what the action is bound to: a profile's key name, "left button" or the like, or "" for nothing.

        None if the file doesn't say, or names a key that profiles have no name for.
        """
        value = self.values.get(f"key_key.{action}")
        return None if value is None else key_name(value)

    def with_values(self, values: Mapping[str, str]) -> "OptionsTxt":
        """Return the options with these values. A missing option stays missing: this version doesn't know it."""
        return OptionsTxt(self.path, tuple(_with_value(line, values) for line in self.lines))

    def changes(self, values: Mapping[str, str]) -> dict[str, tuple[str, str]]:
        """Return the options that ``with_values`` would change, with their values before and after."""
        before = self.values
        return {name: (before[name], value) for name, value in values.items() if before.get(name, value) != value}


def parse_options(data: bytes, path: Path) -> OptionsTxt:
    """Return the options in the file's bytes; ProfileError if most of its lines are something else."""
    lines = data.splitlines(keepends=True)
    filled = [line for line in lines if line.strip()]
    if 2 * sum(bool(_OPTION.match(line)) for line in filled) <= len(filled):
        raise ProfileError(
            f"{path}: doesn't hold the game's options: move it away, start the game once and close it, then run this "
            "again"
        )
    return OptionsTxt(path, tuple(lines))


def load_options(path: Path) -> OptionsTxt:
    """Return the options in a file; ProfileError if it can't be read, or holds none."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise ProfileError(f"{path}: can't be read ({error.strerror or error}): mend its permissions") from error
    return parse_options(data, path)


def key_name(value: str) -> str | None:
    """Return the profile's name of a key in options.txt; "" for no key, None for a key that profiles have no name for.

    With a modifier that Forge writes behind it, such as ``:CONTROL``, it is a different key; ``:NONE`` is no modifier.
    """
    name, _, modifier = value.partition(":")
    if modifier not in ("", "NONE"):
        return None
    if name in (NO_KEY, "0"):
        return ""
    if name.lstrip("-").isdecimal():
        return _NUMBERS.get(int(name))
    if name in _BUTTONS:
        return _BUTTONS[name]
    word = name.removeprefix(_KEYBOARD)
    if word == name:
        return None
    known = _MARKS.get(word, word)
    return known if is_key(known) else None


def _text(line: bytes) -> str:
    return line.decode("utf-8", "surrogateescape").rstrip("\r\n")


def _with_value(line: bytes, values: Mapping[str, str]) -> bytes:
    name, colon, value = _text(line).partition(":")
    if not colon or values.get(name, value) == value:
        return line
    end = line[len(line.rstrip(b"\r\n")) :]
    return f"{name}:{values[name]}".encode("utf-8", "surrogateescape") + end
