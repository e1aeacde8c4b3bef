"""Recovery in a game whose menus aren't English: by the recorded points, and by nothing else."""

from pathlib import Path

import pytest

from calibration.clicks.find import calibrate_clicks
from mc_nested.errors import DesktopError, LiveError
from mc_nested.live.menus import recovery
from mc_nested.live.menus.click_points import ClickPoints, load_click_points, record_point
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import Profile
from sim.client.client import VirtualClient
from sim.client.game.screens import MenuState, ScreenName, menu
from tests.calibration.contexts import SPANISH, context_of, profile_in, started
from tests.sim.client.playing import connection_to

RECORDED: dict[str, tuple[ScreenName, str]] = {
    "back_to_game": ("pause", "Back to Game"),
    "save_and_quit_to_title": ("pause", "Save and Quit to Title"),
    "singleplayer": ("title", "Singleplayer"),
    "play_selected_world": ("worlds", "Play Selected World"),
    "respawn": ("death", "Respawn"),
}


def points_of(client: VirtualClient) -> ClickPoints:
    """Return the points as a person records them by hand: hovering over each, and over the world's name."""
    width, height = client.window.size
    gui = -(-width // client.scale), -(-height // client.scale)
    points = {}
    places = {
        name: (
            screen,
            next(b.middle for b in menu(MenuState(screen), client.edition, *gui).buttons if b.label == label),
        )
        for name, (screen, label) in RECORDED.items()
    }
    row = next(each for each in menu(MenuState("worlds"), client.edition, *gui).texts if each.text == "New World")
    for name, (screen, middle) in {**places, "world": ("worlds", (row.left + 25, row.top + 4))}.items():
        client.game.open(screen)
        client.game.is_world_chosen = name == "play_selected_world"
        x, y = round(middle[0] * client.scale), round(middle[1] * client.scale)
        client.pointer.move(x, y)
        client.clock.sleep(1.5)
        points[name] = record_point(name, client.display.grab(), (x, y), client.scale)
    client.game.open("world")
    client.clock.sleep(0.3)
    return points


def way_of(client: VirtualClient, points: ClickPoints) -> Recovery:
    return Recovery(Profile(), connection_to(client), points)


@pytest.mark.parametrize("version", ["1.12.2", "1.16.5", "1.20.1", "1.21.9"])
@pytest.mark.parametrize("name", ["pause", "death", "title", "worlds"])
def test_recovery_leads_back_from_every_screen_with_recorded_points(version: str, name: ScreenName) -> None:
    client = VirtualClient(version=version, words=SPANISH)
    way = way_of(client, points_of(client))
    if name == "death":
        client.game.die()
    else:
        client.game.open(name)
    client.clock.sleep(1.5)
    assert way.screen_name() == name
    assert way.recover()[0] == name
    assert client.game.screen == "world"
    assert (client.window.down, client.window.strays) == (set(), [])


def test_the_world_is_left_and_entered_by_recorded_points() -> None:
    client = VirtualClient(words=SPANISH)
    way = way_of(client, points_of(client))
    way.leave_world()
    assert way.screen_name() == "title"
    assert way.recover()[0] == "title"
    assert way.screen_name() == "world"


def test_the_title_screen_is_unknown_without_points_and_nothing_is_clicked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recovery, "PATIENCE_S", 8.0)
    client = VirtualClient(words=SPANISH)
    client.game.open("title")
    client.clock.sleep(0.3)
    with pytest.raises(LiveError, match="the world was not reached"):
        way_of(client, {}).recover()
    assert client.game.screen == "title"


def test_points_of_another_window_size_are_not_clicked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recovery, "PATIENCE_S", 8.0)
    client = VirtualClient(words=SPANISH)
    points = points_of(client)
    client.resize((1024, 768))
    client.game.open("title")
    client.clock.sleep(0.3)
    with pytest.raises(LiveError, match="the screen is unknown"):
        way_of(client, points).recover()
    assert client.game.screen == "title"


def test_points_recorded_in_english_do_not_match_menus_in_spanish(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recovery, "PATIENCE_S", 8.0)
    file = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path), file)
    calibrate_clicks(file, context_of(started(VirtualClient())))
    client = VirtualClient(words=SPANISH)
    client.game.open("title")
    client.clock.sleep(0.3)
    with pytest.raises(LiveError, match="the screen is unknown"):
        way_of(client, load_click_points(load_profile(file), file)).recover()
    assert client.game.screen == "title"


def test_a_spanish_title_is_recognised_as_a_single_players_world() -> None:
    client = VirtualClient(words=SPANISH)
    assert client.display.title() == "Minecraft 1.20.1 - Un jugador"
    connection_to(client).check_single_player()


def test_a_title_with_an_unknown_word_for_singleplayer_is_refused() -> None:
    client = VirtualClient(words={**SPANISH, "Singleplayer": "Jokalari bakarra"})
    with pytest.raises(DesktopError, match="set the game's language to English"):
        connection_to(client).check_single_player()
