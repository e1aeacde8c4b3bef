import pytest

from sim.client.edition import Edition
from sim.client.screens import Menu, MenuState, ScreenName, label_colour, menu

WIDTH, HEIGHT = 427, 240
MENUS: tuple[ScreenName, ...] = ("title", "worlds", "pause", "death", "disconnected")
VERSIONS = ["1.12.2", "1.13.2", "1.16.5", "1.20.1", "1.21.11", "26.1"]


def shown(name: ScreenName, version: str, *, is_chosen: bool = False) -> Menu:
    return menu(MenuState(name, is_chosen=is_chosen, reason="Timed out"), Edition(version), WIDTH, HEIGHT)


def place(name: ScreenName, version: str, label: str) -> tuple[int, int, int, int]:
    (button,) = [button for button in shown(name, version).buttons if button.label == label]
    return button.left, button.top, button.width, button.height


@pytest.mark.parametrize(
    ("name", "version", "label", "expected"),
    [
        ("title", "1.12.2", "Singleplayer", (113, 108, 200, 20)),
        ("title", "26.1", "Quit Game", (215, 192, 98, 20)),
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
    assert place(name, version, label) == expected


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", MENUS)
def test_no_two_buttons_overlap_and_all_lie_in_the_window(name: ScreenName, version: str) -> None:
    buttons = shown(name, version).buttons
    for button in buttons:
        assert button.left >= 0
        assert button.left + button.width <= WIDTH
        assert button.top + button.height <= HEIGHT
        assert [other for other in buttons if other.holds(*button.middle)] == [button]


def test_words_change_with_the_version() -> None:
    assert shown("death", "1.16.5").texts[0].text == "You died!"
    assert shown("death", "1.17").texts[0].text == "You Died!"
    assert "Give Feedback" not in {button.label for button in shown("pause", "1.13.2").buttons}
    assert shown("disconnected", "1.16.5").buttons[0].label == "Back to title screen"


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
