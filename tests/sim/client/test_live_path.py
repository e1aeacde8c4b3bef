"""The live path, unchanged, on the virtual client: it builds, it keeps the contract, it reads every version."""

import time

import pytest

from mc_nested.arena.builder import build
from mc_nested.arena.rules import Action
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.model.coordinates import Facing
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.debug_screen import read_debug_screen
from sim.client.client import VirtualClient
from sim.client.mishaps import KINDS
from tests.arena.game_contract import BUMPS, check_game
from tests.sim.client.playing import FONT, arena_of, play, read

LINE = load_scenario("line")
VERSIONS = ["1.8.9", "1.12.2", "1.14.4", "1.16.5", "1.18.2", "1.20.1", "1.21.8", "1.21.11", "26.1", "26.3"]


@pytest.mark.parametrize("version", ["1.12.2", "1.14.4", "1.20.1", "26.1"])
def test_blocks_are_built_where_they_were_asked_for(version: str) -> None:
    client = VirtualClient(version=version)
    arena = arena_of(client)
    with play(client, LINE) as game:
        assert game.reset(LINE.best_material) == LINE.start == client.cell(arena)
        for action in (Action.B, Action.BD, Action.LD, Action.F):
            outcome = game.act(action)
            assert outcome.cell == client.cell(arena)
    assert client.placed(arena) == {(7, 13), (6, 13)}
    assert set(client.built.values()) == {"stone"}
    assert client.window.down == set()
    assert client.window.strays == []


@pytest.mark.slow
@pytest.mark.parametrize("facing", ["south", "west", "north", "east"])
def test_the_contract_of_every_game_holds_on_the_virtual_client(facing: Facing) -> None:
    client = VirtualClient(seed=3)
    with play(client, LINE, facing) as game:
        arena = arena_of(client, facing)
        check_game(game, LINE, [*BUMPS, *build(LINE)], lambda: (client.cell(arena), client.placed(arena)))


@pytest.mark.slow
def test_whatever_happens_no_key_stays_down_or_goes_to_another_window() -> None:
    for seed in range(8):
        client = VirtualClient(seed=seed)
        client.mishaps.every(0.3, KINDS)
        try:
            with play(client, LINE) as game:
                game.reset(LINE.best_material)
                for action in build(LINE):
                    game.act(action)
        except LiveError:
            assert client.mishaps.happened
        assert client.window.down == set()
        assert client.window.strays == []


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("size", [(854, 480), (1366, 768)])
def test_every_versions_screen_is_read_at_every_scale(version: str, size: tuple[int, int]) -> None:
    for scale in range(1, 5):
        client = VirtualClient(version=version, size=size, scale=scale, seed=scale, yaw=-90.0, pitch=65.0)
        client.clock.sleep(0.2)
        reading = read_debug_screen(client.display.grab(), FONT)
        assert reading.problem is None
        assert (reading.xyz, reading.yaw, reading.pitch) == ((0.5, 64.0, 0.5), -90.0, 65.0)
        assert reading.target == Target((1, 63, 0), "minecraft:bedrock")


@pytest.mark.parametrize("world", ["bright", "dark", "noise", "grey noise", "specks"])
def test_the_world_behind_makes_no_difference(world: str) -> None:
    client = VirtualClient(world=world, pitch=65.0)
    client.clock.sleep(0.2)
    assert read(client).target == Target((0, 63, 1), "minecraft:bedrock")


def test_26_4_is_recognised_and_named_as_unsupported() -> None:
    client = VirtualClient(version="26.4")
    client.clock.sleep(0.2)
    problem = read_debug_screen(client.display.grab(), FONT).problem
    assert problem is not None
    assert "26.4 has a layout that can't be read yet" in problem


@pytest.mark.slow
def test_without_the_reader_the_client_runs_far_faster_than_the_game() -> None:
    client = VirtualClient()
    began, at = time.process_time(), client.clock.now()
    for index in range(400):
        key = "ws"[index % 2]
        client.keyboard.press(key)
        client.clock.sleep(0.15)
        client.keyboard.release(key)
        for _ in range(4):
            client.display.grab()
            client.clock.sleep(0.04)
    # A tenth of what an idle machine reaches: this is to notice a picture that is drawn whole each time.
    assert (client.clock.now() - at) / (time.process_time() - began) > 30
