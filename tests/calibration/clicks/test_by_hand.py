"""Recording clicks by hand: what a hotkey records, what is refused, the picture, and what leaves no trace."""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.clicks.by_hand import record_by_hand
from calibration.clicks.find import MENU_POINTS, calibrate_clicks
from calibration.clicks.point_drawings import MARK_COLOUR, TILE_WIDTH, picture_of_points
from calibration.clicks.recorded_point import RecordedPoint
from calibration.context import CalibrationContext, StepResult
from calibration.open_context import OpenContext
from mc_nested.errors import ProfileError, UserError
from mc_nested.live.connection import GameConnection
from mc_nested.live.desktop.clock import MonotonicClock
from mc_nested.live.devices import Button, Devices, Frame, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.menus.point_pictures import load_click_points
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile
from sim.client.desktop.clipboard import VirtualClipboard

SCREEN = np.random.default_rng(0).integers(0, 256, (300, 400, 3), np.uint8)
SCREEN[150:, 200:] = 40
"""Something to be seen everywhere but in one corner."""

LARGE_SCREEN = np.random.default_rng(0).integers(0, 256, (2160, 3840, 3), np.uint8)


@dataclass
class Player:
    """Somebody at the game: each key press finds the mouse and the window as one of ``doings`` says."""

    doings: list[tuple[str, tuple[int, int], bool]]
    window: tuple[int, int] = (400, 300)
    told: list[str] = field(default_factory=list)
    at: tuple[int, int] = (0, 0)
    in_front: bool = True

    def next_key(self) -> str:
        if not self.doings:
            raise KeyboardInterrupt
        key, self.at, self.in_front = self.doings.pop(0)
        return key

    def say(self, text: str) -> None:
        self.told.append(text)

    def size(self) -> tuple[int, int]:
        return self.window

    def title(self) -> str:
        return "Minecraft 1.20.1"

    def is_in_front(self) -> bool:
        return self.in_front

    def grab(self, region: Region | None = None) -> Frame:
        assert region is None
        return SCREEN if self.window == (400, 300) else LARGE_SCREEN


class Mouse:
    """The player's mouse, which nothing but the player may move or press."""

    def __init__(self, player: Player) -> None:
        self.player = player

    def position(self) -> tuple[int, int]:
        return self.player.at

    def move(self, x: int, y: int) -> None:
        raise AssertionError((x, y))

    def press(self, button: Button) -> None:
        raise AssertionError(button)

    release = press


class NoKeys:
    """A keyboard that this calibration must not touch."""

    def press(self, key: str) -> None:
        raise AssertionError(key)

    def go_by_symbols(self, keys: Collection[str]) -> None:
        raise AssertionError(keys)

    release = type = press


def recorded(player: Player, names: Iterable[str]) -> dict[str, tuple[float, float]]:
    wanted = {name: f"{name} somewhere" for name in names}
    points = record_by_hand(wanted, player, Mouse(player), player.next_key, skip="f9", say=player.say)
    return {point.name: point.at for point in points}


@given(st.integers(0, 3839), st.integers(0, 2159))
def test_a_recorded_fraction_leads_back_to_within_a_pixel(x: int, y: int) -> None:
    player = Player([("f8", (x, y), True)], window=(3840, 2160))
    across, down = recorded(player, ["respawn"])["respawn"]
    assert abs(across * 3840 - x) < 1
    assert abs(down * 2160 - y) < 1


def test_each_name_gets_the_position_of_the_mouse_at_its_key() -> None:
    player = Player([("f8", (100, 75), True), ("f9", (0, 0), True), ("f8", (200, 30), True)])
    assert recorded(player, ["singleplayer", "world", "respawn"]) == {
        "singleplayer": (0.25, 0.25),
        "respawn": (0.5, 0.1),
    }


@pytest.mark.parametrize(
    ("place", "in_front", "complaint"),
    [
        ((-1, 20), True, "outside"),
        ((400, 20), True, "outside"),
        ((20, 300), True, "outside"),
        ((20, 20), False, "front"),
    ],
)
def test_a_press_outside_the_game_is_reported_and_waits_for_another(
    place: tuple[int, int], in_front: bool, complaint: str
) -> None:
    player = Player([("f8", place, in_front), ("f8", (100, 75), True)])
    assert recorded(player, ["world"]) == {"world": (0.25, 0.25)}
    assert complaint in player.told[-1]


def test_the_picture_shows_every_screen_with_its_mark() -> None:
    frame = np.full((480, 854, 3), 90, np.uint8)
    points = [RecordedPoint("singleplayer", (0.5, 0.25), frame), RecordedPoint("respawn", (0.25, 0.75), frame)]
    picture = picture_of_points(points)
    height = picture.shape[0] // 2
    assert picture.shape == (2 * height, TILE_WIDTH, 3)
    for index, point in enumerate(points):
        x, y = int(point.at[0] * TILE_WIDTH), index * height + int(point.at[1] * height)
        assert tuple(picture[y, x]) == MARK_COLOUR


