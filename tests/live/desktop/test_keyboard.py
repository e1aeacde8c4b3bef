"""The real keyboard: what it sends, and what of it reaches a real GLFW window under each layout."""

import subprocess
import sys

import pytest

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live.desktop.keyboard import DesktopKeyboard
from mc_nested.live.desktop.lost_display import LOST
from mc_nested.live.model.keys import PLACES, KeyPlace, Layout
from tests.live.desktop.real_windows.probed import glfw_probed, probed

LAYOUTS = ("us", "fr", "de", "dvorak", "ru")
COMMAND = "/execute if block ~ ~-1 ~ minecraft:oak_planks[axis=x] run tp @s 1.5 64 -3 {\"A\":'!#$%&*()+;<>?^`|\\\\J'}"

_PRESSED, _RELEASED = 1, 0
_WORDS = {
    name: first + index
    for first, names in (
        (32, "space"),
        (256, "esc enter tab backspace insert delete right left down up page.up page.down home end"),
        (280, "caps.lock"),
        (290, " ".join(f"f{number}" for number in range(1, 21))),
        (340, "left.shift left.control left.alt left.win right.shift right.control right.alt right.win"),
    )
    for index, name in enumerate(names.split())
}
"""GLFW's keys (glfw3.h); those of characters are the capital's number."""


def expected_events() -> dict[str, list[list[int]]]:
    """Return GLFW's key, pressed and released, for each place."""
    keys = {name: _WORDS.get(name) or ord(name.upper()) for name in PLACES}
    return {name: [[key, _PRESSED], [key, _RELEASED]] for name, key in keys.items()}


class Sender:
    """Notes what is sent, as long as there is a display."""

    def __init__(self, made: Layout | None = None) -> None:
        self.made = made
        self.sent: list[tuple[KeyPlace, bool] | str] = []
        self.has_display = True

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        self._note((place, is_down))

    def type(self, character: str) -> None:
        self._note(character)

    def layout(self) -> Layout | None:
        return self.made

    def _note(self, what: tuple[KeyPlace, bool] | str) -> None:
        if not self.has_display:
            raise LOST[0]("gone")
        self.sent.append(what)


def test_keys_are_sent_by_their_places_and_text_by_its_characters_in_order() -> None:
    sender = Sender()
    keyboard = DesktopKeyboard(sender)
    keyboard.press("f3")
    keyboard.press("W")
    keyboard.release("w")
    keyboard.type("/Tp")
    assert sender.sent == [(PLACES["f3"], True), (PLACES["w"], True), (PLACES["w"], False), "/", "T", "p"]


def test_an_unknown_key_name_is_refused_before_anything_is_sent() -> None:
    sender = Sender()
    keyboard = DesktopKeyboard(sender)
    for act in (keyboard.press, keyboard.release):
        with pytest.raises(ProfileError, match="no key is named 'shift'"):
            act("shift")
    assert sender.sent == []


def test_the_key_that_makes_the_symbol_is_pressed_for_a_game_that_goes_by_symbols() -> None:
    sender = Sender({"w": ("z", "z"), "z": ("w", "w"), "1": ("", "1")})
    keyboard = DesktopKeyboard(sender)
    keyboard.go_by_symbols(["w", "1"])
    keyboard.press("W")
    keyboard.release("w")
    assert sender.sent == [(PLACES["z"], True), (PLACES["z"], False)]


def test_the_right_shift_is_held_around_a_digit_that_needs_it() -> None:
    sender = Sender({"1": ("", "1")})
    keyboard = DesktopKeyboard(sender)
    keyboard.go_by_symbols(["1"])
    keyboard.press("1")
    keyboard.release("1")
    shift, one = PLACES["right.shift"], PLACES["1"]
    assert sender.sent == [(shift, True), (one, True), (one, False), (shift, False)]


def test_a_release_goes_to_the_pressed_place_although_the_layout_has_changed() -> None:
    sender = Sender({"w": ("z", "z"), "z": ("w", "w")})
    keyboard = DesktopKeyboard(sender)
    keyboard.go_by_symbols(["w"])
    keyboard.press("w")
    sender.made = {"w": ("", "")}
    keyboard.release("w")
    assert sender.sent == [(PLACES["z"], True), (PLACES["z"], False)]
    keyboard.release("w")
    assert len(sender.sent) == 2, "there is no such key any more"


def test_a_layout_that_lacks_the_symbols_is_a_one_line_error_and_no_key_is_pressed() -> None:
    sender = Sender({"w": ("", "w"), "1": ("1", "")})
    keyboard = DesktopKeyboard(sender)
    with pytest.raises(DesktopError, match="types no w, s: switch to English \\(US\\)") as raised:
        keyboard.go_by_symbols(["w", "1", "s", "f3"])
    assert "\n" not in str(raised.value)
    with pytest.raises(DesktopError, match="types no w:"):
        keyboard.press("w")
    assert sender.sent == []


def test_keys_go_by_place_on_a_desktop_without_a_symbol_layout() -> None:
    sender = Sender()
    keyboard = DesktopKeyboard(sender)
    keyboard.go_by_symbols(["w"])
    keyboard.press("w")
    assert sender.sent == [(PLACES["w"], True)]


@pytest.mark.skipif(not LOST, reason="the display of an X server")
def test_pressing_or_typing_without_a_display_is_an_error_but_releasing_is_not() -> None:
    sender = Sender()
    sender.has_display = False
    keyboard = DesktopKeyboard(sender)
    for act in (keyboard.press, keyboard.type):
        with pytest.raises(DesktopError, match="display has closed"):
            act("w")
    keyboard.release("w")


if sys.platform.startswith("linux"):

    @pytest.mark.window
    @pytest.mark.parametrize("layout", LAYOUTS)
    def test_each_place_reaches_a_real_window_as_the_key_of_that_place(layout: str, x_screen: dict[str, str]) -> None:
        subprocess.run(["setxkbmap", layout], env=x_screen, check=True)
        assert glfw_probed(x_screen, "keys", list(PLACES)) == expected_events()

    @pytest.mark.window
    @pytest.mark.parametrize("layout", LAYOUTS)
    def test_a_command_reaches_a_real_window_to_the_letter(layout: str, x_screen: dict[str, str]) -> None:
        subprocess.run(["setxkbmap", layout], env=x_screen, check=True)
        assert glfw_probed(x_screen, "text", COMMAND) == {"text": COMMAND}

    @pytest.mark.window
    def test_a_character_that_the_layout_lacks_is_an_error_of_one_line(x_screen: dict[str, str]) -> None:
        assert glfw_probed(x_screen, "text", "木") == {
            "error": "'木' can't be typed with this keyboard layout: switch to a Latin one"
        }


@pytest.mark.standin
def test_keys_reach_a_real_window_as_from_a_real_keyboard(x_server: dict[str, str]) -> None:
    report = probed(x_server, "keyboard")
    keys = [(event[0], event[2]) for event in report["keys"]]
    assert keys == [("press", False), ("release", False)] * 4, "as a keyboard's own, not as synthetic events"
    assert [event[1] for event in report["keys"] if event[0] == "press"] == [ord("w"), 0xFFC0, 0xFFE1, ord("/")]
    assert "no key is named 'é'" in report["no such key"]
    assert report["typed"] == "/Tp @s"
