"""GLFW's keys, by the place where a keyboard of the United States has them, as profiles name keys (FACTS: Keys)."""

from sim.client.desktop.keyboard import key_of

_WORDS = {
    32: "space",
    256: "esc",
    257: "enter",
    258: "tab",
    259: "backspace",
    260: "insert",
    261: "delete",
    262: "right",
    263: "left",
    264: "down",
    265: "up",
    266: "page.up",
    267: "page.down",
    268: "home",
    269: "end",
    280: "caps.lock",
    340: "left.shift",
    341: "left.control",
    342: "left.alt",
    343: "left.win",
    344: "right.shift",
    345: "right.control",
    346: "right.alt",
    347: "right.win",
}
_FIRST_FUNCTION_KEY = 290
_CHARACTERS = "abcdefghijklmnopqrstuvwxyz0123456789`-=[]\\;',./"

PLACES: dict[int, str] = (
    _WORDS
    | {ord(character.upper()): character for character in _CHARACTERS}
    | {_FIRST_FUNCTION_KEY + number: f"f{number + 1}" for number in range(20)}
)
"""The name of each place, by GLFW's number of its key (glfw3.h)."""


def symbol_at(place: str, made: str | None, *, has_shift: bool) -> str:
    """Return the key that LWJGL 2 takes, to 1.12, for the one at a place (FACTS: Input and windows); "" for none.

    ``made`` is the character of the key without Shift, as GLFW says. GLFW doesn't say the character with Shift. On the
    layouts known here the game uses only digits among those, on keys that make no digit without Shift.
    """
    if len(place) > 1:
        return place
    plain = key_of(made or "")
    return place if has_shift and place.isdigit() and not plain.isdigit() else plain
