"""Keys: where each lies, what profiles and the game's options call it, and which symbol it makes.

From 1.13 on the game binds keys by place and names a place by what a US keyboard has there, whatever is printed on the
key and whatever letter it types (FACTS: Input and windows; options.txt). So does a profile, and so are keys sent and
heard.

To 1.12 the game goes by what a key makes, and not by its place. LWJGL 2 has a key for each character that a US keyboard
makes without Shift, and a few more. On X11 it takes what the layout's first group makes, with Shift where that is down;
on Windows the virtual key (FACTS: Input and windows).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from mc_nested.errors import ProfileError

EXTENDED = 0xE000
"""Set in the scancodes of keys that a keyboard sends with the prefix E0."""


@dataclass(frozen=True)
class KeyPlace:
    """The key at a place.

    Attributes:
        evdev: Linux's code (linux/input-event-codes.h). An X server's keycode is 8 more.
        scan: the scancode of set 1, with EXTENDED where it has the prefix E0, as Windows and GLFW have it.
        mac: the virtual keycode of macOS (Carbon's HIToolbox/Events.h, kVK_…).
    """

    evdev: int
    scan: int
    mac: int


# Linux numbered its first 88 codes as set 1 numbers its scancodes.
_ROWS: tuple[tuple[int, str, tuple[int, ...]], ...] = (
    (2, "1234567890-=", (18, 19, 20, 21, 23, 22, 26, 28, 25, 29, 27, 24)),
    (16, "qwertyuiop[]", (12, 13, 14, 15, 17, 16, 32, 34, 31, 35, 33, 30)),
    (30, "asdfghjkl;'`", (0, 1, 2, 3, 5, 4, 38, 40, 37, 41, 39, 50)),
    (43, "\\zxcvbnm,./", (42, 6, 7, 8, 9, 11, 45, 46, 43, 47, 44)),
)
_NAMED = {
    "esc": (1, 53),
    "backspace": (14, 51),
    "tab": (15, 48),
    "enter": (28, 36),
    "left.control": (29, 59),
    "left.shift": (42, 56),
    "right.shift": (54, 60),
    "left.alt": (56, 58),
    "space": (57, 49),
    "caps.lock": (58, 57),
}
_F_KEYS_MAC = (122, 120, 99, 118, 96, 97, 98, 100, 101, 109, 103, 111, 105, 107, 113, 106, 64, 79, 80, 90)
_EXTENDED = {
    "right.control": (97, 0x1D, 62),
    "right.alt": (100, 0x38, 61),
    "home": (102, 0x47, 115),
    "up": (103, 0x48, 126),
    "page.up": (104, 0x49, 116),
    "left": (105, 0x4B, 123),
    "right": (106, 0x4D, 124),
    "end": (107, 0x4F, 119),
    "down": (108, 0x50, 125),
    "page.down": (109, 0x51, 121),
    "insert": (110, 0x52, 114),
    "delete": (111, 0x53, 117),
    "left.win": (125, 0x5B, 55),
    "right.win": (126, 0x5C, 54),
}


def _f_key(number: int) -> KeyPlace:
    mac = _F_KEYS_MAC[number - 1]
    if number <= 10:
        return KeyPlace(58 + number, 58 + number, mac)
    if number <= 12:
        return KeyPlace(76 + number, 76 + number, mac)
    return KeyPlace(170 + number, 0x57 + number, mac)


PLACES: Mapping[str, KeyPlace] = {
    **{
        character: KeyPlace(first + index, first + index, macs[index])
        for first, row, macs in _ROWS
        for index, character in enumerate(row)
    },
    **{name: KeyPlace(code, code, mac) for name, (code, mac) in _NAMED.items()},
    **{f"f{number}": _f_key(number) for number in range(1, 21)},
    **{name: KeyPlace(evdev, EXTENDED | scan, mac) for name, (evdev, scan, mac) in _EXTENDED.items()},
}
"""The key at each place, by the place's name: the character that a US keyboard types there without Shift, or a word."""

NAME_AT_EVDEV: Mapping[int, str] = {place.evdev: name for name, place in PLACES.items()}
NAME_AT_SCAN: Mapping[int, str] = {place.scan: name for name, place in PLACES.items()}
NAME_AT_MAC: Mapping[int, str] = {place.mac: name for name, place in PLACES.items()}


_ALIASES = {"escape": "esc", "caps_lock": "caps.lock", "page_up": "page.up", "page_down": "page.down"}


def canonical(name: str) -> str:
    """Return the one name that the project uses for a key: "esc" for "escape", "w" for "W". Others stay as they are."""
    return name.lower() if len(name) == 1 else _ALIASES.get(name, name)


def is_key(name: str) -> bool:
    """Return whether a key has this name."""
    return canonical(name) in PLACES


def check_key(name: str) -> None:
    """Raise ProfileError where no key has this name."""
    if not is_key(name):
        words = ", ".join(sorted(word for word in PLACES if len(word) > 1 and "." in word))
        raise ProfileError(
            f"no key is named {name!r}: write what a US keyboard types there without Shift, or one of {words}, "
            "space, tab, enter, esc, f1 to f20 and so on"
        )


def place_of(name: str) -> KeyPlace:
    """Return the key of that name; raise ProfileError where there is none."""
    check_key(name)
    return PLACES[canonical(name)]


Layout = Mapping[str, tuple[str, str]]
"""The key that LWJGL 2 takes each place for, without and with Shift; "" for none. A name is the key's character."""

CHARACTERS = frozenset(place for place in PLACES if len(place) == 1)
"""The keys that are elsewhere under another layout: those of one character. The others are where they are in every."""

SHIFT = "right.shift"
"""The Shift that a digit is pressed with: the left one also makes the player sneak."""


@dataclass(frozen=True)
class KeyStroke:
    """A key, by its place, and whether Shift must be down for it to be the one that is meant."""

    place: str
    takes_shift: bool = False


def taken_for(place: str, layout: Layout, *, has_shift: bool) -> str:
    """Return which key LWJGL 2 takes the one at a place for; "" for none."""
    if place not in CHARACTERS:
        return place
    plain, shifted = layout.get(place, ("", ""))
    return (shifted or plain) if has_shift else plain


def stroke_for(key: str, layout: Layout) -> KeyStroke | None:
    """Return what to press so that LWJGL 2 takes it for ``key``; None where no key of the layout does.

    Only a digit is worth Shift: it acts once, and everything else is held while other keys come and go.
    """
    name = canonical(key)
    if name not in CHARACTERS:
        return KeyStroke(name)
    places = [name, *(place for place in layout if place != name)]
    for has_shift in (False, True) if name.isdigit() else (False,):
        for place in places:
            if taken_for(place, layout, has_shift=has_shift) == name:
                return KeyStroke(place, has_shift)
    return None


def missing_keys(keys: Iterable[str], layout: Layout) -> list[str]:
    """Return those of the keys that the layout has no key for."""
    return [key for key in keys if stroke_for(key, layout) is None]
