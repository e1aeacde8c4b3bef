import pytest

from sim.client.game.edition import Edition
from sim.client.game.screens import MenuState, ScreenName, label_colour, menu
from sim.client.game.widgets import Menu, MenuText

WIDTH, HEIGHT = 427, 240
MENUS: tuple[ScreenName, ...] = ("title", "worlds", "servers", "pause", "death", "disconnected")
VERSIONS = ["1.12.2", "1.13.2", "1.16.5", "1.20.1", "1.21.11", "26.1", "26.2", "26.3", "26.4"]


def shown(name: ScreenName, version: str, *, is_chosen: bool = False) -> Menu:
    return menu(MenuState(name, is_chosen=is_chosen, reason="Timed out"), Edition(version), WIDTH, HEIGHT)


def rect(name: ScreenName, version: str, label: str) -> tuple[int, int, int, int]:
    (button,) = [button for button in shown(name, version).buttons if button.label == label]
    return button.left, button.top, button.width, button.height


@pytest.mark.parametrize(
    ("name", "version", "label", "expected"),
    [
        ("title", "1.12.2", "Singleplayer", (113, 108, 200, 20)),
        ("title", "26.1", "Quit Game", (215, 192, 98, 20)),
        ("title", "26.2", "Quit Game", (215, 204, 98, 20)),
        ("title", "26.2", "Singleplayer", (113, 108, 200, 20)),
        ("pause", "26.2", "Back to Game", (111, 68, 204, 20)),
        ("pause", "26.2", "Open to LAN", (217, 140, 98, 20)),
        ("pause", "26.3", "World Options...", (217, 140, 98, 20)),
        ("pause", "26.3", "Save and Quit to Title", (111, 164, 204, 20)),
        ("worlds", "1.20.1", "Play Selected World", (59, 188, 150, 20)),
        ("worlds", "1.20.1", "Cancel", (295, 212, 72, 20)),
        ("worlds", "26.1", "Back", (296, 212, 71, 20)),
        ("pause", "1.12.2", "Back to Game", (113, 68, 200, 20)),
        ("pause", "1.16.5", "Back to Game", (111, 68, 204, 20)),
        ("pause", "1.16.5", "Report Bugs", (217, 116, 98, 20)),
        ("pause", "1.20.1", "Back to Game", (111, 68, 204, 20)),
        ("pause", "1.20.1", "Save and Quit to Title", (111, 164, 204, 20)),
        ("death", "1.16.5", "Title screen", (113, 156, 200, 20)),
        ("death", "1.17.1", "Respawn", (113, 132, 200, 20)),
    ],
)
def test_buttons_stand_where_the_facts_say(
    name: ScreenName, version: str, label: str, expected: tuple[int, int, int, int]
) -> None:
    assert rect(name, version, label) == expected


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", MENUS)
def test_no_two_buttons_overlap_and_all_lie_in_the_window(name: ScreenName, version: str) -> None:
    buttons = shown(name, version).buttons
    for button in buttons:
        assert button.left >= 0
        assert button.left + button.width <= WIDTH
        assert button.top + button.height <= HEIGHT
        assert [other for other in buttons if other.contains(*button.middle)] == [button]


def test_titles_and_labels_change_with_the_version() -> None:
    assert shown("death", "1.16.5").texts[0].text == "You died!"
    assert shown("death", "1.17").texts[0].text == "You Died!"
    assert "Give Feedback" not in {button.label for button in shown("pause", "1.13.2").buttons}
    assert shown("disconnected", "1.16.5").buttons[0].label == "Back to server list"
    assert shown("disconnected", "1.17").buttons[0].label == "Back to Server List"
    assert shown("worlds", "1.20.3").buttons[-1].label == "Cancel"
    assert shown("worlds", "1.20.4").buttons[-1].label == "Back"


@pytest.mark.parametrize(
    ("name", "top", "lefts"), [("title", 180, [179, 203, 227]), ("pause", 116, [167, 191, 215, 239])]
)
def test_a_row_of_icons_stands_in_the_middle_since_26_2(name: ScreenName, top: int, lefts: list[int]) -> None:
    assert all(button.label for button in shown(name, "26.1").buttons)
    icons = [button for button in shown(name, "26.2").buttons if not button.label]
    assert [(icon.left, icon.top, icon.width, icon.height) for icon in icons] == [(left, top, 20, 20) for left in lefts]


