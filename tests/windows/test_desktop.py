"""The Windows desktop's code under Wine, against a window of GLFW's Windows library, as the game's is."""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mc_nested.live.model.key_places import PLACES
from scripts.window_display import set_layout
from scripts.windows_session import Session
from tests.live.desktop.test_keyboard import COMMAND, expected_events
from tests.live.desktop.window_driver import TITLE

pytestmark = pytest.mark.wine

TESTS = Path(__file__).resolve().parents[1]
GLFW_PROBE = str(TESTS / "live" / "desktop" / "window_probe.py")
LEFT_SHIFT = 340
"""GLFW's key."""
SIZE = [320, 240]
RED, BLUE = [16, 32, 255], [255, 32, 16]
"""The window's halves as pixels, blue first."""


def report_of(windows: Session, *arguments: str) -> Any:
    code, printed = windows.python(*arguments, timeout_s=120)
    assert code == 0, printed
    return json.loads(printed)


@pytest.fixture(scope="module")
def report(windows: Session) -> dict[str, Any]:
    found: dict[str, Any] = report_of(windows, "-m", "tests.windows.desktop_probe")
    return found


def test_each_place_reaches_the_window_as_the_key_of_that_place(windows: Session) -> None:
    assert report_of(windows, GLFW_PROBE, "keys", json.dumps(list(PLACES))) == expected_events()


def test_a_command_reaches_the_window_to_the_letter(windows: Session) -> None:
    assert report_of(windows, GLFW_PROBE, "text", json.dumps(COMMAND)) == {"text": COMMAND}


@pytest.fixture(params=["fr", "de", "ru"])
def other_layout(request: pytest.FixtureRequest, windows: Session) -> Iterator[None]:
    """Another keyboard layout, which Wine's programs take from the screen as they start; not a variant, as Dvorak's."""
    set_layout(request.param, windows.env)
    yield
    set_layout("us", windows.env)


@pytest.mark.usefixtures("other_layout")
def test_on_other_layouts_each_place_is_the_same_and_text_is_to_the_letter(windows: Session) -> None:
    assert report_of(windows, GLFW_PROBE, "keys", json.dumps(list(PLACES))) == expected_events()
    assert report_of(windows, GLFW_PROBE, "text", json.dumps(COMMAND)) == {"text": COMMAND}


def test_clicks_move_nothing(windows: Session) -> None:
    clicks = report_of(windows, GLFW_PROBE, "clicks")
    assert clicks["has raw motion"]
    assert clicks["cursor"] == 0
    assert clicks["button"] >= 200


def test_the_panic_key_and_hotkeys_are_heard(windows: Session) -> None:
    assert report_of(windows, GLFW_PROBE, "hotkeys") == {
        "stopped": ["the panic key was pressed"],
        "hotkeys": ["q"],
    }


def test_the_window_is_where_and_what_it_is(report: dict[str, Any]) -> None:
    place = report["place"]
    assert (place["size"], place["title"], place["is in front"]) == (SIZE, TITLE, True)
    assert place["of GLFW"]["size"] == SIZE


def test_a_picture_is_the_windows_own_pixels(report: dict[str, Any]) -> None:
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


def test_the_clipboard_holds_what_was_written(report: dict[str, Any]) -> None:
    assert report["clipboard"]["read"] == "/execute in minecraft:overworld run tp @s 0.5 64 é"


def test_a_mouse_pushed_into_any_corner_stops(report: dict[str, Any]) -> None:
    assert len(report["corner"]) == 4
    assert all(len(said) == 1 and "corner" in said[0] for said in report["corner"]), report["corner"]


def test_a_window_partly_off_the_screen_is_an_error_and_no_black_picture(report: dict[str, Any]) -> None:
    assert "move it" in report["edge"]["error"]
