"""LiveGame: the rules of the task, played with keys in a world that knows none of them."""

import contextlib
import dataclasses
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build, build_with_materials
from mc_nested.arena.game import Outcome
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError, LiveError, NotConfirmedError, NotInFrontError, ProfileError, StoppedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Frame, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.live_game import RESET_TRIES, LiveGame, check_fits
from mc_nested.live.menus.reset import reset_commands
from mc_nested.live.model.coordinates import Facing
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import GameVersion, Profile, WorldTable
from tests.arena.game_contract import BUMPS, check_following, check_game, check_materials
from tests.live.fake_game import FakeDisplay, FakeGame, FakeScreen, connection_to, devices_of

LINE, FLAG = load_scenario("line"), load_scenario("flag")
STONE = LINE.best_material
facings = st.sampled_from(["north", "south", "west", "east"])
actions = st.sampled_from(list(Action))


def _world(facing: Facing = "south", version: str = "1.20.1") -> FakeGame:
    profile = Profile(game=GameVersion(version=version), arena=Arena.around((-20, 64, 31), facing))
    return FakeGame(profile)


def _play(world: FakeGame, scenario: Scenario = LINE, fail_after: int = -1) -> LiveGame:
    return LiveGame(
        scenario,
        world.profile,
        connection_to(world, fail_after=fail_after),
    )


def _commands(world: FakeGame) -> list[str]:
    return reset_commands(world.profile, LINE.start, [material.block for material in LINE.materials])


def _cell_of(world: FakeGame) -> Cell:
    right, forward = world.profile.marked_arena().position_of(world.xyz)
    return round(right), round(forward)


@pytest.mark.parametrize("version", ["1.12.2", "1.16.5", "1.20.1"])
def test_a_reset_clears_the_arena_and_puts_the_agent_on_the_start(version: str) -> None:
    world = _world(version=version)
    arena = world.profile.marked_arena()
    outside = arena.block_of((15, 3))
    world.blocks = {arena.block_of((4, 4)): "stone", outside: "dirt"}
    game = _play(world)
    assert game.reset(STONE) == LINE.start == _cell_of(world)
    assert world.built == {outside}
    assert (world.yaw, world.pitch) == (arena.yaw, 65.0)
    assert world.hotbar[world.slot] == "stone"
    assert world.leaked == ""


@pytest.mark.parametrize("material", [0, 1])
def test_walking_backward_builds_the_line(material: int) -> None:
    world = _world("west")
    with _play(world) as game:
        game.reset(material)
        for action in [Action.B, Action.B, *[Action.BD] * 11]:
            game.act(action)
    arena = world.profile.marked_arena()
    block = LINE.materials[material].block
    assert world.blocks == {arena.block_of(cell): block for cell in LINE.design}


@given(facings, st.lists(actions, max_size=14))
def test_every_outcome_agrees_with_the_rules_and_with_the_world(facing: Facing, chosen: list[Action]) -> None:
    world = _world(facing)
    arena = world.profile.marked_arena()
    game = _play(world)
    cell, placed = game.reset(STONE), set[Cell]()
    for action in chosen:
        presses = len(world.presses)
        outcome = game.act(action)
        target = rules.moved(cell, action, placed, LINE.size)
        landing = rules.landing(target, action, placed, LINE.size)
        if target == cell and landing is None:
            assert len(world.presses) == presses
        cell = target
        placed |= {landing} if landing else set()
        assert (outcome.cell, outcome.placed) == (cell, landing)
        assert _cell_of(world) == cell
        assert world.built == {arena.block_of(block) for block in placed}


@given(st.lists(actions, max_size=4), st.floats(0.0, 12.0), st.integers(-1, 250), st.integers(0, 3))
def test_no_key_stays_down_or_goes_to_another_window_whatever_happens(
    chosen: list[Action], front_s: float, fail_after: int, refused: int
) -> None:
    world = _world()
    world.front_until = world.clock.now() + front_s
    world.refuse_clicks = refused
    with contextlib.suppress(LiveError, OSError), _play(world, fail_after=fail_after) as game:
        game.reset(STONE)
        for action in chosen:
            game.act(action)
    assert world.down == set()
    assert world.presses_behind == []


