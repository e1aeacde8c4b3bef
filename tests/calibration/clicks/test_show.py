"""Recorded points, shown to a person: marked on a picture of the screen, or pointed at with the mouse."""

from pathlib import Path

import numpy as np
import pytest

from calibration.clicks.find import calibrate_clicks
from calibration.clicks.point_drawings import MARK_COLOUR, SEEN_COLOUR, picture_of_screen
from calibration.clicks.show import show_clicks, try_clicks
from mc_nested.errors import ProfileError
from mc_nested.live.menus.point_pictures import load_click_points, picture_file
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.vision.font import decoded
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_of, profile_in, started


@pytest.fixture
def recorded(tmp_path: Path) -> Path:
    file = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path), file)
    calibrate_clicks(file, context_of(started(VirtualClient())))
    return file


def test_a_dry_run_moves_the_mouse_to_what_is_there_and_presses_nothing(recorded: Path) -> None:
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


def test_show_marks_what_is_there_green_and_the_rest_red(recorded: Path) -> None:
    client = started(VirtualClient())
    client.game.open("title")
    picture = decoded(show_clicks(recorded, context_of(client)).read_bytes(), 1)
    assert picture is not None
    points = load_click_points(load_profile(recorded), recorded)
    for name, point in points.items():
        x, y = point.position(client.window.size)
        expected = SEEN_COLOUR if name == "singleplayer" else MARK_COLOUR
        assert tuple(int(part) for part in picture[y, x]) == expected
    assert picture.shape[1] == 854
    assert picture.shape[0] > 480
    assert picture_file(recorded, "world").is_file()


def test_what_was_never_recorded_can_not_be_shown(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="run mc-nested calibrate clicks"):
        show_clicks(tmp_path / "new.toml", context_of(VirtualClient()))


def test_a_screen_without_points_stays_as_it_is() -> None:
    frame = np.zeros((4, 4, 3), np.uint8)
    assert np.array_equal(picture_of_screen({}, frame), frame)
