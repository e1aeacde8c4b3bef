"""The walk through the menus: it records points, notes missing labels, and ends in the world."""

from pathlib import Path

import pytest

from calibration.clicks.menu_walk import MENU_S, MenuWalk
from mc_nested.errors import LiveError
from sim.client.client import VirtualClient
from tests.calibration.contexts import SPANISH, context_over, profile_in, started


def walk_on(client: VirtualClient, folder: Path) -> tuple[MenuWalk, list[str]]:
    said: list[str] = []
    profile = profile_in(folder)
    return MenuWalk(context_over(client).connection.for_profile(profile), profile, said.append), said


def test_visit_to_the_pause_menu_records_two_points_and_recognises_single_player(tmp_path: Path) -> None:
    client = started(VirtualClient())
    walk, said = walk_on(client, tmp_path)
    assert (walk.points, walk.notes, walk.is_single_player, walk.scale) == ({}, [], False, 2)
    assert len(said) == 1
    walk.visit_pause_menu()
    assert list(walk.points) == ["back_to_game", "save_and_quit_to_title"]
    assert walk.is_single_player
    assert walk.notes == []
    assert client.game.screen == "world"
    for name, point in walk.points.items():
        assert point.name == name
        assert point.frame.shape == (480, 854, 3)
        assert abs(point.at[0] - 0.5) < 0.01, "both are in the middle"


def test_visit_to_the_title_records_three_points_of_the_title_and_the_world_list(tmp_path: Path) -> None:
    client = started(VirtualClient())
    walk, _ = walk_on(client, tmp_path)
    walk.visit_title()
    assert list(walk.points) == ["singleplayer", "world", "play_selected_world"]
    assert client.game.screen == "world"
    # The world's name begins 100 GUI pixels left of the middle, in the first row of the list.
    x, y = walk.points["world"].at
    assert 0.5 - 100 * 2 / 854 < x < 0.5
    assert 48 * 2 / 480 < y < (48 + 36) * 2 / 480


@pytest.mark.parametrize("words", [{"Open to LAN": "Player Reporting"}, {"Save and Quit to Title": "Disconnect"}])
def test_world_is_not_taken_for_single_player_if_one_of_its_buttons_is_missing(
    words: dict[str, str], tmp_path: Path
) -> None:
    walk, _ = walk_on(started(VirtualClient(words=words)), tmp_path)
    walk.visit_pause_menu()
    assert not walk.is_single_player


@pytest.mark.parametrize(("version", "is_own"), [("26.3", True), ("1.12.2", False)])
def test_world_options_button_means_single_player_only_if_the_title_says_so(
    version: str, is_own: bool, tmp_path: Path
) -> None:
    client = started(VirtualClient(version=version, words={"Open to LAN": "World Options..."}))
    walk, _ = walk_on(client, tmp_path)
    walk.visit_pause_menu()
    assert walk.is_single_player is is_own


def test_a_menu_without_a_known_label_is_noted_and_left(tmp_path: Path) -> None:
    client = started(VirtualClient(words=SPANISH))
    walk, _ = walk_on(client, tmp_path)
    began = client.clock.now()
    walk.visit_pause_menu()
    assert walk.points == {}
    assert len(walk.notes) == 1
    assert walk.notes[0].startswith("the Game Menu: no English label")
    assert MENU_S <= client.clock.now() - began < 4 * MENU_S
    assert client.game.screen == "world"
    with pytest.raises(LiveError, match="the Game Menu didn't open"):
        walk.visit_title()


def test_a_button_that_is_missing_is_noted(tmp_path: Path) -> None:
    walk, _ = walk_on(started(VirtualClient(words={"Save and Quit to Title": "Disconnect"})), tmp_path)
    walk.visit_pause_menu()
    assert list(walk.points) == ["back_to_game"]
    assert [note.split(":")[0] for note in walk.notes] == ["save_and_quit_to_title"]


def test_a_window_that_changes_its_size_ends_the_walk(tmp_path: Path) -> None:
    client = started(VirtualClient())
    walk, _ = walk_on(client, tmp_path)
    client.resize((1024, 768))
    with pytest.raises(LiveError, match="changed its size"):
        walk.visit_pause_menu()
