"""The click points, found on virtual clients of every version or recorded by hand, and written.

Recording clicks by hand: what a hotkey records, what is refused, the picture, and what leaves no trace.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.clicks.find import (
    MENU_POINTS,
    QUESTION,
    calibrate_clicks,
    find_clicks,
    find_clicks_unattended,
    record_by_hand,
)
from calibration.clicks.points import MARK_COLOUR, TILE_WIDTH, RecordedPoint, picture_of_points
from calibration.context import CalibrationContext, OpenContext, StepResult
from mc_nested.errors import LiveError, NotConfirmedError, ProfileError, UserError
from mc_nested.live.connection import GameConnection
from mc_nested.live.desktop.clock import MonotonicClock
from mc_nested.live.devices import Button, Devices, Frame, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.menus import recovery
from mc_nested.live.menus.click_points import load_click_points, looks_the_same
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import decoded
from sim.client.client import VirtualClient
from sim.client.desktop.window import VirtualClipboard
from sim.client.game.screens import MenuState, ScreenName, menu
from tests.calibration.contexts import SPANISH, NoKeys, context_of, context_over, profile_in, started

LABELS: dict[str, tuple[ScreenName, str]] = {
    "back_to_game": ("pause", "Back to Game"),
    "save_and_quit_to_title": ("pause", "Save and Quit to Title"),
    "singleplayer": ("title", "Singleplayer"),
    "play_selected_world": ("worlds", "Play Selected World"),
}
PAUSE = ("back_to_game", "save_and_quit_to_title")
VERSIONS = [
    "1.8.9",
    "1.12.2",
    "1.13.2",
    "1.14.4",
    "1.16.5",
    "1.19.4",
    "1.20.1",
    "1.21.8",
    "1.21.11",
    "26.1",
    "26.2",
    "26.3",
]
SIZES = [(854, 480), (1024, 768), (1366, 768), (1919, 1079), (2560, 1440)]
WORLDS = ["noise", "bright", "dark", "specks", "grey noise"]


def true_middle(client: VirtualClient, name: str) -> tuple[float, float]:
    """Return the middle of a point's button as the client draws it, in framebuffer pixels."""
    screen, label = LABELS[name]
    width, height = client.window.size
    gui = -(-width // client.scale), -(-height // client.scale)
    buttons = menu(MenuState(screen), client.edition, *gui).buttons
    x, y = next(button.middle for button in buttons if button.label == label)
    return x * client.scale, y * client.scale


def check_all_found(client: VirtualClient, profile: Profile) -> None:
    before = client.realm.player.feet
    found = find_clicks(context_over(started(client)), profile)
    assert set(found.profile.points) == {*LABELS, "world"}
    for point in found.points:
        x, y = point.position(client.window.size)
        if point.name in LABELS:
            true_x, true_y = true_middle(client, point.name)
            assert max(abs(x - true_x), abs(y - true_y)) <= 2 * client.scale, point.name
        else:
            gui_x, gui_y = x / client.scale, y / client.scale
            row = next(b for b in menu(MenuState("worlds"), client.edition, 400, 300).buttons if b.label == "")
            left = -(-client.window.size[0] // client.scale) // 2 - 135 + 32
            assert left < gui_x < left + 238
            assert row.top <= gui_y < row.top + 36
    assert (client.game.screen, client.realm.player.feet) == ("world", before)
    assert (client.window.down, client.window.strays) == (set(), [])


@pytest.mark.parametrize("version", ["1.12.2", "1.16.5", "1.20.1", "1.21.11", "26.2", "26.3"])
def test_every_button_is_found_within_two_gui_pixels_of_its_middle(version: str, tmp_path: Path) -> None:
    check_all_found(VirtualClient(version=version), profile_in(tmp_path))


@pytest.mark.slow
@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("scale", [1, 2, 3, 4])
def test_every_button_is_found_in_every_version_scale_and_size(version: str, scale: int, tmp_path: Path) -> None:
    for seed in (VERSIONS.index(version), VERSIONS.index(version) + scale):
        size, world = SIZES[seed % len(SIZES)], WORLDS[seed % len(WORLDS)]
        client = VirtualClient(version=version, scale=scale, size=size, seed=seed, world=world)
        check_all_found(client, profile_in(tmp_path))


def test_the_world_is_not_left_unless_the_player_answers_yes(tmp_path: Path) -> None:
    client = started(VirtualClient())
    questions: list[str] = []

    def refuse(question: str) -> bool:
        questions.append(question)
        return False

    found = find_clicks(context_over(client, refuse), profile_in(tmp_path))
    assert questions == [QUESTION]
    assert set(found.profile.points) == set(PAUSE)
    assert "not visited" in found.lines[-1]


@pytest.mark.parametrize("title", ["Minecraft 1.20.1 - Multiplayer (LAN)", "Minecraft 1.20.1 - Multiplayer (Realms)"])
def test_shared_world_is_not_left_and_nothing_is_asked(
    title: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = started(VirtualClient())
    monkeypatch.setattr(client.display, "title", lambda: title)

    def never(question: str) -> bool:
        raise AssertionError(question)

    found = find_clicks(context_over(client, never), profile_in(tmp_path))
    assert set(found.profile.points) == set(PAUSE)
    assert "may not be a world of your own" in found.lines[-1]


def test_another_programs_menus_are_left_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    client = started(VirtualClient())
    monkeypatch.setattr(client.display, "title", lambda: "Prismarine Web Client - Chromium")
    monkeypatch.setattr(client.keyboard, "press", None)
    found = find_clicks(context_over(client), profile_in(tmp_path))
    assert found.points == ()
    assert "names no Minecraft" in found.lines[-1]


def test_in_1_12_the_world_is_not_left_without_an_open_to_lan_button(tmp_path: Path) -> None:
    # 1.12 never says in its title who else may be there (FACTS: Input and windows).
    client = started(VirtualClient(version="1.12.2", words={"Open to LAN": "Player Reporting"}))
    found = find_clicks(context_over(client), profile_in(tmp_path))
    assert set(found.profile.points) == set(PAUSE)


def test_respawn_button_is_reported_as_not_seen_and_never_guessed(tmp_path: Path) -> None:
    found = find_clicks(context_over(started(VirtualClient())), profile_in(tmp_path))
    assert "respawn" not in found.profile.points
    assert any(line.startswith("respawn: not seen") for line in found.lines)
    assert found.samples == 5
    assert found.step == "clicks"


def test_in_another_language_no_button_is_found_and_the_points_are_asked_for_by_hand(tmp_path: Path) -> None:
    client = started(VirtualClient(words=SPANISH))
    wanted: list[str] = []

    def by_hand(names: Mapping[str, str]) -> list[RecordedPoint]:
        wanted.extend(names)
        return []

    found = find_clicks(context_over(client), profile_in(tmp_path), by_hand)
    assert found.profile.points == {}
    assert set(wanted) == set(MENU_POINTS) - {"respawn"}
    assert found.lines == (
        "no button was found; the Game Menu: no English label is seen after Esc, so nothing of it was recorded",
    )
    assert (client.game.screen, client.window.down) == ("world", set())


def test_unattended_the_step_fails_if_no_button_is_found(tmp_path: Path) -> None:
    with pytest.raises(
        NotConfirmedError, match=r"^no button was found; .*no English label.*: record them by hand with"
    ):
        find_clicks_unattended(context_over(started(VirtualClient(words=SPANISH))), profile_in(tmp_path))


def test_renamed_play_selected_world_button_is_an_error_with_no_key_down(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recovery, "PATIENCE_S", 8.0)
    client = started(VirtualClient(words={"Play Selected World": "Upgrade and Play"}))
    profile = profile_in(tmp_path)
    with pytest.raises(LiveError, match="the world was not reached"):
        find_clicks(context_over(client), profile)
    assert client.window.down == set()


@pytest.mark.parametrize("change", ["walked", "turned"])
def test_player_who_was_moved_or_turned_during_the_menu_walk_is_an_error(change: str, tmp_path: Path) -> None:
    client = started(VirtualClient())

    def move() -> None:
        player = client.realm.player
        if change == "walked":
            player.go_to((3.5, 64.0, 0.5))
        else:
            player.look(90.0, 0.0)

    client.clock.call_at(client.clock.now() + 3.0, move)
    with pytest.raises(LiveError, match="stands elsewhere"):
        find_clicks(context_over(client), profile_in(tmp_path))


def test_the_chat_is_not_in_the_pictures_of_the_game_menu(tmp_path: Path) -> None:
    def seen(words: str) -> list[RecordedPoint]:
        client = started(VirtualClient(capture_latency_s=(0.0, 0.0)))
        client.game.chat.say(words, client.game.ticks)
        return [
            RecordedPoint(each.title, (0, 0), each.frame)
            for each in find_clicks(context_over(client), profile).pictures
        ]

    profile = profile_in(tmp_path)
    one, other = seen("<Ann> my address is"), seen("<Bob> who is that")
    assert np.array_equal(one[0].frame, other[0].frame)


def test_the_profile_its_pictures_and_an_overview_are_written(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path).model_copy(update={"points": {"other": (0.5, 0.5)}}), file)
    client = started(VirtualClient())
    written = calibrate_clicks(file, context_of(client))
    assert written is not None
    assert written[1] == tmp_path / "mine-clicks.png"
    assert decoded(written[1].read_bytes()).size
    profile = load_profile(file)
    assert set(profile.points) == {*LABELS, "world", "other"}
    assert set(load_click_points(profile, file)) == {*LABELS, "world"}, "without a picture none is clicked"
    client.game.open("pause")
    client.clock.sleep(0.3)
    frame = client.display.grab()
    alike = {name for name, point in load_click_points(profile, file).items() if looks_the_same(point, frame)}
    assert alike == set(PAUSE)


def test_nothing_is_written_if_no_button_was_found(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path), file)
    assert calibrate_clicks(file, context_of(started(VirtualClient(words=SPANISH))), is_by_hand=False) is None
    assert sorted(each.name for each in tmp_path.iterdir()) == ["ascii.png", "mine.toml"]


def test_a_profile_without_a_font_is_refused_with_the_step_to_run_first(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="calibrate font first"):
        calibrate_clicks(tmp_path / "new.toml", context_of(VirtualClient()))


SCREEN = np.random.default_rng(0).integers(0, 256, (300, 400, 3), np.uint8)
SCREEN[150:, 200:] = 40
"""Something to be seen everywhere but in one corner."""

LARGE_SCREEN = np.random.default_rng(0).integers(0, 256, (2160, 3840, 3), np.uint8)


@dataclass
class Player:
    """A person at the game: at each key press, mouse and window are as one of ``doings`` says."""

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


def recorded(player: Player, names: Iterable[str]) -> dict[str, tuple[float, float]]:
    wanted = {name: f"{name} somewhere" for name in names}
    points = record_by_hand(wanted, player, Mouse(player), player.next_key, skip="f9", say=player.say)
    return {point.name: point.at for point in points}


@given(st.integers(0, 3839), st.integers(0, 2159))
def test_recorded_point_leads_back_to_its_pixel_within_one_pixel(x: int, y: int) -> None:
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


def context_with(player: Player) -> OpenContext:
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
    return calibrate_clicks(file, context_with(player), names=names, listen=heard(player))


def test_menu_points_are_asked_for_and_written_with_a_picture_beside_the_profile(tmp_path: Path) -> None:
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
        calibrate_clicks(tmp_path / "new.toml", context_with(Player([])), hotkey="f8", skip="f8")


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
