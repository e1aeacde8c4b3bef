"""The Windows desktop's code under Wine, against a window of GLFW's Windows library, as the game's is."""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mc_nested.live.model.keys import PLACES
from scripts.window_display import set_layout
from scripts.windows_parts import windows_path
from scripts.windows_session import Session
from tests.found_or_skipped import found_or_skipped
from tests.live.desktop.real_windows.sdl3_names import expected_keys
from tests.live.desktop.real_windows.window_driver import TITLE
from tests.live.desktop.sdl_releases import SDL_3_4_WINDOWS, fetch_sdl
from tests.live.desktop.test_keyboard import COMMAND, expected_events

pytestmark = pytest.mark.wine

TESTS = Path(__file__).resolve().parents[1]
WINDOW_PROBE = str(TESTS / "live" / "desktop" / "real_windows" / "window_probe.py")
LEFT_SHIFT = 340
"""GLFW's key."""
SIZE = [320, 240]
RED, BLUE = [16, 32, 255], [255, 32, 16]
"""The window's halves as pixels, blue first."""


VIRTUAL_KEYS = {
    **{key: ord(key.upper()) for key in "abcdefghijklmnopqrstuvwxyz0123456789"},
    ";": 0xBA,
    "=": 0xBB,
    ",": 0xBC,
    "-": 0xBD,
    ".": 0xBE,
    "/": 0xBF,
}
"""The virtual keys that LWJGL 2 takes for these (its WindowsKeycodes); several have its "`" and accents."""


def virtual_keys(windows: Session) -> list[str]:
    """Return a title of 1.12 and the program of a window that notes virtual keys, as the probe takes them."""
    window = windows_path(TESTS / "windows" / "virtual_key_window.py")
    return ["Minecraft 1.12.2", windows_path(windows.cache / "python" / "python.exe"), window]


def sdl_3(windows: Session) -> list[str]:
    """Return a title of 26.3 and the program of a window of Windows' SDL 3."""
    window = windows_path(TESTS / "live" / "desktop" / "real_windows" / "sdl3_window.py")
    library = windows_path(found_or_skipped(lambda: fetch_sdl(SDL_3_4_WINDOWS, print)))
    return ["Minecraft 26.3 - Singleplayer", windows_path(windows.cache / "python" / "python.exe"), window, library]


def report_of(windows: Session, *arguments: str) -> Any:
    code, printed = windows.python(*arguments, timeout_s=120)
    assert code == 0, printed
    return json.loads(printed)


@pytest.fixture(scope="module")
def report(windows: Session) -> dict[str, Any]:
    found: dict[str, Any] = report_of(windows, "-m", "tests.windows.desktop_probe")
    return found


def test_key_of_each_place_reaches_the_window_as_the_key_of_that_place(windows: Session) -> None:
    assert report_of(windows, WINDOW_PROBE, "keys", json.dumps(list(PLACES))) == expected_events()


def test_typed_command_reaches_the_window_letter_for_letter(windows: Session) -> None:
    assert report_of(windows, WINDOW_PROBE, "text", json.dumps(COMMAND)) == {"text": COMMAND}


@pytest.fixture(params=["fr", "de", "ru"])
def other_layout(request: pytest.FixtureRequest, windows: Session) -> Iterator[None]:
    """Set another keyboard layout, which Wine's programs take from the screen as they start.

    It is not a variant, as Dvorak's is.
    """
    set_layout(request.param, windows.env)
    yield
    set_layout("us", windows.env)


@pytest.mark.usefixtures("other_layout")
def test_on_other_layouts_keys_reach_the_window_by_place_and_text_letter_for_letter(windows: Session) -> None:
    assert report_of(windows, WINDOW_PROBE, "keys", json.dumps(list(PLACES))) == expected_events()
    assert report_of(windows, WINDOW_PROBE, "text", json.dumps(COMMAND)) == {"text": COMMAND}


@pytest.mark.usefixtures("other_layout")
def test_on_other_layouts_1_12_gets_a_key_by_its_virtual_key_or_the_key_is_refused(windows: Session) -> None:
    report = report_of(windows, WINDOW_PROBE, "profile keys", json.dumps(sorted(VIRTUAL_KEYS)), *virtual_keys(windows))
    arrived = {key for key, came in report["keys"].items() if isinstance(came, list)}
    assert {"w", "s", "a", "d", "t"} <= arrived or "types no w, s, a, d, t" in report["refused"]
    for key, came in report["keys"].items():
        if isinstance(came, list):
            assert came == [[VIRTUAL_KEYS[key], 1], [VIRTUAL_KEYS[key], 0]]
        else:
            # Wine 8 has no virtual key for a key whose letter isn's ASCII, as some French digits and Russian ones.
            assert f"types no {key}: switch to English (US)" in came


