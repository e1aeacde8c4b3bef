import numpy as np
import pytest

from mc_nested.live.devices import Frame
from sim.client.drawing.gui_layers import HudLayers, MenuLayers
from sim.client.drawing.layers import Layer, draw_all
from sim.client.drawing.letters import Letters
from sim.client.game.chat import ChatLine, TypedLine
from sim.client.game.edition import Edition
from sim.client.game.f3_screen import F3Screen
from sim.client.game.realm import Stack
from sim.client.game.screens import MenuState, ScreenName, menu
from sim.client.game.view import View
from sim.client.game.widgets import RED, WHITE, Widget
from tests.sim.client.playing import FONT

WIDTH, HEIGHT = 427, 240
F3 = F3Screen("1.19.3-1.21.8", 1, (0.5, 64.0, 0.5), 0.0, 0.0)


def hud(version: str = "1.20.1", scale: int = 1) -> HudLayers:
    return HudLayers(Letters(FONT, scale), (WIDTH, HEIGHT), Edition(version))


def drawn(layers: list[Layer], world: int = 0) -> Frame:
    frame = np.full((HEIGHT, WIDTH, 3), world, np.uint8)
    draw_all(frame, layers, (0, 0, WIDTH, HEIGHT))
    return frame


def view(f3: F3Screen | None = None, slot: int = 0, *stacks: Stack) -> View:
    hotbar: tuple[Stack | None, ...] = (*stacks, *[None] * (9 - len(stacks)))
    return View(MenuState("world"), (0, 64, 0), f3, hotbar, slot)


def bounds(mask: np.ndarray) -> tuple[int, int, int, int]:
    """Return left, top, right, bottom of what is set; the last two are outside."""
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1


def test_a_view_without_a_hotbar_draws_no_hud() -> None:
    assert hud().of(View(MenuState("world"), (0, 64, 0))) == []


def test_the_crosshair_is_a_cross_of_nine_pixels_in_the_middle() -> None:
    frame = drawn(hud().of(view()))[:200]
    white = (frame == 230).all(2)
    assert bounds(white) == (213 - 4, 120 - 4, 213 + 5, 120 + 5)
    assert white.sum() == 17


def test_with_the_debug_screen_the_crosshair_is_three_coloured_axes() -> None:
    frame = drawn(hud().of(view(F3)))[:200]
    for colour, rect in (
        ((255, 0, 0), (213, 120, 221, 121)),
        ((0, 255, 0), (213, 112, 214, 120)),
        ((127, 127, 255), (207, 121, 213, 122)),
    ):
        assert bounds((frame == colour[::-1]).all(2)) == rect
    assert not (frame == 230).all(2).any()


def test_the_chosen_slot_is_brighter_than_the_others() -> None:
    frame = drawn(hud().of(view(None, 3)), 200)[200:]
    left = 213 - 91
    chosen = bounds(frame[:, left:, 0] > 200)
    assert (chosen[0], chosen[2]) == (20 * 3 - 1, 20 * 3 + 23)
    bar = bounds((frame != 200).any(2))
    assert bar == (left, 17, left + 182, 40)


def test_a_stack_is_drawn_as_an_icon_with_a_count_above_one() -> None:
    one, two = (drawn(hud().of(view(None, 8, Stack("stone", count)))) for count in (1, 64))
    left = 213 - 91 + 3
    icon = one[221, left]
    assert bounds((one == icon).all(2)) == (left, 221, left + 16, 237)
    digits = (two == 255).all(2)
    width = Letters(FONT, 1).width("64")
    assert bounds(digits)[0] == left + 17 - width
    assert bounds(digits)[1] == 230
    assert not (one == 255).all(2).any()


def test_each_block_has_an_icon_of_its_own_colour() -> None:
    frame = drawn(hud().of(view(None, 8, Stack("stone", 1), Stack("dirt", 1), Stack("stone", 1))))
    first, second, third = (frame[225, 213 - 91 + 3 + 20 * slot].tolist() for slot in range(3))
    assert first == third != second
    assert min(first) >= 60
    assert max(first) < 180


