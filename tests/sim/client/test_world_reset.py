"""A reset without cheats: by clicks, through the title screen, with the world's folder restored from its template."""

from pathlib import Path

import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError, RunError
from mc_nested.live.live_game import LiveGame
from mc_nested.live.menus.reset import MARKER
from mc_nested.live.profile.tables import GameVersion, Profile
from sim.client.client import VirtualClient
from tests.sim.client.playing import arena_of, connection_to, play, world_in

LINE = load_scenario("line")


def _game(client: VirtualClient, folder: Path) -> LiveGame:
    return LiveGame(
        LINE,
        Profile(
            game=GameVersion(version=client.settings.version),
            arena=arena_of(client),
            world=world_in(client, LINE, folder),
        ),
        connection_to(client),
    )


@pytest.mark.parametrize("version", ["1.12.2", "1.16.5", "1.20.1", "1.21.9"])
def test_a_reset_without_cheats_restores_the_world_by_clicks(version: str, tmp_path: Path) -> None:
    folder = tmp_path / "saves" / "arena"
    client = VirtualClient(version=version, has_cheats=False, world_folder=folder)
    client.clock.sleep(0.2)
    with _game(client, folder) as game:
        arena = arena_of(client)
        for _ in range(2):
            assert game.reset(1) == LINE.start == client.cell(arena)
            assert client.placed(arena) == set()
            assert game.act(Action.BD).placed == (7, 14)
            assert client.placed(arena) == {(7, 14)}
    assert client.window.down == set()
    assert client.realm.day_time == 6000


def test_a_world_without_the_marker_file_is_left_as_it_is(tmp_path: Path) -> None:
    folder = tmp_path / "saves" / "arena"
    client = VirtualClient(has_cheats=False, world_folder=folder)
    client.clock.sleep(0.2)
    with _game(client, folder) as game:
        game.reset(1)
        game.act(Action.BD)
        (folder / MARKER).unlink()
        with pytest.raises(RunError, match=f"has no {MARKER}"):
            game.reset(1)
    assert client.placed(arena_of(client)) == {(7, 14)}


def test_a_reset_of_a_multiplayer_game_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    client = VirtualClient()
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (3rd-party Server)")
    with (
        play(client, LINE) as game,
        pytest.raises(DesktopError, match=r"others may be playing there.*--server-allowed"),
    ):
        game.reset(1)
    assert client.built == {}
