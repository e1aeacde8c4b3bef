"""Drives MenuLabels with painted menus of every version's geometry; which screen it is, is left to others."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import FontError
from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.menu_labels import MenuLabels
from sim.client.drawing.letters import drawn_atlas
from tests.live.vision.menu_painter import GREY, HOVERED, OLD_WHITE, WHITE, Colour, MenuPainter

FONT = font_of(drawn_atlas())
WINDOWS = ((854, 480), (1280, 720), (1366, 768), (1600, 900), (1919, 1079))
SCREENS = ("title", "worlds", "worlds 1.21.9", "pause 1.12", "pause 1.14", "death")
ShownButton = tuple[str, int, int, int]


def buttons_of(screen: str, width: int, height: int) -> list[ShownButton]:
    """Return each button's label, left, top and width, in GUI pixels (FACTS: Screens and their buttons)."""
    middle, quarter = width // 2, height // 4
    if screen == "title":
        top, last = quarter + 48, quarter + 132
        three = ("Singleplayer", "Multiplayer", "Minecraft Realms")
        rows = [(name, middle - 100, top + 24 * row, 200) for row, name in enumerate(three)]
        return [*rows, ("Options...", middle - 100, last, 98), ("Quit Game", middle + 2, last, 98)]
    if screen.startswith("worlds"):
        first = [
            ("Play Selected World", middle - 154, height - 52, 150),
            ("Create New World", middle + 4, height - 52, 150),
        ]
        is_new = screen == "worlds 1.21.9"
        names = ("Edit", "Delete", "Re-Create", "Back" if is_new else "Cancel")
        lefts, wide = ((-154, -75, 4, 83), 71) if is_new else ((-154, -76, 4, 82), 72)
        return first + [(name, middle + x, height - 28, wide) for name, x in zip(names, lefts, strict=True)]
    if screen == "death":
        return [("Respawn", middle - 100, quarter + 72, 200), ("Title Screen", middle - 100, quarter + 96, 200)]
    is_new, top = screen == "pause 1.14", quarter + 8
    left, wide, right = (middle - 102, 204, middle + 4) if is_new else (middle - 100, 200, middle + 2)
    pairs = [(24, "Advancements", "Statistics"), (72, "Options...", "Open to LAN")]
    pairs += [(48, "Give Feedback", "Report Bugs")] if is_new else []
    both = [(name, x, top + down, 98) for down, *two in pairs for name, x in zip(two, (left, right), strict=True)]
    return [("Back to Game", left, top, wide), *both, ("Save and Quit to Title", left, top + 96, wide)]


def world(size: tuple[int, int], rng: np.random.Generator) -> Frame:
    return rng.integers(0, 256, (size[1], size[0], 3), np.uint8)


def painter(size: tuple[int, int] = (854, 480), scale: int = 2, seed: int = 0) -> MenuPainter:
    rng = np.random.default_rng(seed)
    return MenuPainter(world(size, rng), scale, FONT, rng)