@pytest.mark.parametrize("facing", ["north", "south", "west", "east"])
def test_a_live_game_keeps_the_game_contract(facing: Facing) -> None:
    world = _world(facing)
    check_game(_play(world), LINE, [*BUMPS, *build(LINE)])
    check_following(_play(_world(facing)), LINE, [*BUMPS, *build(LINE)])
    assert world.down == set()


def _kinds(world: FakeGame) -> dict[Cell, str]:
    arena = world.profile.marked_arena()
    cells = ((x, y) for x in range(FLAG.size) for y in range(FLAG.size))
    return {cell: world.blocks[arena.block_of(cell)] for cell in cells if arena.block_of(cell) in world.blocks}


def test_each_part_of_the_flag_is_built_of_its_most_valuable_material() -> None:
    world = _world()
    check_materials(_play(world, FLAG), FLAG, build_with_materials(FLAG), lambda: _kinds(world))
    halves = [{_kinds(world)[cell] for cell in part.cells} for part in FLAG.parts]
    assert halves == [{"stone"}, {"oak_planks"}]
    assert world.down == set()


def test_a_hotbar_key_is_pressed_only_when_the_material_changes() -> None:
    world = _world()
    game = _play(world, FLAG)
    game.reset(STONE)
    taken = []
    for action, material in ((Action.B, STONE), (Action.B, 0), (Action.B, 0), (Action.B, None), (Action.B, STONE)):
        before = len(world.presses)
        game.act(action, material)
        taken.append([key for key in world.presses[before:] if key in world.profile.keys.hotbar])
    assert taken == [[], ["1"], [], [], ["2"]]


def test_a_block_of_the_wrong_material_is_an_error_and_requires_a_reset() -> None:
    world = _world()
    game = _play(world, FLAG)
    game.reset(STONE)
    world.hotbar[0] = "stone"  # somebody else has changed the hotbar
    with pytest.raises(NotConfirmedError, match=r"stone at .* was placed, not minecraft:oak_planks"):
        game.act(Action.BD, 0)
    with pytest.raises(LiveError, match="must be reset first"):
        game.act(Action.B)
    game.reset(STONE)
    assert game.act(Action.BD, 0).placed == (7, 14), "the reset has filled the hotbar again"
    assert _kinds(world) == {(7, 14): "oak_planks"}


def test_a_game_must_be_reset_after_an_error() -> None:
    world = _world()
    game = _play(world)
    with pytest.raises(LiveError, match="must be reset first"):
        game.act(Action.B)
    game.reset(STONE)
    world.blocks[world.profile.marked_arena().block_of((7, 13))] = "dirt"
    with pytest.raises(NotConfirmedError):
        game.act(Action.B)
    with pytest.raises(LiveError, match="must be reset first"):
        game.act(Action.L)
    assert game.reset(STONE) == LINE.start
    assert game.act(Action.B).cell == (7, 13)


def test_a_reset_forgets_the_blocks_of_the_episode_before() -> None:
    world = _world()
    game = _play(world)
    for _ in range(2):
        game.reset(STONE)
        game.act(Action.B)
        assert game.act(Action.BD).placed == (7, 13)


def test_a_failed_release_is_repeated_before_its_error_is_raised() -> None:
    world = _world()
    # Calls: a command is a tap, its letters and a tap; then come the slot's tap, and the move's press and release.
    calls = sum(4 + len(command) for command in _commands(world)) + 2 + 1
    game = _play(world, fail_after=calls)
    game.reset(STONE)
    with pytest.raises(OSError, match="keyboard is gone"):
        game.act(Action.B)
    assert world.presses[-1] == "s"
    assert world.down == set()


def test_a_reset_fails_if_the_game_refuses_the_teleport() -> None:
    world = _world()
    world.refuse_commands = "/tp"
    with pytest.raises(NotConfirmedError, match=r"teleport to cell .* was not seen"):
        _play(world).reset(STONE)


