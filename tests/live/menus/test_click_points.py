"""Points known again by their pictures: the same button under the mouse or not, and nothing else.

The files of points' pictures: named, written as PNG, read again, and gone without harm.
"""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import NotInFrontError, WrongScreenError
from mc_nested.live.devices import Frame
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.menus.click_points import (
    WIDTH,
    ClickPoint,
    click_on,
    has_pattern,
    hover_over,
    load_click_points,
    looks_the_same,
    picture_bytes,
    picture_file,
    pictures_folder,
    record_point,
)
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import font_of
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.screens import MenuState, ScreenName, menu
from sim.client.game.widgets import Widget
from tests.live.vision.menu_painter import GREY, WHITE, Colour, MenuPainter

FONT = font_of(drawn_atlas())
VERSIONS = ["1.12.2", "1.14.4", "1.16.5", "1.20.1", "1.21.11"]
SCREENS: tuple[ScreenName, ...] = ("pause", "title", "worlds", "death")


def test_a_picture_is_96_by_10_gui_pixels_around_its_point() -> None:
    frame = np.random.default_rng(0).integers(0, 256, (480, 854, 3), np.uint8)
    point = record_point("x", frame, (427, 240), 2)
    np.testing.assert_array_equal(point.picture, frame[230:250, 331:523])
    assert point.at == (0.5, 0.5)
    assert point.position((854, 480)) == (427, 240)


@given(st.integers(1, 3000), st.integers(1, 2000), st.data())
def test_a_recorded_point_is_at_most_one_pixel_off_its_place(width: int, height: int, data: st.DataObject) -> None:
    x, y = data.draw(st.integers(0, width - 1)), data.draw(st.integers(0, height - 1))
    at = record_point("x", np.zeros((height, width, 3), np.uint8), (x, y), 1).at
    place = ClickPoint("x", at, np.zeros((1, 1, 3), np.uint8)).position((width, height))
    assert max(abs(place[0] - x), abs(place[1] - y)) <= 1
    assert 0 <= place[0] < width
    assert 0 <= place[1] < height


