"""The walk through the menus, on virtual clients of every version: what is found, where, and that it comes back."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from calibration.clicks.find import (
    MENU_POINTS,
    QUESTION,
    calibrate_clicks,
    find_clicks,
    find_clicks_unattended,
)
from calibration.clicks.recorded_point import RecordedPoint
from mc_nested.errors import LiveError, NotConfirmedError, ProfileError
from mc_nested.live.menus import recovery
from mc_nested.live.menus.click_points import looks_the_same
from mc_nested.live.menus.point_pictures import load_click_points
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import decoded
from sim.client.client import VirtualClient
from sim.client.game.screens import MenuState, ScreenName, menu
from tests.calibration.contexts import SPANISH, context_of, context_over, profile_in, started

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
    """The middle of a point's button as the client draws it, in framebuffer pixels."""
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


def test_without_a_yes_the_world_is_not_left(tmp_path: Path) -> None:
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
def test_a_world_that_others_may_share_is_not_left_and_nothing_is_asked(
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


def test_without_the_open_to_lan_button_the_world_is_not_left_either(tmp_path: Path) -> None:
    # 1.12 never says in its title who else may be there (FACTS: Input and windows).
    client = started(VirtualClient(version="1.12.2", words={"Open to LAN": "Player Reporting"}))
    found = find_clicks(context_over(client), profile_in(tmp_path))
    assert set(found.profile.points) == set(PAUSE)


def test_the_death_screen_is_reported_as_not_seen_and_never_guessed(tmp_path: Path) -> None:
    found = find_clicks(context_over(started(VirtualClient())), profile_in(tmp_path))
    assert "respawn" not in found.profile.points
    assert any(line.startswith("respawn: not seen") for line in found.lines)
    assert found.samples == 5
    assert found.step == "clicks"


def test_in_another_language_nothing_is_guessed_and_the_rest_is_asked_for_by_hand(tmp_path: Path) -> None:
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


def test_a_button_that_a_pack_renames_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recovery, "PATIENCE_S", 8.0)
    client = started(VirtualClient(words={"Play Selected World": "Upgrade and Play"}))
    profile = profile_in(tmp_path)
    with pytest.raises(LiveError, match="the world was not reached"):
        find_clicks(context_over(client), profile)
    assert client.window.down == set()


@pytest.mark.parametrize("change", ["walked", "turned"])
def test_coming_back_elsewhere_is_an_error(change: str, tmp_path: Path) -> None:
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
    assert decoded(written[1].read_bytes(), 1) is not None
    profile = load_profile(file)
    assert set(profile.points) == {*LABELS, "world", "other"}
    assert set(load_click_points(profile, file)) == {*LABELS, "world"}, "without a picture none is clicked"
    client.game.open("pause")
    client.clock.sleep(0.3)
    frame = client.display.grab()
    alike = {name for name, point in load_click_points(profile, file).items() if looks_the_same(point, frame)}
    assert alike == set(PAUSE)


def test_where_nothing_was_found_nothing_is_written(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path), file)
    assert calibrate_clicks(file, context_of(started(VirtualClient(words=SPANISH))), is_by_hand=False) is None
    assert sorted(each.name for each in tmp_path.iterdir()) == ["ascii.png", "mine.toml"]


def test_a_profile_without_a_font_is_refused_with_the_step_to_run_first(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="calibrate font first"):
        calibrate_clicks(tmp_path / "new.toml", context_of(VirtualClient()))