def context_of(player: Player) -> OpenContext:
    @contextmanager
    def opened(profile: Profile) -> Iterator[CalibrationContext]:
        devices = Devices(player, NoKeys(), Mouse(player), MonotonicClock(), VirtualClipboard())
        connection = GameConnection(devices, InputController(devices, profile.input))
        yield CalibrationContext(connection, player.say, lambda _: False)

    return opened


def heard(player: Player) -> Callable[[Sequence[str]], AbstractContextManager[Callable[[], str]]]:
    @contextmanager
    def listen(keys: Sequence[str]) -> Iterator[Callable[[], str]]:
        assert set(keys) == {"f8", "f9"}
        yield player.next_key

    return listen


def calibrated(file: Path, player: Player, names: Sequence[str] = tuple(MENU_POINTS)) -> tuple[StepResult, Path] | None:
    return calibrate_clicks(file, context_of(player), names=names, listen=heard(player))


def test_the_menus_points_are_asked_for_and_written_with_a_picture_beside_the_profile(tmp_path: Path) -> None:
    player = Player([("f8", (100, 75), True)] * len(MENU_POINTS))
    written = calibrated(tmp_path / "mine.toml", player)
    assert written is not None
    assert written[1] == tmp_path / "mine-clicks.png"
    assert load_profile(tmp_path / "mine.toml").points == dict.fromkeys(MENU_POINTS, (0.25, 0.25))
    picture = cv2.imdecode(np.fromfile(tmp_path / "mine-clicks.png", np.uint8), cv2.IMREAD_COLOR)
    assert picture is not None
    assert picture.shape == (480 * len(MENU_POINTS), TILE_WIDTH, 3)


def test_points_that_are_skipped_stay_as_they_were(tmp_path: Path) -> None:
    file = tmp_path / "old.toml"
    file.write_text("# mine\n[points]\nworld = [0.1, 0.2]\nrespawn = [0.3, 0.4]\n", "utf-8")
    calibrated(file, Player([("f9", (0, 0), True), ("f8", (200, 140), True)]), ["world", "respawn"])
    assert load_profile(file).points == {"world": (0.1, 0.2), "respawn": (0.5, 0.4667)}
    assert file.read_text("utf-8").startswith("# mine\n")


def test_nothing_is_written_where_every_point_was_skipped(tmp_path: Path) -> None:
    player = Player([("f9", (0, 0), True)] * len(MENU_POINTS))
    assert calibrated(tmp_path / "new.toml", player) is None
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_half_way_leaves_the_old_profile_and_no_picture(tmp_path: Path) -> None:
    file = tmp_path / "old.toml"
    file.write_text("[points]\nworld = [0.1, 0.2]\n", "utf-8")
    before = file.read_bytes()
    with pytest.raises(KeyboardInterrupt):
        calibrated(file, Player([("f8", (100, 75), True)]))
    assert file.read_bytes() == before
    assert list(tmp_path.iterdir()) == [file]


def test_each_point_leaves_its_own_picture(tmp_path: Path) -> None:
    calibrated(tmp_path / "mine.toml", Player([("f8", (100, 75), True)]), ["world/../x"])
    point = load_click_points(load_profile(tmp_path / "mine.toml"), tmp_path / "mine.toml")["world/../x"]
    # At GUI scale 1, the largest that 400 x 300 has: 96 x 10 pixels around the mouse.
    np.testing.assert_array_equal(point.picture, SCREEN[70:80, 52:148])
    assert [each.parent for each in (tmp_path / "mine-points").iterdir()] == [tmp_path / "mine-points"]


def test_a_spot_where_nothing_is_drawn_is_reported_and_waits_for_another() -> None:
    player = Player([("f8", (300, 200), True), ("f8", (100, 75), True)])
    assert recorded(player, ["world"]) == {"world": (0.25, 0.25)}
    assert "nothing is drawn" in player.told[-1]


def test_one_key_can_not_both_record_and_skip(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="both record and skip"):
        calibrate_clicks(tmp_path / "new.toml", context_of(Player([])), hotkey="f8", skip="f8")


def test_a_profile_that_can_not_be_used_is_reported_before_a_window_is_looked_for(tmp_path: Path) -> None:
    file = tmp_path / "broken.toml"
    file.write_text("[points]\nworld = [7, 0.2]\n", "utf-8")
    player = Player([])
    with pytest.raises(ProfileError, match="points"):
        calibrated(file, player)
    assert player.told == []


def test_a_picture_that_can_not_be_written_is_reported(tmp_path: Path) -> None:
    (tmp_path / "mine-clicks.png").mkdir()
    with pytest.raises(ProfileError, match="picture can't be written"):
        calibrated(tmp_path / "mine.toml", Player([("f8", (100, 75), True)]), ["world"])
