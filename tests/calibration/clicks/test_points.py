"""A recorded point as one that can be clicked.

Points drawn for a person: marked on their own screens, or on the one that is there.

Recorded points, shown to a person: marked on a picture of the screen, or pointed at with the mouse.
"""

from pathlib import Path

import cv2
import numpy as np
import pytest

from calibration.clicks.find import calibrate_clicks, largest_scale
from calibration.clicks.points import (
    MARK_COLOUR,
    SEEN_COLOUR,
    TILE_WIDTH,
    RecordedPoint,
    picture_of_points,
    picture_of_screen,
    show_clicks,
    try_clicks,
)
from mc_nested.errors import ProfileError
from mc_nested.live.devices import Frame
from mc_nested.live.menus.click_points import load_click_points, picture_file
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.vision.font import decoded
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_of, profile_in, started

FRAME = np.arange(480 * 854 * 3, dtype=np.uint32).astype(np.uint8).reshape(480, 854, 3)


@pytest.mark.parametrize(
    ("at", "rows", "columns"),
    [
        ((0.5, 0.5), slice(230, 250), slice(331, 523)),
        ((1.0, 1.0), slice(469, 480), slice(757, 854)),
        ((0.0, 0.0), slice(0, 10), slice(0, 96)),
    ],
)
def test_point_picture_is_the_area_around_the_point_cut_off_at_the_window_edge(
    at: tuple[float, float], rows: slice, columns: slice
) -> None:
    point = RecordedPoint("world", at, FRAME).click_point(2)
    assert (point.name, point.at) == ("world", at)
    assert np.array_equal(point.picture, FRAME[rows, columns])


@pytest.mark.parametrize(
    ("size", "scale"),
    [((854, 480), 2), ((639, 480), 1), ((640, 479), 1), ((100, 100), 1), ((1920, 1080), 4), ((3840, 2160), 4)],
)
def test_the_game_picks_the_largest_gui_scale_that_fits(size: tuple[int, int], scale: int) -> None:
    assert largest_scale(*size) == scale


def at(picture: Frame, x: int, y: int) -> tuple[int, ...]:
    return tuple(int(part) for part in picture[y, x])


def test_each_recorded_screen_is_a_tile_of_one_width_with_its_point_marked() -> None:
    wide, tall = np.full((480, 960, 3), 90, np.uint8), np.full((600, 300, 3), 90, np.uint8)
    picture = picture_of_points([RecordedPoint("one", (0.5, 0.5), wide), RecordedPoint("other", (0.25, 0.75), tall)])
    assert picture.shape == (320 + 1280, TILE_WIDTH, 3)
    assert at(picture, 320, 160) == at(picture, 160, 320 + 960) == MARK_COLOUR
    assert at(picture, 600, 300) == (90, 90, 90)
    # The name stands on a black strip above, as wide as the name and 16 pixels more.
    assert at(picture, 1, 1) == (0, 0, 0)
    strip = int((picture[1] != 0).any(axis=1).argmax())
    assert strip == cv2.getTextSize("one", cv2.FONT_HERSHEY_SIMPLEX, 0.6, 1)[0][0] + 16
    assert at(picture, 1, 28) == (90, 90, 90)


def test_current_screen_is_drawn_with_each_point_framed_and_its_recorded_picture_below() -> None:
    client = started(VirtualClient())
    client.game.open("pause")
    client.clock.sleep(0.3)
    frame = client.display.grab()
    here = RecordedPoint("here", (0.5, 0.325), frame).click_point(2)
    changed = np.rot90(frame, 2).copy()
    picture = picture_of_screen({"here": here}, frame)
    (x, y), (height, width) = here.position((854, 480)), here.picture.shape[:2]
    assert picture.shape == (480 + max(height, 24) + 8, 854, 3)
    assert at(picture, x - width // 2, y - height // 2) == SEEN_COLOUR
    assert at(picture, x + width // 2, y + height // 2) == SEEN_COLOUR
    assert at(picture, x, y) == SEEN_COLOUR
    for left, top in ((x - width // 2 - 3, y - height // 2), (x - width // 2, y - height // 2 - 3)):
        assert at(picture, left, top) != SEEN_COLOUR
    for right, bottom in ((x + width // 2 + 3, y + height // 2), (x + width // 2, y + height // 2 + 3)):
        assert at(picture, right, bottom) != SEEN_COLOUR
    assert np.array_equal(picture[484 : 484 + height, 4 : 4 + width], here.picture)
    assert at(picture, 1, 481) == (32, 32, 32)
    assert at(picture_of_screen({"here": here}, changed), x, y) == MARK_COLOUR
    assert np.array_equal(frame, client.display.grab()), "what was grabbed is not drawn on"


@pytest.fixture
def recorded(tmp_path: Path) -> Path:
    file = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path), file)
    calibrate_clicks(file, context_of(started(VirtualClient())))
    return file


def test_dry_run_moves_the_mouse_to_the_buttons_on_screen_and_presses_nothing(recorded: Path) -> None:
    client = started(VirtualClient())
    client.game.open("pause")
    lines = try_clicks(recorded, context_of(client))
    assert [line.split(":")[0] for line in lines if "mouse over it" in line] == [
        "back_to_game",
        "save_and_quit_to_title",
    ]
    assert len(lines) == 5
    x, y = load_click_points(load_profile(recorded), recorded)["save_and_quit_to_title"].position(client.window.size)
    assert client.pointer.position() == pytest.approx((x, y), abs=2 * client.scale)
    assert client.game.screen == "pause"


def test_a_dry_run_in_the_world_does_not_turn_the_view(recorded: Path) -> None:
    client = started(VirtualClient())
    assert all("not on this screen" in line for line in try_clicks(recorded, context_of(client)))
    assert (client.realm.player.yaw, client.realm.player.pitch) == (client.settings.yaw, client.settings.pitch)


def test_show_marks_the_points_on_this_screen_green_and_the_others_red(recorded: Path) -> None:
    client = started(VirtualClient())
    client.game.open("title")
    picture = decoded(show_clicks(recorded, context_of(client)).read_bytes())
    points = load_click_points(load_profile(recorded), recorded)
    for name, point in points.items():
        x, y = point.position(client.window.size)
        expected = SEEN_COLOUR if name == "singleplayer" else MARK_COLOUR
        assert tuple(int(part) for part in picture[y, x]) == expected
    assert picture.shape[1] == 854
    assert picture.shape[0] > 480
    assert picture_file(recorded, "world").is_file()


def test_show_without_recorded_points_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="run mc-nested calibrate clicks"):
        show_clicks(tmp_path / "new.toml", context_of(VirtualClient()))


def test_a_screen_without_points_stays_as_it_is() -> None:
    frame = np.zeros((4, 4, 3), np.uint8)
    assert np.array_equal(picture_of_screen({}, frame), frame)