def test_a_reset_types_nothing_if_the_chat_does_not_open() -> None:
    world = _world()
    world.profile = world.profile.model_copy(update={"keys": world.profile.keys.model_copy(update={"chat": "y"})})
    game = LiveGame(
        LINE,
        _world().profile,
        connection_to(world),
    )
    with pytest.raises(NotConfirmedError, match="the chat did not open"):
        game.reset(STONE)
    assert world.leaked == ""


def test_a_reset_faces_the_nearest_of_the_leftmost_blocks_and_sees_it_removed() -> None:
    world = _world("south")
    arena = world.profile.marked_arena()
    game = _play(world)
    game.reset(STONE)
    for action in (Action.BD, Action.BD, Action.RD):
        game.act(action)
    assert world.built == {arena.block_of(cell) for cell in ((7, 14), (7, 13), (8, 13))}
    world.commands.clear()
    game.reset(STONE)
    x, _, z = arena.centre_of((7, 12))
    clear, *others = _commands(world)
    assert world.commands == [f"/tp @s {x:.1f} 64 {z:.1f} 0 65", clear, *others]
    assert world.built == set()


def test_a_reset_without_placed_blocks_sends_only_the_reset_commands() -> None:
    world = _world()
    game = _play(world)
    game.reset(STONE)
    assert world.commands == _commands(world)


def test_the_log_counts_actions_failures_and_resets_that_had_to_be_repeated() -> None:
    world = _world()
    game = _play(world)
    game.reset(STONE)
    began = world.clock.now()
    game.act(Action.B)
    assert game.log.seconds == [world.clock.now() - began]
    assert (game.log.failed_actions, game.log.failed_resets, game.log.recoveries) == (0, 0, 0)
    world.xyz = world.profile.marked_arena().centre_of((3, 3))
    with pytest.raises(NotConfirmedError):
        game.act(Action.B)
    assert (len(game.log.seconds), game.log.failed_actions) == (1, 1)
    world.refuse_commands = "/tp"
    with pytest.raises(NotConfirmedError):
        game.reset(STONE)
    assert game.log.failed_resets == RESET_TRIES - 1


def test_a_reset_that_fails_for_good_leaves_the_last_frames_and_names_them(tmp_path: Path) -> None:
    class GreyDisplay(FakeDisplay):
        """The fake game's window, grey all over."""

        def grab(self, region: Region | None = None) -> Frame:
            assert region is None
            return np.full((480, 854, 3), 99, np.uint8)

    world = _world()
    world.refuse_commands = "/tp"
    devices = dataclasses.replace(devices_of(world), display=GreyDisplay(world))
    connection = GameConnection(devices, InputController(devices, world.profile.input), FakeScreen(world))
    game = LiveGame(LINE, world.profile, connection, evidence=tmp_path)
    with pytest.raises(NotConfirmedError, match=r"was not seen.*; what was seen last: .*last-3\.png") as caught:
        game.reset(STONE)
    assert type(caught.value) is NotConfirmedError
    assert len(list(tmp_path.glob("*.png"))) == 3


def test_a_stopped_game_ends_a_reset_at_once() -> None:
    world = _world()
    game = _play(world)
    game.connection.controller.stop("the panic key was pressed")
    with pytest.raises(StoppedError):
        game.reset(STONE)
    assert game.log.failed_resets == 0
    assert world.presses == []


def test_a_game_shared_with_others_is_not_reset() -> None:
    class SharedDisplay(FakeDisplay):
        """The fake game's window in a world that others may join."""

        def title(self) -> str:
            return "Minecraft 1.20.1 - Multiplayer (LAN)"

    world = _world()
    devices = dataclasses.replace(devices_of(world), display=SharedDisplay(world))
    connection = GameConnection(devices, InputController(devices, world.profile.input), FakeScreen(world))
    with pytest.raises(DesktopError, match="others may be playing there"):
        LiveGame(LINE, world.profile, connection).reset(STONE)
    assert world.presses == []