@pytest.mark.parametrize("layout", ["us", "fr"])
def test_sdl_3_window_gets_keys_by_place_text_letter_for_letter_and_clicks_without_motion(
    layout: str, windows: Session
) -> None:
    program = sdl_3(windows)
    places = ("w", "a", "1", ";", "left.shift", "f3", "enter")
    set_layout(layout, windows.env)
    try:
        keys = report_of(windows, WINDOW_PROBE, "keys", json.dumps(places), *program)
        assert keys == {place: expected_keys()[place] for place in places}
        assert report_of(windows, WINDOW_PROBE, "text", json.dumps(COMMAND), *program) == {"text": COMMAND}
    finally:
        set_layout("us", windows.env)
    if layout == "us":
        clicks = report_of(windows, WINDOW_PROBE, "clicks", "null", *program)
        assert (clicks["button"], clicks["cursor"]) == (200, 0)
        focus = report_of(windows, WINDOW_PROBE, "focus", "null", *program)
        assert focus == {"in front": [[True, True], [False, False], [True, True]], "keys": []}


def test_clicks_do_not_move_the_cursor(windows: Session) -> None:
    clicks = report_of(windows, WINDOW_PROBE, "clicks")
    assert clicks["has raw motion"]
    assert clicks["cursor"] == 0
    assert clicks["button"] >= 200


def test_the_panic_key_and_hotkeys_are_heard(windows: Session) -> None:
    assert report_of(windows, WINDOW_PROBE, "hotkeys") == {
        "stopped": ["the panic key was pressed"],
        "hotkeys": ["q"],
    }


def test_key_pressed_as_soon_as_a_listener_is_open_is_heard(windows: Session) -> None:
    assert report_of(windows, WINDOW_PROBE, "at once") == {"heard": 50}


def test_window_has_the_size_title_and_program_that_glfw_gives_it(report: dict[str, Any]) -> None:
    place = report["place"]
    assert (place["size"], place["title"], place["is in front"]) == (SIZE, TITLE, True)
    assert place["of GLFW"]["size"] == SIZE
    assert place["programs"][TITLE] == "python.exe GLFW30"


def test_picture_has_the_pixels_of_the_window(report: dict[str, Any]) -> None:
    grab = report["grab"]
    assert grab["shape"] == [SIZE[1], SIZE[0], 3]
    assert (grab["left"], grab["right"]) == ([RED], [BLUE])
    assert sorted(grab["middle"]) == sorted([RED, BLUE])


def test_a_held_key_is_one_press_and_one_release(report: dict[str, Any]) -> None:
    assert len(report["hold"]) == 10
    for hold in report["hold"]:
        assert [[key, action] for key, _, action in hold["events"] if action != 2] == [[ord("W"), 1], [ord("W"), 0]]
        assert hold["held"] >= 0.15


def test_a_held_shift_stays_down_while_other_keys_come_and_go(report: dict[str, Any]) -> None:
    step = [[ord("W"), 1], [ord("W"), 0]]
    assert report["sneak"] == [[LEFT_SHIFT, 1], *step, *step, [LEFT_SHIFT, 0]]


def test_the_free_cursor_goes_where_it_is_sent_and_every_button_arrives(report: dict[str, Any]) -> None:
    sent = [[0.0, 0.0], [100.0, 50.0], [160.0, 120.0], [319.0, 239.0]]
    for at, (seen,) in zip(sent, report["pointer"]["cursor"], strict=True):
        assert math.dist(at, seen) <= 1
    assert report["pointer"]["buttons"] == [[0, 1], [0, 0], [1, 1], [1, 0], [2, 1], [2, 0]]


def test_clipboard_returns_the_text_that_was_written(report: dict[str, Any]) -> None:
    assert report["clipboard"]["read"] == "/execute in minecraft:overworld run tp @s 0.5 64 é"


def test_mouse_pushed_into_any_corner_sets_off_the_panic_switch(report: dict[str, Any]) -> None:
    assert len(report["corner"]) == 4
    assert all(len(said) == 1 and "corner" in said[0] for said in report["corner"]), report["corner"]


def test_window_partly_off_the_screen_is_an_error_that_says_to_move_it(report: dict[str, Any]) -> None:
    assert "move it" in report["edge"]["error"]