def test_the_newest_line_of_the_chat_is_at_the_bottom() -> None:
    lines = (ChatLine("new", WHITE, 8), ChatLine("old", RED, 8))
    for version, bottom in (("1.20.1", HEIGHT - 40), ("1.12.2", HEIGHT - 48)):
        frame = drawn(hud(version).chat(lines, None))
        assert bounds((frame == 255).all(2))[0] == 4
        assert bottom - 9 <= bounds((frame == 255).all(2))[1] < bottom
        red = bounds((frame == RED[::-1]).all(2))
        assert bottom - 18 <= red[1] < red[3] <= bottom - 9


def test_a_line_fades_with_its_box() -> None:
    full, half = (drawn(hud().chat((ChatLine("I", WHITE, opacity),), None), 200) for opacity in (8, 4))
    inside = (HEIGHT - 41, 320)
    assert int(full[inside][0]) == round(200 * (255 - 128) / 255)
    assert int(half[inside][0]) == round(200 * (255 - 64) / 255)
    assert (half == 127).all(2).any()
    assert full[HEIGHT - 41, 328, 0] == 200
    assert full[HEIGHT - 41, 327, 0] < 200


def test_a_long_chat_line_is_wrapped_between_words_with_its_end_at_the_bottom() -> None:
    letters = Letters(FONT, 1)
    text = " ".join(["word"] * 30)
    fitting = max(count for count in range(1, 31) if letters.width(" ".join(["word"] * count)) <= 320)
    rows = -(-30 // fitting)
    assert rows > 1
    layers = hud().chat((ChatLine(text, WHITE, 8),), None)
    assert len(layers) == 2 * rows
    upper, lower = layers[-1], layers[1]
    assert upper.rect[2] - upper.rect[0] == letters.width(" ".join(["word"] * fitting)) + 1
    assert lower.rect[1] - upper.rect[1] == 9 * (rows - 1)
    assert lower.rect[2] < upper.rect[2]


def test_a_word_wider_than_the_chat_is_not_wrapped() -> None:
    assert len(hud().chat((ChatLine("x" * 200, WHITE, 8),), None)) == 2


def test_the_typed_line_has_a_cursor_and_shows_the_end_of_a_long_text() -> None:
    letters = Letters(FONT, 1)
    box, text = hud().chat((), TypedLine("abc"))
    assert box.rect == (2, HEIGHT - 14, WIDTH - 2, HEIGHT - 2)
    assert text.rect[:2] == (4, HEIGHT - 12)
    assert text.rect[2] == 4 + letters.width("abc_") + 1
    _, long = hud().chat((), TypedLine("x" * 200))
    assert WIDTH - 8 - letters.width("x") < long.rect[2] - long.rect[0] - 1 <= WIDTH - 8


def test_the_ground_behind_chat_texts_has_its_given_alpha() -> None:
    for ground in (0, 51, 255):
        frame = drawn(hud().chat((ChatLine("I", WHITE, 8, ground),), TypedLine("I", ground=ground)), 200)
        assert {int(frame[row, 300, 0]) for row in (HEIGHT - 45, HEIGHT - 8)} == {round(200 * (255 - ground) / 255)}


def test_a_draft_is_grey_and_slanted_and_its_cursor_is_not() -> None:
    letters = Letters(FONT, 1)
    _, text, cursor = hud().chat((), TypedLine("/tp", is_draft=True))
    assert text.rect[0] == 3
    assert cursor.rect[0] == 4 + letters.width("/tp")
    frame = drawn([text])
    assert (frame == 170).all(2).any()
    assert not (frame == 224).all(2).any()


def test_a_line_that_just_fits_is_shown_from_its_beginning() -> None:
    letters = Letters(FONT, 1)
    texts = ("x" * count + narrow for count in range(100) for narrow in ("", "i", "l", "t", "il", "it", "lt", "ilt"))
    fitting = next(text for text in texts if letters.width(f"{text}_") == WIDTH - 8)
    _, shown = hud().chat((), TypedLine(fitting))
    assert shown.rect[2] - shown.rect[0] - 1 == WIDTH - 8


def test_unchanged_parts_of_the_hud_are_the_same_layers() -> None:
    layers = hud()
    assert layers.of(view()) == layers.of(view())
    assert layers.chat((ChatLine("a", WHITE, 8),), TypedLine("b")) == layers.chat(
        (ChatLine("a", WHITE, 8),), TypedLine("b")
    )


def test_the_hud_grows_with_the_gui_scale() -> None:
    small, large = hud().of(view()), hud(scale=2).of(view())
    assert [tuple(2 * edge for edge in layer.rect) for layer in small] == [layer.rect for layer in large]


FACE, INACTIVE, HOVERED = (111, 111, 111), (44, 44, 44), (126, 136, 191)


def layers(state: MenuState, pointer: tuple[int, int] = (-1, -1), words: dict[str, str] | None = None) -> list[Layer]:
    menus = MenuLayers(Letters(FONT, 1), (WIDTH, HEIGHT), Edition("1.20.1"), words or {})
    return menus.of(View(state, (0, 64, 0), pointer=pointer))


def drawn_menu(state: MenuState, pointer: tuple[int, int] = (-1, -1), words: dict[str, str] | None = None) -> Frame:
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
    frame, button = drawn_menu(state), widget(state, "Singleplayer")
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
        frame = drawn_menu(state, (round(button.middle[0]), round(button.middle[1])))
        assert face_of(frame, button) == face
        assert face_of(frame, widget(state, "Cancel")) == FACE


def test_a_chosen_world_is_marked() -> None:
    before, after = drawn_menu(MenuState("worlds")), drawn_menu(MenuState("worlds", is_chosen=True))
    row = menu(MenuState("worlds"), Edition("1.20.1"), WIDTH, HEIGHT).buttons[1]
    corner = row.top + row.height - 1, row.left + row.width - 1
    assert (before[corner] == 200).all()
    assert (after[corner] == round(200 * (255 - 80) / 255 + 128 * 80 / 255)).all()


@pytest.mark.parametrize(
    ("name", "is_red"), [("pause", False), ("debug_options", False), ("friends", False), ("death", True)]
)
def test_the_world_behind_a_menu_is_dimmed_or_reddened(name: ScreenName, is_red: bool) -> None:
    corner = drawn_menu(MenuState(name))[0, 0]
    assert corner.max() < 200
    assert (corner[2] > corner[0]) == is_red


@pytest.mark.parametrize("name", ["title", "title_friends", "paused"])
def test_the_title_and_a_pause_without_a_menu_are_not_dimmed(name: ScreenName) -> None:
    assert (drawn_menu(MenuState(name))[0, 0] == 200).all()


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
    frame, plain = drawn_menu(state, words={label: "iiii", title: "ii"}), drawn_menu(state)
    button = widget(state, label)
    for rect in ((button.left, button.top, button.width, button.height), (100, 40, 227, 10)):
        left, top, width, height = rect
        part, other = (picture[top : top + height, left : left + width] for picture in (frame, plain))
        assert not np.array_equal(part, other)
    ink = (frame[button.top + 2 : button.top + 18, button.left : button.left + button.width] == 255).all(2)
    columns = np.flatnonzero(ink.any(0))
    middle = (columns[0] + columns[-1] + 1) / 2
    assert abs(middle - button.width / 2) <= 1


def test_a_centred_text_is_drawn_around_its_position_and_another_text_begins_at_it() -> None:
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


def test_a_menu_grows_with_the_scale() -> None:
    view = View(MenuState("pause"), (0, 64, 0))
    one, two = (MenuLayers(Letters(FONT, scale), (WIDTH, HEIGHT), Edition("1.20.1"), {}).of(view) for scale in (1, 2))
    assert [tuple(2 * edge for edge in layer.rect) for layer in one] == [layer.rect for layer in two]