@given(
    st.sampled_from(SCREENS),
    st.sampled_from(WINDOWS),
    st.sampled_from((1, 2, 3, 4)),
    st.sampled_from((WHITE, OLD_WHITE, HOVERED, GREY)),
    st.integers(0, 2**32 - 1),
)
def test_each_button_is_found_within_two_gui_pixels_of_its_middle(
    screen: str, size: tuple[int, int], scale: int, colour: Colour, seed: int
) -> None:
    scale = min(scale, size[0] // 320, size[1] // 240)
    menu = painter(size, scale, seed)
    shown = buttons_of(screen, menu.width, menu.height)
    middles = {label: menu.button(label, left, top, width, colour) for label, left, top, width in shown}
    read = MenuLabels(menu.frame, FONT)
    for label, (x, y) in middles.items():
        found = read.button(label)
        assert found.middle is not None, found.problem
        assert abs(found.middle[0] - x) <= 2 * scale
        assert abs(found.middle[1] - y) <= 2 * scale
        assert found.is_enabled == (colour != GREY)


@pytest.mark.parametrize("scale", [1, 2, 3, 4])
def test_only_the_given_gui_scale_is_tried(scale: int) -> None:
    menu = painter((1280, 960), 2)
    menu.button("Respawn", 100, 100, 200)
    assert (MenuLabels(menu.frame, FONT, scale).button("Respawn").middle is not None) == (scale == 2)


@pytest.mark.parametrize("label", ["Back", "to Game", "Game", "Back to G", "Back to Gam", "Respawn"])
def test_a_part_of_a_label_or_another_label_is_not_found_as_a_button(label: str) -> None:
    menu = painter()
    menu.button("Back to Game", 100, 100, 200)
    found = MenuLabels(menu.frame, FONT).button(label)
    assert found.middle is None
    assert repr(label) in (found.problem or "")


def test_a_menus_title_is_seen_as_text_and_not_as_a_button() -> None:
    menu = painter()
    menu.frame //= 4  # as the world behind it is dimmed
    menu.text("Game Menu", 180, 40)
    read = MenuLabels(menu.frame, FONT)
    assert read.shows("Game Menu")
    assert "on no button" in (read.button("Game Menu").problem or "")


def test_a_title_above_does_not_hide_the_button_of_the_same_name() -> None:
    menu = painter()
    menu.frame //= 4
    menu.text("Create New World", 160, 8)
    _, y = menu.button("Create New World", 216, 188, 150)
    found = MenuLabels(menu.frame, FONT).button("Create New World")
    assert found.middle is not None
    assert found.middle[1] == y


def test_two_buttons_with_the_same_label_are_a_problem() -> None:
    menu = painter()
    for top in (60, 100):
        menu.button("Respawn", 100, top, 200)
    assert "2 buttons" in (MenuLabels(menu.frame, FONT).button("Respawn").problem or "")


@pytest.mark.parametrize("part", ["letter", "shadow", "upper edge", "lower edge"])
def test_something_over_a_part_of_a_button_is_a_problem(part: str) -> None:
    menu = painter()
    menu.button("Respawn", 100, 100, 200)
    top = {"letter": 106, "shadow": 107, "upper edge": 100, "lower edge": 119}[part]
    height = 1 if "edge" in part else 4
    menu.frame[2 * top : 2 * (top + height), 380:420] = np.random.default_rng(0).integers(0, 256, (2 * height, 40, 3))
    assert MenuLabels(menu.frame, FONT).button("Respawn").middle is None


def test_a_label_that_still_fades_in_is_a_problem() -> None:
    menu = painter()
    menu.button("Singleplayer", 100, 100, 200, colour=(200, 200, 200))
    assert MenuLabels(menu.frame, FONT).button("Singleplayer").middle is None


def test_text_without_a_shadow_is_not_a_label() -> None:
    menu = painter()
    menu.button("Respawn", 100, 100, 200)
    menu.frame[(menu.frame == 63).all(2)] = 111
    assert not MenuLabels(menu.frame, FONT).shows("Respawn")


@pytest.mark.parametrize("shape", [(0, 0), (1, 1), (7, 900), (30, 30)])
def test_no_button_is_found_in_a_frame_too_small_for_it(shape: tuple[int, int]) -> None:
    assert MenuLabels(np.full((*shape, 3), 255, np.uint8), FONT).button("Respawn").middle is None


def test_a_label_that_the_font_lacks_is_reported() -> None:
    with pytest.raises(FontError, match="é"):
        MenuLabels(np.zeros((100, 100, 3), np.uint8), FONT).button("é")


@pytest.mark.parametrize("shade", [0, 255])
def test_a_button_over_a_world_of_its_outlines_colour_is_found_by_its_face(shade: int) -> None:
    frame = np.full((480, 854, 3), shade, np.uint8)
    over = MenuPainter(frame, 2, FONT, np.random.default_rng(0))
    over.button("Respawn", 115, 60, 200, WHITE if shade == 0 else HOVERED)
    assert MenuLabels(frame, FONT).button("Respawn").middle


@pytest.mark.parametrize("missing", [0, 19])
def test_a_label_with_only_one_outline_is_not_on_a_button(missing: int) -> None:
    frame = np.full((480, 854, 3), 90, np.uint8)
    over = MenuPainter(frame, 2, FONT, np.random.default_rng(0))
    over.button("Respawn", 115, 60, 200)
    # A face without grain, and one of its two outlines painted away.
    frame[2 * 61 : 2 * 79, 2 * 116 : 2 * 314][(frame[2 * 61 : 2 * 79, 2 * 116 : 2 * 314] < 180).all(2)] = 111
    over.text("Respawn", 115 + (200 - len(FONT.columns("Respawn"))) // 2, 66)
    assert MenuLabels(frame, FONT).button("Respawn").middle
    frame[2 * (60 + missing) : 2 * (61 + missing), 2 * 115 : 2 * 315] = 111 if missing else 90
    assert "on no button" in (MenuLabels(frame, FONT).button("Respawn").problem or "")


def test_a_button_whose_face_has_its_outlines_colour_is_found_by_the_world_around_it() -> None:
    over = painter()
    over.frame[2 * 60 : 2 * 80, 2 * 115 : 2 * 315] = 111
    over.text("Respawn", 115 + (200 - len(FONT.columns("Respawn"))) // 2, 66)
    assert MenuLabels(over.frame, FONT).button("Respawn").middle