def test_a_reset_fails_if_a_block_stays_because_the_game_refused_to_clear() -> None:
    world = _world()
    game = _play(world)
    game.reset(STONE)
    game.act(Action.BD)
    world.refuse_commands = "/fill"
    with pytest.raises(NotConfirmedError, match="only the floor should be at"):
        game.reset(STONE)


def test_a_foreign_block_in_front_of_the_agent_is_an_error() -> None:
    world = _world()
    game = _play(world)
    game.reset(STONE)
    world.blocks[world.profile.marked_arena().block_of((6, 14))] = "dirt"
    with pytest.raises(NotConfirmedError, match="only the floor should be at"):
        [game.act(action) for action in (Action.B, Action.L)]


def test_an_action_that_presses_nothing_notices_that_the_agent_was_moved() -> None:
    world = _world()
    game = _play(world)
    game.reset(STONE)
    world.xyz = world.profile.marked_arena().centre_of((3, 3))
    world.clock.sleep_until(world.clock.now() + 0.1)
    with pytest.raises(NotConfirmedError, match=r"left cell \(7, 14\) by itself, it is at \(3.00, 3.00\)"):
        game.act(Action.F)


def test_a_reset_presses_nothing_while_another_window_is_in_front() -> None:
    world = _world()
    world.front_until = 0.0
    with pytest.raises(NotInFrontError):
        _play(world).reset(STONE)
    assert world.presses == []


def test_a_reset_types_no_command_without_a_readable_debug_screen() -> None:
    world = _world()
    world.unreadable = True
    with pytest.raises(LiveError, match="the world was not reached"):
        _play(world).reset(STONE)
    assert set(world.presses) == {"f3", "esc"}


def test_more_materials_than_the_hotbar_has_slots_are_refused() -> None:
    many = dataclasses.replace(LINE, materials=tuple(Material(f"m{index}", 0.0, "stone") for index in range(10)))
    with pytest.raises(ProfileError, match="10 materials, the hotbar only 9 slots"):
        _play(_world(), many)


def test_nine_materials_fill_the_hotbar_and_the_last_can_be_taken() -> None:
    world = _world()
    nine = dataclasses.replace(LINE, materials=tuple(Material(f"m{index}", 0.0, "stone") for index in range(9)))
    _play(world, nine).reset(8)
    assert world.slot == 8


def _large(size: int) -> Scenario:
    return dataclasses.replace(LINE, name="large", size=size)


def test_a_scenario_larger_than_the_profiles_arena_is_refused_with_the_step_to_repeat() -> None:
    world = _world()
    with pytest.raises(ProfileError) as caught:
        _play(world, _large(20))
    assert str(caught.value) == (
        "scenario large needs 20 x 20 cells, and the profile's arena has 15 x 15: "
        "run mc-nested calibrate arena --size 20"
    )
    assert world.presses == []


def test_the_step_to_repeat_names_the_profile_and_only_marks_in_a_world_without_cheats() -> None:
    world = WorldTable(name="mine", folder="~/saves/mine", template="~/saves/template")
    profile = Profile(arena=Arena.around((0, 64, 0), "south", size=16), world=world)
    check_fits(_large(16), profile, "mine")
    step = "run mc-nested calibrate arena --size 17 --mark-only --profile mine"
    with pytest.raises(ProfileError, match=f"arena has 16 x 16: {step}$"):
        check_fits(_large(17), profile, "mine")


@given(facings, st.lists(actions, max_size=14))
def test_a_scenario_keeps_its_own_edge_in_a_larger_arena(facing: Facing, chosen: list[Action]) -> None:
    world = FakeGame(Profile(arena=Arena.around((-20, 64, 31), facing, size=18)))
    game, near_edge = _play(world), (Action.R,) * 7
    cell, placed = game.reset(STONE), set[Cell]()
    for action in (*near_edge, *chosen):
        cell = rules.moved(cell, action, placed, 15)
        block = rules.landing(cell, action, placed, 15)
        placed |= {block} if block else set()
        assert game.act(action) == Outcome(cell, block)
        assert _cell_of(world) == cell
