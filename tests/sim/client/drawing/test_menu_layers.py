import numpy as np
import pytest

from mc_nested.live.devices import Frame
from sim.client.drawing.layers import Layer, draw_all
from sim.client.drawing.letters import Letters
from sim.client.drawing.menu_layers import MenuLayers
from sim.client.game.edition import Edition
from sim.client.game.screens import MenuState, ScreenName, menu
from sim.client.game.view import View
from sim.client.game.widgets import Widget
from tests.sim.client.playing import FONT

WIDTH, HEIGHT = 427, 240
FACE, INACTIVE, HOVERED = (111, 111, 111), (44, 44, 44), (126, 136, 191)


def layers(state: MenuState, pointer: tuple[int, int] = (-1, -1), words: dict[str, str] | None = None) -> list[Layer]:
    menus = MenuLayers(Letters(FONT, 1), (WIDTH, HEIGHT), Edition("1.20.1"), words or {})
    return menus.of(View(state, (0, 64, 0), pointer=pointer))


def drawn(state: MenuState, pointer: tuple[int, int] = (-1, -1), words: dict[str, str] | None = None) -> Frame:
    frame = np.full((HEIGHT, WIDTH, 3), 200, np.uint8)
    draw_all(frame, layers(state, pointer, words), (0, 0, WIDTH, HEIGHT))
    return frame


def widget(state: MenuState, label: str) -> Widget:
    return next(each for each in menu(state, Edition("1.20.1"), WIDTH, HEIGHT).buttons if each.label == label)


def face_of(frame: Frame, button: Widget) -> tuple[int, ...]:
    return tuple(int(part) for part in frame[button.top + 1, button.left + 1][::-1])


@pytest.mark.parametrize("name", ["world", "chat"])
def test_the_world_and_the_chat_have_no_menu(name: ScreenName) -> None:
    assert layers(MenuState(name)) == []


def test_a_button_has_a_black_border_of_one_pixel() -> None:
    state = MenuState("title")
    frame, button = drawn(state), widget(state, "Singleplayer")
    right, bottom = button.left + button.width, button.top + button.height
    assert face_of(frame, button) == FACE
    for y, x in (
        (button.top, button.left),
        (bottom - 1, right - 1),
        (button.top, right - 1),
        (bottom - 1, button.left),
    ):
        assert not frame[y, x].any()
    assert tuple(frame[bottom - 2, right - 2]) == FACE
    assert (frame[bottom, right] == 200).all()


def test_the_button_under_the_mouse_is_blue_if_it_is_active() -> None:
    state = MenuState("worlds")
    active, inactive = widget(state, "Create New World"), widget(state, "Play Selected World")
    for button, face in ((active, HOVERED), (inactive, INACTIVE)):
        frame = drawn(state, (round(button.middle[0]), round(button.middle[1])))
        assert face_of(frame, button) == face
        assert face_of(frame, widget(state, "Cancel")) == FACE


def test_a_chosen_world_is_marked() -> None:
    before, after = drawn(MenuState("worlds")), drawn(MenuState("worlds", is_chosen=True))
    row = menu(MenuState("worlds"), Edition("1.20.1"), WIDTH, HEIGHT).buttons[1]
    corner = row.top + row.height - 1, row.left + row.width - 1
    assert (before[corner] == 200).all()
    assert (after[corner] == round(200 * (255 - 80) / 255 + 128 * 80 / 255)).all()


@pytest.mark.parametrize(
    ("name", "is_red"), [("pause", False), ("debug_options", False), ("friends", False), ("death", True)]
)
def test_the_world_behind_a_menu_is_dimmed_or_reddened(name: ScreenName, is_red: bool) -> None:
    corner = drawn(MenuState(name))[0, 0]
    assert corner.max() < 200
    assert (corner[2] > corner[0]) == is_red


@pytest.mark.parametrize("name", ["title", "title_friends", "paused"])
def test_the_title_and_a_pause_without_a_menu_are_not_dimmed(name: ScreenName) -> None:
    assert (drawn(MenuState(name))[0, 0] == 200).all()


def test_an_icon_is_a_button_with_a_picture() -> None:
    menus = MenuLayers(Letters(FONT, 1), (WIDTH, HEIGHT), Edition("26.2"), {})
    frame = np.full((HEIGHT, WIDTH, 3), 200, np.uint8)
    draw_all(frame, menus.of(View(MenuState("title"), (0, 64, 0))), (0, 0, WIDTH, HEIGHT))
    icon = frame[180:200, 179:199]
    assert not icon[0].any()
    assert (icon[1, 1] == FACE).all()
    assert (icon[10, 10] == 255).all()


def test_labels_and_texts_are_in_the_other_language() -> None:
    state = MenuState("pause")
    label, title = "Back to Game", "Game Menu"
    frame, plain = drawn(state, words={label: "iiii", title: "ii"}), drawn(state)
    button = widget(state, label)
    for rect in ((button.left, button.top, button.width, button.height), (100, 40, 227, 10)):
        left, top, width, height = rect
        part, other = (picture[top : top + height, left : left + width] for picture in (frame, plain))
        assert not np.array_equal(part, other)
    ink = (frame[button.top + 2 : button.top + 18, button.left : button.left + button.width] == 255).all(2)
    columns = np.flatnonzero(ink.any(0))
    middle = (columns[0] + columns[-1] + 1) / 2
    assert abs(middle - button.width / 2) <= 1


def test_a_centred_text_lies_around_its_middle_and_another_begins_there() -> None:
    letters = Letters(FONT, 1)
    state = MenuState("title")
    texts = layers(state)[-2:]
    wide = 3 * letters.width("MINECRAFT")
    assert texts[0].rect[0] == WIDTH // 2 - wide // 2
    assert texts[0].rect[1] == 30
    assert texts[1].rect[:2] == (2, HEIGHT - 10)


@pytest.mark.parametrize(("is_creative", "width", "height"), [(True, 195, 136), (False, 176, 166)])
def test_the_inventory_is_a_panel_in_the_middle_with_slots(is_creative: bool, width: int, height: int) -> None:
    menus = MenuLayers(Letters(FONT, 1), (WIDTH, HEIGHT), Edition("1.20.1"), {})
    shown = menus.of(View(MenuState("inventory"), (0, 64, 0), is_creative=is_creative))
    dim, panel, *slots, title = shown
    left, top = (WIDTH - width) // 2, (HEIGHT - height) // 2
    assert dim.rect == (0, 0, WIDTH, HEIGHT)
    assert panel.rect == (left, top, left + width, top + height)
    assert len(slots) == 4 * 9
    assert slots[0].rect == (left + 8, top + height - 82, left + 24, top + height - 66)
    assert slots[-1].rect == (left + 152, top + height - 28, left + 168, top + height - 12)
    assert title.rect[:2] == (left + 8, top + 6)


def test_a_menu_that_did_not_change_is_the_same_layers_again() -> None:
    menus = MenuLayers(Letters(FONT, 1), (WIDTH, HEIGHT), Edition("1.20.1"), {})
    view = View(MenuState("pause"), (0, 64, 0))
    assert menus.of(view) == menus.of(view)


def test_everything_grows_with_the_scale() -> None:
    view = View(MenuState("pause"), (0, 64, 0))
    one, two = (MenuLayers(Letters(FONT, scale), (WIDTH, HEIGHT), Edition("1.20.1"), {}).of(view) for scale in (1, 2))
    assert [tuple(2 * edge for edge in layer.rect) for layer in one] == [layer.rect for layer in two]