@pytest.mark.parametrize(
    ("version", "words"), [("1.16.5", "Game paused"), ("1.17", "Game Paused"), ("26.4", "Game Paused")]
)
def test_a_pause_without_a_menu_is_two_words(version: str, words: str) -> None:
    assert shown("paused", version) == Menu((MenuText(words, WIDTH // 2, 10),))


def test_a_world_can_be_played_once_it_is_chosen() -> None:
    for is_chosen in (False, True):
        active = {button.label for button in shown("worlds", "1.20.1", is_chosen=is_chosen).buttons if button.is_active}
        assert ("Play Selected World" in active) is is_chosen
        assert {"Create New World", "Cancel"} <= active


def test_labels_change_their_colour_under_the_mouse_before_1_16_only() -> None:
    button = shown("pause", "1.12.2").buttons[0]
    assert label_colour(button, Edition("1.12.2"), is_hovered=True) == (255, 255, 160)
    assert label_colour(button, Edition("1.12.2"), is_hovered=False) == (224, 224, 224)
    assert label_colour(button, Edition("1.20.1"), is_hovered=True) == (255, 255, 255)


@pytest.mark.parametrize("name", ["world", "chat", "inventory"])
def test_the_world_has_no_buttons(name: ScreenName) -> None:
    assert shown(name, "1.20.1") == Menu()


@pytest.mark.parametrize(
    ("name", "version", "texts"),
    [
        ("title", "1.20.1", [("MINECRAFT", 213, 30), ("Minecraft 1.20.1", 2, 230)]),
        ("worlds", "1.12.2", [("Select World", 213, 20), ("New World", 113, 33), ("Creative Mode, Cheats", 113, 53)]),
        ("worlds", "1.13.2", [("Select World", 213, 8), ("New World", 113, 49), ("Creative Mode, Cheats", 113, 69)]),
        ("pause", "1.20.1", [("Game Menu", 213, 40)]),
        ("death", "1.20.1", [("You Died!", 213, 60), ("Score: 0", 213, 100)]),
        ("disconnected", "1.20.1", [("Connection Lost", 213, 98), ("Timed out", 213, 116)]),
        ("servers", "1.20.1", [("Play Multiplayer", 213, 20), ("Minecraft Server", 113, 37)]),
        ("loading", "1.12.2", [("Loading terrain", 213, 120)]),
        ("loading", "1.13.2", [("Loading terrain...", 213, 120)]),
        ("saving", "1.20.1", [("Saving world", 213, 120)]),
    ],
)
def test_texts_stand_where_the_facts_say(name: ScreenName, version: str, texts: list[tuple[str, int, int]]) -> None:
    assert [(text.text, text.left, text.top) for text in shown(name, version).texts] == texts


@pytest.mark.parametrize(
    ("name", "version", "rects"),
    [
        ("title", "1.20.1", [(113, 108), (113, 132), (113, 156), (113, 192), (215, 192)]),
        (
            "worlds",
            "1.12.2",
            [(78, 32), (110, 32), (59, 188), (217, 188), (59, 212), (137, 212), (217, 212), (295, 212)],
        ),
        ("worlds", "26.1", [(78, 48), (110, 48), (59, 188), (217, 188), (59, 212), (138, 212), (217, 212), (296, 212)]),
        ("pause", "1.13.2", [(113, 68), (113, 92), (215, 92), (113, 140), (215, 140), (113, 164)]),
        (
            "pause",
            "1.14",
            [(111, 68), (111, 92), (217, 92), (111, 116), (217, 116), (111, 140), (217, 140), (111, 164)],
        ),
        ("death", "1.20.1", [(113, 132), (113, 156)]),
        ("disconnected", "1.20.1", [(113, 133)]),
        (
            "servers",
            "1.20.1",
            [(59, 188), (163, 188), (267, 188), (59, 212), (139, 212), (217, 212), (293, 212)],
        ),
    ],
)
def test_every_button_stands_at_its_place_in_the_game(
    name: ScreenName, version: str, rects: list[tuple[int, int]]
) -> None:
    assert [(button.left, button.top) for button in shown(name, version).buttons] == rects


def test_the_pause_menu_is_laid_out_by_the_windows_height_since_1_19_4() -> None:
    older, newer = (
        menu(MenuState("pause"), Edition(version), 427, 300).buttons[0].top for version in ("1.19.3", "1.19.4")
    )
    assert (older, newer) == (83, 83)
    assert menu(MenuState("pause"), Edition("1.19.4"), 427, 303).buttons[0].top == 84
    assert menu(MenuState("pause"), Edition("1.19.3"), 427, 303).buttons[0].top == 83


def test_the_button_of_a_lost_connection_stays_inside_a_low_window() -> None:
    assert menu(MenuState("disconnected"), Edition("1.20.1"), 427, 80).buttons[0].top == 50


def test_the_death_screens_buttons_become_active_together() -> None:
    for is_ready in (False, True):
        buttons = menu(MenuState("death", is_ready), Edition("1.20.1"), WIDTH, HEIGHT).buttons
        assert [button.is_active for button in buttons] == [is_ready, is_ready]


def test_a_button_contains_its_upper_left_corner_and_not_its_lower_right_one() -> None:
    button = shown("pause", "1.20.1").buttons[0]
    right, bottom = button.left + button.width, button.top + button.height
    assert button.contains(button.left, button.top)
    assert button.contains(right - 1, bottom - 1)
    for x, y in (
        (button.left - 1, button.top),
        (button.left, button.top - 1),
        (right, bottom - 1),
        (right - 1, bottom),
    ):
        assert not button.contains(x, y)
    assert button.middle == (213.0, 78.0)


def test_the_buttons_of_a_world_are_active_only_once_it_is_chosen() -> None:
    inactive = {button.label for button in shown("worlds", "1.20.1").buttons if not button.is_active}
    assert inactive == {"Play Selected World", "Edit", "Delete", "Re-Create"}
    assert all(button.is_active for button in shown("worlds", "1.20.1", is_chosen=True).buttons)
    effects = {button.label: button.does for button in shown("worlds", "1.20.1").buttons if button.label}
    assert (effects["Cancel"], effects["Play Selected World"], effects["Edit"]) == ("to_title", "enter_selected", "")
