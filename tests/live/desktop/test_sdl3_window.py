"""The project's own keys, text and clicks reach a window of SDL 3, the game's from 26.3 on."""

import sys
from collections.abc import Iterator

import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("windows on an X server", allow_module_level=True)

from mc_nested.live.model.keys import PLACES
from scripts.window_display import set_layout
from tests.live.desktop.real_windows.game_window_fixtures import desktop, sdl_program
from tests.live.desktop.real_windows.probed import window_probed
from tests.live.desktop.real_windows.sdl3_names import expected_keys
from tests.live.desktop.test_keyboard import COMMAND

pytestmark = pytest.mark.window

__all__ = ["desktop", "sdl_program"]

TITLE = "Minecraft 26.3 - Singleplayer"


@pytest.fixture(params=["us", "de", "fr", "ru"])
def layout(request: pytest.FixtureRequest, desktop: dict[str, str]) -> Iterator[None]:
    set_layout(request.param, desktop)
    yield
    set_layout("us", desktop)


@pytest.mark.usefixtures("layout")
def test_keys_go_by_place_and_text_arrives_to_the_letter(desktop: dict[str, str], sdl_program: list[str]) -> None:
    assert window_probed(desktop, "keys", list(PLACES), TITLE, sdl_program) == expected_keys()
    assert window_probed(desktop, "text", COMMAND, TITLE, sdl_program) == {"text": COMMAND}


def test_a_hundred_clicks_do_not_move_a_held_mouse(desktop: dict[str, str], sdl_program: list[str]) -> None:
    clicks = window_probed(desktop, "clicks", None, TITLE, sdl_program)
    assert (clicks["button"], clicks["cursor"]) == (200, 0)
    assert clicks["moves"] is (sdl_program[-1].endswith(".0.4.18")), "SDL 3.2 takes no absolute movement for one, here"


def test_the_window_is_in_front_only_with_the_focus_and_gets_no_keys_without_it(
    desktop: dict[str, str], sdl_program: list[str]
) -> None:
    report = window_probed(desktop, "focus", None, TITLE, sdl_program)
    assert report == {"in front": [[True, True], [False, False], [True, True]], "keys": []}
