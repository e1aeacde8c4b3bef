"""What the keys of the virtual keyboard make under each layout, as the layouts of X11 have them (xkb-data 2.35).

To 1.12 that is also the key that the game takes each for (FACTS: Input and windows).
"""

from mc_nested.live.model.key_symbols import CHARACTERS, Layout

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
"""Its keys, by their characters, as it finds them on X11."""

LAYOUTS = tuple(_ROWS)
"""The layouts, by their names on X11."""


def characters_of(layout: str) -> Layout:
    """What each place types without Shift and with it."""
    plain, shifted = _ROWS[layout]
    return {place: (plain[at], shifted[at]) for at, place in enumerate(_PLACES)}


def taken_by_lwjgl(characters: Layout) -> Layout:
    """The keys that LWJGL 2 takes the places for that type these characters; "" for none."""
    return {place: (key_of(plain), key_of(shifted)) for place, (plain, shifted) in characters.items()}


def key_of(character: str) -> str:
    """The key that LWJGL 2 has for a character; "" for none."""
    key = character.lower()
    return key if key in _LWJGL_2 else ""
