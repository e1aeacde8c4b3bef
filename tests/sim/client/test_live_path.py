"""The live path, unchanged, on the virtual client: it builds, it keeps the contract, it reads every version."""

import itertools
import math
import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build, build_with_materials
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.rules import front_of
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.input.input_controller import FRESH_S, PressTarget
from mc_nested.live.live_game import LiveGame
from mc_nested.live.model.coordinates import Facing
from mc_nested.live.model.reading import Target
from mc_nested.live.model.timing import KEY_LOOK_S
from mc_nested.live.profile.tables import GameVersion, Profile, WalkTable
from mc_nested.live.vision.debug_screen import read_debug_screen
from sim.client.client import VirtualClient
from sim.client.drawing.painter import SEEN
from sim.client.game.debug_entries import GAME_DEFAULT
from sim.client.mishaps import KINDS
from tests.arena.game_contract import BUMPS, check_following, check_game, check_materials
from tests.sim.client.playing import FONT, SOON_S, TAP_S, arena_of, connection_to, play, read

LINE, FLAG = load_scenario("line"), load_scenario("flag")
LONGEST_WALKING_STEP = 0.217
"""Blocks a tick: steady walking is 0.216, sprinting 0.281 (FACTS: Walking)."""

VERSIONS = ["1.8.9", "1.12.2", "1.14.4", "1.16.5", "1.18.2", "1.20.1", "1.21.8", "1.21.11", "26.1", "26.3"]


class Walked(NamedTuple):
    """The measures of a walk: corrections, the median action in seconds, and the longest step of a tick in blocks."""

    corrections: int
    median_s: float
    longest_step: float


def profile_for(client: VirtualClient) -> Profile:
    return Profile(game=GameVersion(version=client.settings.version), arena=arena_of(client))


@pytest.mark.parametrize("version", ["1.12.2", "1.14.4", "1.20.1", "1.21.10", "26.1", "26.3", "26.4"])
def test_blocks_are_built_at_the_requested_cells_in_every_version(version: str) -> None:
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


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1"])
def test_the_flag_is_built_of_two_materials(version: str) -> None:
    client = VirtualClient(version=version, seed=2)
    arena = arena_of(client)
    with play(client, FLAG) as game:
        env = ArenaEnv(game, FLAG)
        env.reset()
        *_, last = [env.step(step) for step in build_with_materials(FLAG)]
    assert last[4]["score"] == FLAG.optimum
    of_cell = {cell: client.built[arena.block_of(cell)] for cell in client.placed(arena)}
    planks = "planks" if version == "1.12.2" else "oak_planks"
    assert of_cell == {
        cell: name for part, name in zip(FLAG.parts, ("stone", planks), strict=True) for cell in part.cells
    }
    assert client.window.down == set()
    assert client.window.strays == []


