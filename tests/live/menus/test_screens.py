"""Identifying the screen that is shown: by its labels, and by recorded points where there are none."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.menus.click_points import record_point
from mc_nested.live.menus.screens import identify_screen
from tests.live.menus.fake_menus import BUTTONS, PROBLEM, FakeMenus


def identify(menus: FakeMenus, *points: str) -> tuple[str, str]:
    """Return the screen, with points of these names recorded in a row on the picture that is shown now."""
    recordings = {
        name: record_point(name, menus.frame, (200, 60 + 60 * row), menus.scale) for row, name in enumerate(points)
    }
    return identify_screen(menus, menus, recordings)


def noise(seed: int) -> Frame:
    return np.random.default_rng(seed).integers(0, 256, (480, 854, 3), np.uint8)


def test_a_readable_debug_screen_is_the_world_and_no_menu_is_looked_for() -> None:
    assert identify(FakeMenus()) == ("world", "")


def test_an_open_chat_over_the_debug_screen_is_the_chat() -> None:
    assert identify(FakeMenus("chat")) == ("chat", "")


@pytest.mark.parametrize("shown", ["pause", "death", "disconnected", "servers", "title", "worlds"])
def test_a_menu_is_known_by_its_labels_and_the_readers_problem_is_kept(shown: str) -> None:
    assert identify(FakeMenus(shown)) == (shown, PROBLEM)


@pytest.mark.parametrize("label", ["Back to server list", "Back to Title Screen", "Back to title screen"])
def test_every_versions_label_of_the_disconnected_screen_is_known(label: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(BUTTONS, "disconnected", {label: (427, 250)})
    assert identify(FakeMenus("disconnected")) == ("disconnected", PROBLEM)


def test_a_menu_is_known_by_a_greyed_button_too() -> None:
    assert identify(FakeMenus("death", greyed={"Respawn"})) == ("death", PROBLEM)


def test_an_open_chat_without_a_debug_screen_is_the_chat() -> None:
    assert identify(FakeMenus("chat", has_debug=False)) == ("chat", PROBLEM)


def test_a_screen_without_a_known_label_or_point_is_unknown() -> None:
    assert identify(FakeMenus("inventory")) == ("unknown", PROBLEM)
    assert identify(FakeMenus("title", labels=set())) == ("unknown", PROBLEM)


@pytest.mark.parametrize(
    ("point", "name"),
    [("back_to_game", "pause"), ("respawn", "death"), ("singleplayer", "title"), ("play_selected_world", "worlds")],
)
def test_a_screen_without_labels_is_known_by_its_point(point: str, name: str) -> None:
    menus = FakeMenus("inventory", frame=noise(1))
    assert identify(menus, point) == (name, PROBLEM)


def test_points_that_identify_no_screen_are_not_compared() -> None:
    assert identify(FakeMenus("inventory", frame=noise(1)), "world", "save_and_quit_to_title")[0] == "unknown"


def test_a_point_that_does_not_look_like_its_picture_is_passed_over() -> None:
    menus = FakeMenus("inventory", frame=noise(1))
    shown, other = (record_point("x", frame, (200, 60), 2) for frame in (menus.frame, noise(2)))
    assert identify_screen(menus, menus, {"back_to_game": other})[0] == "unknown"
    assert identify_screen(menus, menus, {"back_to_game": other, "singleplayer": shown})[0] == "title"
