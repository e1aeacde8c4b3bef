"""The live path on keyboards of other layouts, in the version that goes by symbols and in those that go by places."""

from pathlib import Path

import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError
from mc_nested.live.connection import prepare_keyboard
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.tables import GameVersion, InputTable, KeysTable, Profile
from mc_nested.live.session import open_live_game
from sim.client.client import VirtualClient
from sim.client.desktop.keyboard import LAYOUTS
from tests.live.virtual_session import opening_on, profile_in
from tests.sim.client.playing import arena_of, play

LINE, FLAG = load_scenario("line"), load_scenario("flag")
OLD = "1.12.2"
WITHOUT_LATIN_LETTERS = ("ru", "gr", "il")


@pytest.mark.parametrize("layout", sorted({*LAYOUTS} - {*WITHOUT_LATIN_LETTERS}))
def test_up_to_1_12_two_materials_are_built_under_every_latin_layout(layout: str) -> None:
    client = VirtualClient(version=OLD, layout=layout, seed=2)
    with play(client, FLAG) as game:
        env = ArenaEnv(game, FLAG)
        env.reset()
        *_, last = [env.step(step) for step in build_with_materials(FLAG)]
    assert last[4]["score"] == FLAG.optimum
    assert client.window.down == set()
    client.clock.sleep(0.1)
    assert client.game.keys.physical == set()


@pytest.mark.parametrize("layout", ["fr", "ru", "dvorak"])
def test_from_1_13_on_blocks_are_built_under_any_layout(layout: str) -> None:
    client = VirtualClient(version="1.13.2", layout=layout)
    arena = arena_of(client)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        for action in (Action.B, Action.BD, Action.LD):
            game.act(action)
    assert client.placed(arena) == {(7, 13), (6, 13)}


@pytest.mark.parametrize("layout", WITHOUT_LATIN_LETTERS)
def test_up_to_1_12_a_layout_without_latin_letters_is_refused_before_any_press(layout: str, tmp_path: Path) -> None:
    client = VirtualClient(version=OLD, layout=layout)
    opened = open_live_game(LINE, opening_on(client, profile_in(tmp_path)))
    with pytest.raises(DesktopError, match="types no w, s, a, d, t: switch to English") as raised, opened:
        pass
    assert "\n" not in str(raised.value)
    assert client.game.keys.physical == set()
    assert client.window.strays == []


def test_the_profiles_version_decides_on_symbols_if_the_title_names_none(monkeypatch: pytest.MonkeyPatch) -> None:
    client = VirtualClient(version=OLD, layout="fr")
    monkeypatch.setattr(client.display, "title", lambda: "All the Blocks")
    prepare_keyboard(Profile(game=GameVersion(version=OLD)), client.devices)
    client.keyboard.press("w")
    client.clock.sleep(0.1)
    assert client.game.keys.physical == {"w"}


def test_a_key_that_the_profile_changes_must_exist_in_the_layout() -> None:
    client = VirtualClient(version=OLD, layout="de")
    keys = KeysTable(chat="/")
    with pytest.raises(DesktopError, match="types no /:"):
        prepare_keyboard(Profile(keys=keys), client.devices)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_up_to_1_12_tap_alone_presses_a_digit_without_the_sneak_key(layout: str) -> None:
    client = VirtualClient(version=OLD, layout=layout)
    if layout not in WITHOUT_LATIN_LETTERS:
        prepare_keyboard(Profile(), client.devices)
    controller = InputController(client.devices, InputTable())
    controller.confirm_screen("world")
    controller.press(client.clock.now() + 0.2, "left.shift")
    controller.tap_alone("2")
    client.clock.sleep(0.2)
    assert client.realm.player.slot == 1
    assert client.game.keys.physical == set()