def buttons_of(client: VirtualClient, screen: ScreenName) -> list[tuple[Widget, tuple[int, int]]]:
    """Return the buttons of a screen that are as wide as a picture, and their middles in pixels."""
    width, height = client.window.size
    gui = -(-width // client.scale), -(-height // client.scale)
    shown = menu(MenuState(screen, is_chosen=True), client.edition, *gui).buttons
    return [
        (each, (round(each.middle[0] * client.scale), round(each.middle[1] * client.scale)))
        for each in shown
        if each.label and each.width >= WIDTH
    ]


def opened(client: VirtualClient, screen: ScreenName, *, is_chosen: bool = True) -> Frame:
    client.game.open(screen)
    client.game.is_world_chosen = is_chosen
    client.clock.sleep(1.5)
    return client.display.grab()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_button_is_recognised_hovered_unhovered_and_greyed(version: str) -> None:
    client = VirtualClient(version=version)
    for screen in SCREENS:
        for button, (x, y) in buttons_of(client, screen):
            away = opened(client, screen)
            client.pointer.move(x, y)
            client.clock.sleep(0.2)
            point = record_point(button.label, client.display.grab(), (x, y), client.scale)
            assert looks_the_same(point, away), button.label
            if screen == "worlds":
                assert looks_the_same(point, opened(client, screen, is_chosen=False)), button.label
            client.pointer.move(1, 1)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("scale", [1, 2, 3])
def test_a_button_is_not_recognised_on_other_screens_or_at_other_buttons(version: str, scale: int) -> None:
    client = VirtualClient(version=version, size=(1366, 768), scale=scale)
    frames = {screen: opened(client, screen) for screen in SCREENS}
    frames["world"] = opened(client, "world")
    places = {place for screen in SCREENS for _, place in buttons_of(client, screen)}
    for screen in SCREENS:
        for button, (x, y) in buttons_of(client, screen):
            point = record_point(button.label, frames[screen], (x, y), client.scale)
            for other, frame in frames.items():
                here = other == screen
                assert looks_the_same(point, frame) == here, (button.label, other)
            for place in places - {(x, y)}:
                elsewhere = record_point(button.label, frames[screen], place, client.scale)
                moved = ClickPoint(button.label, elsewhere.at, point.picture)
                assert not looks_the_same(moved, frames[screen]), (button.label, place)


def named(name: str, seed: int, ground: int = 30, colour: Colour = WHITE) -> Frame:
    """Return a list of worlds with that one in it, before a ground with some noise in it."""
    rng = np.random.default_rng(seed)
    frame = rng.integers(ground, ground + 20, (240, 400, 3), np.uint8)
    MenuPainter(frame, 2, FONT, rng).text(name, 80, 40, colour)
    return frame


@given(st.integers(0, 10**6), st.integers(10, 60))
def test_a_worlds_name_is_recognised_on_any_dark_background(seed: int, ground: int) -> None:
    point = record_point("world", named("New World", 0), (200, 88), 2)
    assert looks_the_same(point, named("New World", seed, ground))


@pytest.mark.parametrize("other", ["New World 2", "New Worlds", "Mew World", "Now World", "New", "World", ""])
def test_a_world_with_another_name_is_not_recognised(other: str) -> None:
    point = record_point("world", named("New World", 0), (200, 88), 2)
    assert not looks_the_same(point, named(other, 1))


@pytest.mark.parametrize("change", ["black", "white", "noise", "small", "smaller than the picture"])
def test_a_point_does_not_match_other_pictures_at_its_place(change: str) -> None:
    frame = named("Singleplayer", 0)
    point = record_point("x", frame, (210, 88), 2)
    others = {
        "black": np.zeros_like(frame),
        "white": np.full_like(frame, 255),
        "noise": np.random.default_rng(5).integers(0, 256, frame.shape, np.uint8),
        "small": frame[:120, :200],
        "smaller than the picture": frame[:10, :10],
    }
    assert looks_the_same(point, frame)
    assert not looks_the_same(point, others[change])


def test_a_point_on_a_plain_background_is_never_recognised() -> None:
    frame = np.full((240, 400, 3), 60, np.uint8)
    point = record_point("x", frame, (200, 100), 2)
    assert not has_pattern(point.picture)
    assert not looks_the_same(point, frame)
    assert has_pattern(record_point("x", named("A", 0, colour=GREY), (166, 88), 2).picture)


@pytest.fixture
def client() -> VirtualClient:
    client = VirtualClient()
    client.game.open("pause")
    client.clock.sleep(0.3)
    return client


def hands_of(client: VirtualClient) -> InputController:
    return InputController(client.devices, Profile().input)


def back_to_game(client: VirtualClient) -> ClickPoint:
    place = next(place for button, place in buttons_of(client, "pause") if button.label == "Back to Game")
    return record_point("back_to_game", client.display.grab(), place, client.scale)


def test_a_point_that_looks_like_its_picture_is_clicked(client: VirtualClient) -> None:
    assert click_on(back_to_game(client), hands_of(client), client.display)
    client.clock.sleep(0.3)
    assert (client.game.screen, client.window.down) == ("world", set())


def test_hovering_over_a_point_presses_nothing(client: VirtualClient) -> None:
    point = back_to_game(client)
    assert hover_over(point, hands_of(client), client.display)
    client.clock.sleep(0.3)
    assert client.game.screen == "pause"
    assert client.pointer.position() == point.position(client.window.size)


@pytest.mark.parametrize("screen", ["title", "death", "inventory", "world"])
def test_a_point_of_another_screen_neither_moves_the_mouse_nor_clicks(
    client: VirtualClient, screen: ScreenName
) -> None:
    point, before = back_to_game(client), client.pointer.position()
    opened(client, screen)
    assert not click_on(point, hands_of(client), client.display)
    assert client.pointer.position() == before
    assert client.game.screen == screen


def test_a_screen_that_changes_under_the_mouse_takes_no_click(client: VirtualClient) -> None:
    point, now = back_to_game(client), client.clock.now()
    client.clock.call_at(now + 0.05, lambda: client.game.open("title"))
    assert not click_on(point, hands_of(client), client.display)
    assert client.game.screen == "title"


def test_a_window_that_moves_under_the_mouse_takes_no_click(client: VirtualClient) -> None:
    point = back_to_game(client)
    # Looked at, hovered over for 0.05 s, looked at again 0.1 s later, and now about to be clicked.
    client.clock.call_at(client.clock.now() + 0.17, lambda: client.shift_window(40, 25))
    with pytest.raises(WrongScreenError, match="mouse was moved, or the window was"):
        click_on(point, hands_of(client), client.display)
    assert client.game.screen == "pause"


def test_a_point_is_not_clicked_while_another_window_is_in_front(client: VirtualClient) -> None:
    point = back_to_game(client)
    client.set_front(is_in_front=False)
    with pytest.raises(NotInFrontError):
        click_on(point, hands_of(client), client.display)
    assert client.window.strays == []


def test_a_point_at_fraction_1_is_the_last_pixel() -> None:
    point = ClickPoint("corner", (1.0, 1.0), np.zeros((1, 1, 3), np.uint8))
    assert point.position((854, 480)) == (853, 479)


PICTURE = np.random.default_rng(0).integers(0, 256, (20, 192, 3), np.uint8)


def test_a_picture_lies_in_a_folder_beside_the_profile() -> None:
    assert picture_file(Path("/x/mine.toml"), "singleplayer") == Path("/x/mine-points/singleplayer.png")
    assert picture_file(Path("/x/mine.toml"), "my point") == Path("/x/mine-points/my point.png")


@given(st.text(st.characters(codec="utf-8"), min_size=1, max_size=30))
def test_a_point_of_any_name_has_its_picture_directly_in_the_pictures_folder(name: str) -> None:
    assert picture_file(Path("/x/mine.toml"), name).parent == pictures_folder(Path("/x/mine.toml"))


@given(st.text(st.characters(codec="utf-8"), min_size=1), st.text(st.characters(codec="utf-8"), min_size=1))
def test_points_with_different_names_have_different_picture_files(one: str, other: str) -> None:
    assert (picture_file(Path("p.toml"), one) == picture_file(Path("p.toml"), other)) == (one == other)


def test_a_saved_picture_is_read_back_to_the_pixel(tmp_path: Path) -> None:
    profile, path = Profile(points={"world": (0.25, 0.5)}), tmp_path / "mine.toml"
    pictures_folder(path).mkdir()
    picture_file(path, "world").write_bytes(picture_bytes(PICTURE))
    (point,) = load_click_points(profile, path).values()
    np.testing.assert_array_equal(point.picture, PICTURE)
    assert (point.name, point.at) == ("world", (0.25, 0.5))


@pytest.mark.parametrize("content", [None, b"", b"no picture"])
def test_a_point_whose_picture_is_missing_or_broken_is_left_out(content: bytes | None, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    if content is not None:
        pictures_folder(path).mkdir()
        picture_file(path, "world").write_bytes(content)
    assert load_click_points(Profile(points={"world": (0.25, 0.5)}), path) == {}
