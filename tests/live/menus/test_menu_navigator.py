"""Leaving a screen: the button with its label, else its point, else nothing at all."""

import numpy as np
import pytest

from mc_nested.live.menus.click_points import ClickPoints, record_point
from mc_nested.live.menus.menu_navigator import MenuNavigator
from mc_nested.live.menus.screens import ScreenName, menu_name
from mc_nested.live.profile.tables import GameVersion, Profile, WorldTable
from tests.live.menus.fake_menus import BUTTONS, FakeMenus, connection_of

OWN_WORLD = Profile(world=WorldTable(folder="~/saves/arena", template="~/template", name="Arena"))


def navigator_in(menus: FakeMenus, profile: Profile | None = None, points: ClickPoints | None = None) -> MenuNavigator:
    return MenuNavigator(profile or Profile(), connection_of(menus), points or {})


def point_in(menus: FakeMenus, name: str, at: tuple[int, int] = (200, 60)) -> ClickPoints:
    """A point recorded on the picture that is shown now."""
    menus.frame = np.random.default_rng(1).integers(0, 256, (480, 854, 3), np.uint8)
    return {name: record_point(name, menus.frame, at, menus.scale)}


@pytest.mark.parametrize(
    ("name", "label", "after"),
    [
        ("pause", "Back to Game", "world"),
        ("death", "Respawn", "world"),
        ("disconnected", "Back to Server List", "servers"),
        ("title", "Singleplayer", "worlds"),
    ],
)
def test_a_screen_is_left_by_its_button(name: ScreenName, label: str, after: str) -> None:
    menus = FakeMenus(name)
    navigator_in(menus).leave(name)
    assert menus.pressed == [BUTTONS[name][label]]
    assert menus.shown == after


def test_the_chat_is_left_by_esc() -> None:
    menus = FakeMenus("chat")
    navigator_in(menus).leave("chat")
    assert (menus.pressed, menus.shown) == (["esc"], "world")


def test_saving_and_quitting_leads_from_the_pause_menu_to_the_title() -> None:
    menus = FakeMenus("pause")
    navigator_in(menus).save_and_quit()
    assert (menus.pressed, menus.shown) == ([(427, 200)], "title")


def test_a_greyed_button_is_not_clicked() -> None:
    menus = FakeMenus("death", greyed={"Respawn"})
    navigator_in(menus).leave("death")
    assert menus.pressed == []


def test_without_its_label_the_point_is_clicked() -> None:
    menus = FakeMenus("pause", labels=set())
    navigator_in(menus, points=point_in(menus, "back_to_game")).leave("pause")
    assert menus.pressed == [(200, 60)]


def test_with_its_label_no_point_is_clicked() -> None:
    menus = FakeMenus("pause")
    navigator_in(menus, points=point_in(menus, "back_to_game")).leave("pause")
    assert menus.pressed == [BUTTONS["pause"]["Back to Game"]]


def test_without_its_label_and_without_its_point_nothing_is_clicked() -> None:
    menus = FakeMenus("disconnected", labels=set())
    navigator_in(menus, points=point_in(menus, "singleplayer")).leave("disconnected")
    assert menus.pressed == []


def test_a_game_menu_whose_first_button_is_covered_is_left_by_esc_and_never_by_the_last() -> None:
    menus = FakeMenus("pause", labels={"Save and Quit to Title"})
    assert menu_name(menus) == "pause"
    navigator_in(menus).leave("pause")
    assert (menus.pressed, menus.shown) == (["esc"], "world")


@pytest.mark.parametrize(("version", "y"), [("1.20.1", 132), ("1.12.2", 100)])
def test_without_a_name_the_first_world_of_the_list_is_chosen_and_then_played(version: str, y: int) -> None:
    # 854 pixels at GUI scale 2 have their middle at 213: (213 - 119 + 60) * 2 across, (48 or 32, + 18) * 2 down.
    menus = FakeMenus("worlds")
    navigator = navigator_in(menus, Profile(game=GameVersion(version=version)))
    navigator.leave("worlds")
    assert (menus.pressed, menus.shown) == ([(308, y)], "worlds")
    navigator.leave("worlds")
    assert (menus.pressed[1:], menus.shown) == ([(300, 420)], "world")
    menus.shown = "worlds"
    navigator.leave("worlds")
    assert menus.pressed[2:] == [(308, y)]


def test_the_first_row_is_found_at_another_scale_too() -> None:
    # 854 pixels at GUI scale 4 are 214 wide, rounded up, with their middle at 107: (107 - 119 + 60) * 4, (48 + 18) * 4.
    menus = FakeMenus("worlds", scale=4)
    navigator_in(menus).leave("worlds")
    assert menus.pressed == [(192, 264)]


def test_a_profiles_world_is_chosen_by_its_name() -> None:
    menus = FakeMenus("worlds", world_names={"Arena": (250, 300)})
    navigator = navigator_in(menus, OWN_WORLD)
    navigator.leave("worlds")
    navigator.leave("worlds")
    assert menus.pressed == [(250, 300), (300, 420)]


def test_a_profiles_world_that_is_not_in_the_list_is_never_another_one() -> None:
    menus = FakeMenus("worlds")
    points = point_in(menus, "world")
    navigator = navigator_in(menus, OWN_WORLD, points)
    navigator.leave("worlds")
    navigator.leave("worlds")
    assert menus.pressed == []


def test_a_world_is_chosen_again_while_it_can_not_be_played() -> None:
    menus = FakeMenus("worlds", greyed={"Play Selected World"})
    navigator = navigator_in(menus)
    navigator.leave("worlds")
    navigator.leave("worlds")
    assert menus.pressed == [(308, 132), (308, 132)]


def test_in_another_language_the_world_is_chosen_by_its_point() -> None:
    menus = FakeMenus("worlds", labels=set())
    navigator_in(menus, points=point_in(menus, "world", (400, 90))).leave("worlds")
    assert menus.pressed == [(400, 90)]


def test_where_the_list_can_be_read_the_worlds_point_is_not_used() -> None:
    menus = FakeMenus("worlds")
    navigator_in(menus, points=point_in(menus, "world", (400, 90))).leave("worlds")
    assert menus.pressed == [(308, 132)]