@pytest.mark.slow
@pytest.mark.parametrize("facing", ["south", "west", "north", "east"])
def test_a_live_game_on_the_virtual_client_takes_the_given_materials(facing: Facing) -> None:
    client = VirtualClient(seed=3)
    with play(client, FLAG, facing) as game:
        arena = arena_of(client, facing)

        def kinds() -> dict[Cell, str]:
            return {cell: client.built[arena.block_of(cell)] for cell in client.placed(arena)}

        steps = [(action, step // 2 % 3 - 1) for step, action in enumerate([*BUMPS, *build(FLAG)])]
        check_materials(game, FLAG, [(action, taken if taken >= 0 else None) for action, taken in steps], kinds)


@pytest.mark.slow
@pytest.mark.parametrize("facing", ["south", "west", "north", "east"])
def test_a_live_game_on_the_virtual_client_keeps_the_game_contract(facing: Facing) -> None:
    client = VirtualClient(seed=3)
    with play(client, LINE, facing) as game:
        arena = arena_of(client, facing)
        check_game(game, LINE, [*BUMPS, *build(LINE)], lambda: (client.cell(arena), client.placed(arena)))


@pytest.mark.parametrize("facing", ["south", "west"])
def test_a_live_game_on_the_virtual_client_does_the_same_whatever_follows(facing: Facing) -> None:
    client = VirtualClient(seed=3)
    with play(client, LINE, facing) as game:
        arena = arena_of(client, facing)
        check_following(game, LINE, [*BUMPS, *build(LINE)], lambda: (client.cell(arena), client.placed(arena)))
    assert client.window.down == set()
    assert client.window.strays == []


def test_a_live_game_refuses_another_action_than_the_one_whose_walk_has_begun() -> None:
    client, actions = VirtualClient(seed=3), build(LINE)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        told = itertools.pairwise(actions)
        while not game._body.is_under_way:  # the first ones show when the game's ticks are
            action, then = next(told)
            game.act(action, None, (then, None))
        assert "s" in client.window.down
        with pytest.raises(ValueError, match="was announced as the action that follows"):
            game.act(Action.L)
        assert client.window.down == set()
        with pytest.raises(LiveError, match="must be reset first"):
            game.act(then)
        game.reset(LINE.best_material)
        assert game.act(Action.L).cell == (6, 14)
    assert client.window.strays == []


def test_a_live_game_takes_any_action_where_no_walk_has_begun() -> None:
    client = VirtualClient(seed=3)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        game.act(Action.B, None, (Action.B, None))  # when the game's ticks are isn't known yet
        assert not game._body.is_under_way
        assert game.act(Action.L).cell == (6, 13)


@pytest.mark.parametrize("pause_s", [0.1, 5.0])
def test_a_pause_after_a_walk_has_begun_costs_time_alone(pause_s: float) -> None:
    client, actions = VirtualClient(seed=3), build(LINE)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        walks = 0
        for action, then in zip(actions, [*actions, None][1:], strict=True):
            game.act(action, None, None if then is None else (then, None))
            walks += game._body.is_under_way
            for _ in range(round(pause_s / KEY_LOOK_S)):
                client.clock.sleep(KEY_LOOK_S)
                game._controller.release_overdue()  # as the watchdog does
        arena = arena_of(client)
        assert client.placed(arena) == LINE.design
    assert walks > 1
    assert client.window.strays == []


@pytest.mark.slow
def test_no_key_stays_down_or_goes_to_another_window_despite_mishaps() -> None:
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


@pytest.mark.parametrize("world", ["bright", "dark", "noise", "grey noise", "specks", SEEN])
def test_the_target_block_is_read_over_any_world(world: str) -> None:
    client = VirtualClient(world=world, pitch=65.0)
    client.clock.sleep(0.2)
    assert read(client).target == Target((0, 63, 1), "minecraft:bedrock")


def test_positions_and_targets_are_read_over_the_drawn_world() -> None:
    client = VirtualClient(world=SEEN)
    random = np.random.default_rng(0)
    arena = arena_of(client)
    for _ in range(60):
        right, forward = (int(part) for part in random.integers(0, 15, 2))
        client.realm.world.put(
            arena.block_of((right, forward)), str(random.choice(["stone", "oak_planks", "white_wool"]))
        )
        client.realm.player.go_to(arena.centre_of((int(random.integers(15)), int(random.integers(15)))))
        client.realm.player.look(float(random.uniform(-180, 180)), float(random.uniform(20, 85)))
        client.clock.sleep(0.2)
        found, player = read(client), client.realm.player
        assert found.problem is None
        assert found.xyz == player.feet
        if found.target is not None and found.target.pos is not None:
            assert found.target.id == f"minecraft:{client.realm.world.block_at(found.target.pos)}"


@pytest.mark.parametrize(("version", "entry"), [("1.21.10", "looking_at_block "), ("26.4", "looking_at_block_state ")])
def test_a_reset_names_the_block_entry_that_is_off(version: str, entry: str) -> None:
    client = VirtualClient(version=version, debug_entries=GAME_DEFAULT)
    with play(client, LINE) as game, pytest.raises(LiveError, match=f"set {entry}"):
        game.reset(LINE.best_material)


def test_the_position_and_the_target_are_read_from_26_4s_boxes() -> None:
    client = VirtualClient(version="26.4", scale=1, pitch=65.0)
    client.clock.sleep(0.2)
    reading = read_debug_screen(client.display.grab(), FONT)
    assert (reading.xyz, reading.target) == ((0.5, 64.0, 0.5), Target((0, 63, 1), "minecraft:bedrock"))


@pytest.mark.slow
def test_the_client_without_a_reader_runs_far_faster_than_real_time() -> None:
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


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1"])
def test_a_reset_mends_a_floor_block_that_a_click_has_broken(version: str) -> None:
    client = VirtualClient(version=version)
    arena = arena_of(client).model_copy(update={"floor": client.settings.floor_block})
    with LiveGame(LINE, profile_for(client).model_copy(update={"arena": arena}), connection_to(client)) as game:
        game.reset(LINE.best_material)
        cell = game.act(Action.B).cell
        client.pointer.press("left")
        client.clock.sleep(TAP_S)
        client.pointer.release("left")
        client.clock.sleep(SOON_S)
        x, y, z = arena.block_of(front_of(cell))
        assert client.built == {(x, y - 1, z): "air"}
        game.reset(LINE.best_material)
        assert client.built == {}
        game.act(Action.B)
        assert game.act(Action.F).cell == client.cell(arena)


def walked(client: VirtualClient, patch: pytest.MonkeyPatch, actions: int, walk: WalkTable | None = None) -> Walked:
    """Walk forward and back for so many actions, each checked against the client's world."""
    arena, steps = arena_of(client), [0.0]
    profile = profile_for(client).model_copy(update={"walk": walk or WalkTable()})
    with LiveGame(LINE, profile, connection_to(client)) as game:
        game.reset(LINE.best_material)
        tick = client.game.tick

        def noted() -> None:
            x, _, z = client.realm.player.feet
            tick()
            steps.append(math.hypot(client.realm.player.feet[0] - x, client.realm.player.feet[2] - z))

        patch.setattr(client.game, "tick", noted)
        for count in range(actions):
            action = (Action.B, Action.F)[count // 8 % 2]
            assert game.act(action).cell == client.cell(arena)
    assert client.window.down == set()
    return Walked(game.log.effort.corrections, sorted(game.log.seconds)[actions // 2], max(steps))


def test_walking_straight_on_never_sprints(monkeypatch: pytest.MonkeyPatch) -> None:
    found = walked(VirtualClient(seed=1), monkeypatch, 48)
    assert found.longest_step < LONGEST_WALKING_STEP
    assert found.corrections <= 3


@pytest.mark.parametrize(
    ("latency_s", "median_s"), [((0.010, 0.030), 0.35), ((0.035, 0.060), 0.36), ((0.060, 0.090), 0.362)]
)
def test_actions_stay_fast_at_every_capture_latency_of_the_profile(
    latency_s: tuple[float, float], median_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(seed=2, capture_latency_s=latency_s)
    found = walked(client, monkeypatch, 48, WalkTable(capture_latency_s=sum(latency_s) / 2))
    assert found.corrections <= 3
    assert found.median_s <= median_s


@pytest.mark.parametrize("fps", [10.0, 15.0, 20.0, 30.0, 144.0])
@pytest.mark.parametrize("seed", range(3))
def test_the_line_is_built_right_at_any_frame_rate(fps: float, seed: int) -> None:
    client = VirtualClient(seed=seed, fps=fps)
    arena = arena_of(client)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        for action in build(LINE):
            assert game.act(action).cell == client.cell(arena)
    assert len(client.placed(arena)) == len(client.built) == LINE.blocks


@pytest.mark.parametrize("name", ["islands", "house", "square"])
def test_a_design_of_up_to_100_blocks_is_built_to_the_block(name: str) -> None:
    scenario = load_scenario(name)
    client = VirtualClient(seed=4)
    arena = arena_of(client)
    with play(client, scenario) as game:
        game.reset(scenario.best_material)
        for action in build(scenario):
            assert game.act(action).cell == client.cell(arena)
    assert client.placed(arena) == scenario.design
    assert len(client.built) == scenario.blocks
    assert set(client.built.values()) == {"stone"}


def test_a_look_that_has_grown_too_old_is_taken_again(monkeypatch: pytest.MonkeyPatch) -> None:
    client = VirtualClient(seed=1)
    looks = itertools.count(1)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        confirm = game.connection.controller.confirm_screen

        def then_stall(screen: PressTarget, look_again: Callable[[], None] | None = None) -> None:
            confirm(screen, look_again)
            if next(looks) % 3 == 0:
                client.clock.sleep(FRESH_S + 0.05)

        monkeypatch.setattr(game.connection.controller, "confirm_screen", then_stall)
        for action in (Action.B, Action.BD, Action.LD, Action.F):
            assert game.act(action).cell == client.cell(arena_of(client))
    assert client.placed(arena_of(client)) == {(7, 13), (6, 13)}
