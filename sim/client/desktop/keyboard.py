"""The virtual keyboard: keys at their places, which make what a layout has there (X11's layouts, xkb-data 2.35).

To 1.12 the game, too, knows a key by what the layout has at its place (FACTS: Input and windows).
"""

from functools import partial

from mc_nested.live.model.keys import CHARACTERS, NAME_AT_EVDEV, KeyPlace, Layout, canonical, taken_for
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls

_PLACES = "1234567890-=qwertyuiop[]asdfghjkl;'`\\zxcvbnm,./"
_ROWS = {
    "us": (
        "1234567890-=qwertyuiop[]asdfghjkl;'`\\zxcvbnm,./",
        '!@#$%^&*()_+QWERTYUIOP{}ASDFGHJKL:"~|ZXCVBNM<>?',
    ),
    "gb": (
        "1234567890-=qwertyuiop[]asdfghjkl;'`#zxcvbnm,./",
        '!"·$%^&*()_+QWERTYUIOP{}ASDFGHJKL:@·~ZXCVBNM<>?',
    ),
    "de": (
        "1234567890··qwertzuiop·+asdfghjkl···#yxcvbnm,.-",
        "!\"·$%&/()=?·QWERTZUIOP·*ASDFGHJKL···'YXCVBNM;:_",
    ),
    "fr": (
        "&·\"'(-·_··)=azertyuiop·$qsdfghjklm··*wxcvbn,;:!",
        "1234567890·+AZERTYUIOP··QSDFGHJKLM%~·WXCVBN?./·",
    ),
    "be": (
        "&·\"'(··!··)-azertyuiop·$qsdfghjklm···wxcvbn,;:=",
        "1234567890·_AZERTYUIOP·*QSDFGHJKLM%··WXCVBN?./+",
    ),
    "es": (
        "1234567890'·qwertyuiop·+asdfghjkl····zxcvbnm,.-",
        '!"·$%&/()=?·QWERTYUIOP·*ASDFGHJKL····ZXCVBNM;:_',
    ),
    "it": (
        "1234567890'·qwertyuiop·+asdfghjkl··\\·zxcvbnm,.-",
        '!"·$%&/()=?^QWERTYUIOP·*ASDFGHJKL··|·ZXCVBNM;:_',
    ),
    "pt": (
        "1234567890'·qwertyuiop+·asdfghjkl··\\·zxcvbnm,.-",
        '!"#$%&/()=?·QWERTYUIOP*·ASDFGHJKL··|·ZXCVBNM;:_',
    ),
    "se": (
        "1234567890+·qwertyuiop··asdfghjkl···'zxcvbnm,.-",
        '!"#·%&/()=?·QWERTYUIOP··ASDFGHJKL···*ZXCVBNM;:_',
    ),
    "pl": (
        "1234567890-=qwertyuiop[]asdfghjkl;'`\\zxcvbnm,./",
        '!@#$%^&*()_+QWERTYUIOP{}ASDFGHJKL:"~|ZXCVBNM<>?',
    ),
    "cz": (
        "+·········=·qwertzuiop·)asdfghjkl··;·yxcvbnm,.-",
        "1234567890%·QWERTZUIOP/(ASDFGHJKL\"!·'YXCVBNM?:_",
    ),
    "tr": (
        '1234567890*-qwertyu·op··asdfghjkl·i",zxcvbnm··.',
        "!'^+%&/()=?_QWERTYUIOP··ASDFGHJKL···;ZXCVBNM··:",
    ),
    "ru": (
        "1234567890-=························\\·········.",
        '!"·;%:?*()_+························/·········,',
    ),
    "gr": (
        "1234567890-=;·········[]··········'`\\·······,./",
        '!@#$%^&*()_+:·········{}··········"~|·······<>?',
    ),
    "il": (
        "1234567890-=/'········][··········,;\\·········.",
        '!@#$%^&*)(_+QWERTYUIOP}{ASDFGHJKL:"~|ZXCVBNM><?',
    ),
    "dvorak": (
        "1234567890[]',.pyfgcrl/=aoeuidhtns-`\\;qjkxbmwvz",
        '!@#$%^&*(){}"<>PYFGCRL?+AOEUIDHTNS_~|:QJKXBMWVZ',
    ),
}
"""What each place makes, in the order of _PLACES: without Shift, and with it. A dot is an accent, or isn't ASCII's."""

_LWJGL_2 = CHARACTERS - {"\\"} | set("@:^_")
"""LWJGL 2's keys, by their characters, as it finds them on X11."""

LAYOUTS = tuple(_ROWS)
"""The layouts, by their names on X11."""


def characters_of(layout: str) -> Layout:
    """Return what each place types without Shift and with it."""
    plain, shifted = _ROWS[layout]
    return {place: (plain[at], shifted[at]) for at, place in enumerate(_PLACES)}


def taken_by_lwjgl(characters: Layout) -> Layout:
    """Return, by place, the keys that LWJGL 2 takes the places for that type these characters; "" for none."""
    return {place: (key_of(plain), key_of(shifted)) for place, (plain, shifted) in characters.items()}


def key_of(character: str) -> str:
    """Return the key that LWJGL 2 has for a character; "" for none."""
    key = character.lower()
    return key if key in _LWJGL_2 else ""


_SHIFTS = frozenset({"left.shift", "right.shift"})


class VirtualKeySender:
    """Keys and characters that reach the game through its window, as a desktop sends them.

    A key that is pressed also types what the layout has there. Typed text presses the keys that have its characters,
    as text does on X11 and macOS; a character that is on no key comes alone, as every one does on Windows.

    Args:
        window: which gets them while it is in front.
        controls: what they do in the game.
        layout: the layout's name, of ``LAYOUTS``.
        is_lwjgl_2: whether the game takes a key by what it makes, as to 1.12, and not by its place.
    """

    def __init__(
        self, window: VirtualWindow, controls: Controls, layout: str = "us", *, is_lwjgl_2: bool = False
    ) -> None:
        self._window, self._controls, self._is_lwjgl_2 = window, controls, is_lwjgl_2
        self._characters = characters_of(layout)
        self._lwjgl = taken_by_lwjgl(self._characters)
        self._places = {plain: place for place, (plain, _) in self._characters.items()}

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        name = NAME_AT_EVDEV[place.evdev]
        has_shift = bool(_SHIFTS & self._window.down)
        plain, shifted = self._characters.get(name, (" ", " ") if name == "space" else ("", ""))
        key = taken_for(name, self._lwjgl, has_shift=has_shift) if self._is_lwjgl_2 else name
        if is_down:
            self._window.press(name, partial(self._go_down, key, shifted if has_shift else plain))
        else:
            self._window.release(name, partial(self._go_up, key))

    def type(self, character: str) -> None:
        name = "space" if character == " " else canonical(character)
        key = name if self._is_lwjgl_2 else self._places.get(name, name)
        self._window.press(character, partial(self._go_down, key, character))
        self._window.release(character, partial(self._go_up, key))

    def layout(self) -> Layout:
        return self._lwjgl

    def _go_down(self, key: str, typed: str) -> None:
        if key:
            self._controls.key(key, is_down=True)
        if typed:
            self._controls.character(typed)

    def _go_up(self, key: str) -> None:
        if key:
            self._controls.key(key, is_down=False)
