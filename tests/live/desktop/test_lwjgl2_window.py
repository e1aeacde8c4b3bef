"""The project's own keys, text and clicks reach a window of LWJGL 2, the game's to 1.12."""

import sys

import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("windows on an X server", allow_module_level=True)

from mc_nested.live.model.keys import CHARACTERS, taken_for
from scripts.window_display import set_layout
from sim.client.desktop.keyboard import LAYOUTS, characters_of, taken_by_lwjgl
from tests.live.desktop.real_windows.game_window_fixtures import desktop, lwjgl_program
from tests.live.desktop.real_windows.probed import window_probed
from tests.live.desktop.test_keyboard import COMMAND

pytestmark = pytest.mark.window

__all__ = ["desktop", "lwjgl_program"]

TITLE = "Minecraft 1.12.2"
WITHOUT_LATIN_LETTERS = ("ru", "gr", "il")
_NAMES = {"": "NONE", ",": "COMMA", "-": "MINUS", ".": "PERIOD", "/": "SLASH", ";": "SEMICOLON", "=": "EQUALS"} | {
    "[": "LBRACKET",
    "]": "RBRACKET",
    "'": "APOSTROPHE",
    "`": "GRAVE",
    "@": "AT",
    ":": "COLON",
    "^": "CIRCUMFLEX",
    "_": "UNDERLINE",
}
"""LWJGL's names of keys, where they aren't their characters'."""

SHIFT = "RSHIFT"


def pressed(key: str, *, has_shift: bool = False) -> list[list[object]]:
    """Return LWJGL's key, pressed and released, perhaps with the right Shift around it."""
    name = _NAMES.get(key, key.upper())
    events: list[list[object]] = [[name, 1], [name, 0]]
    return [[SHIFT, 1], *events, [SHIFT, 0]] if has_shift else events


@pytest.mark.parametrize("layout", LAYOUTS)
def test_lwjgl_2_takes_keys_by_layout_and_the_keyboard_finds_each_symbols_key(
    layout: str, desktop: dict[str, str], lwjgl_program: list[str]
) -> None:
    set_layout(layout, desktop)
    report = window_probed(desktop, "symbols", sorted(CHARACTERS), TITLE, lwjgl_program)
    made = taken_by_lwjgl(characters_of(layout))
    accents = {place for place, came in report["alone"].items() if not came}
    assert not any(made[place][0] for place in accents)
    for has_shift, kind in ((False, "alone"), (True, "shifted")):
        for place in CHARACTERS - accents:
            came = report[kind][place]
            if came:
                assert came == pressed(taken_for(place, made, has_shift=has_shift)), "as the virtual client has it"
            else:
                assert (kind, made[place][1]) == ("shifted", ""), "an accent beside Shift"
    plain, shifted = ({keys[at] for keys in made.values()} for at in (0, 1))
    for key, came in report["keys"].items():
        if key in plain:
            assert came == pressed(key)
        elif key.isdigit() and key in shifted:
            assert came == pressed(key, has_shift=True)
        else:
            assert f"types no {key}: switch to English (US)" in came
    if layout in WITHOUT_LATIN_LETTERS:
        assert "types no w, s, a, d, t:" in report["refused"]
    else:
        assert "refused" not in report


@pytest.mark.parametrize("layout", ["us", "de", "fr", "ru"])
def test_text_arrives_to_the_letter(layout: str, desktop: dict[str, str], lwjgl_program: list[str]) -> None:
    set_layout(layout, desktop)
    assert window_probed(desktop, "text", COMMAND, TITLE, lwjgl_program) == {"text": COMMAND}


def test_a_hundred_clicks_do_not_move_a_held_mouse(desktop: dict[str, str], lwjgl_program: list[str]) -> None:
    clicks = window_probed(desktop, "clicks", None, TITLE, lwjgl_program)
    assert clicks == {"has raw motion": True, "moves": True, "button": 200, "cursor": 0}


def test_the_window_is_in_front_only_with_the_focus_and_gets_no_keys_without_it(
    desktop: dict[str, str], lwjgl_program: list[str]
) -> None:
    report = window_probed(desktop, "focus", None, TITLE, lwjgl_program)
    assert report == {"in front": [[True, True], [False, False], [True, True]], "keys": []}
