"""Building the arena on the virtual client: the question, the commands, the copy of the ground, and undo.

The question before an arena is built, and the summary after it.
"""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from calibration.arena import build
from calibration.arena.build import build_arena, build_question, build_summary, calibrate_built_arena, undo_hint
from calibration.arena.ground_survey import GroundSurvey, LookAroundResult
from calibration.arena.undo import note_path, read_copy_note, undo_arena, undo_built_arena
from calibration.context import StepResult
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build as build_of
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError, McNestedError, NotConfirmedError, ProfileError, UserError
from mc_nested.live.live_game import LiveGame
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.arena import FLOOR, Arena, box_of
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import Profile, WorldTable
from sim.client.client import VirtualClient
from sim.client.game.commands import chat_line
from sim.client.game.debug_entries import GAME_DEFAULT
from sim.client.mishaps import Kind
from tests.calibration.contexts import context_on, kept_profile, profile_of
from tests.calibration.walk.test_measure import Cut
from tests.sim.client.playing import connection_to

HERE = Arena.around((7, 64, 0), "south")
"""The arena of a player who stands where virtual clients begin, and looks south."""

LONGEST_S = 60.0


@pytest.fixture
def client() -> VirtualClient:
    return VirtualClient()


def built(client: VirtualClient, folder: Path, questions: list[str] | None = None) -> StepResult:
    def ask(question: str) -> bool:
        assert client.built == before
        (questions if questions is not None else []).append(question)
        return True

    before, began = client.built, client.clock.now()
    with context_on(client, ask=ask)(profile_of(client, folder)) as context:
        found = build_arena(context, profile_of(client, folder))
    assert client.clock.now() - began < LONGEST_S
    assert client.window.down == set()
    return found


def spoiled(version: str = "1.20.1") -> tuple[VirtualClient, dict[Block, str]]:
    """Return a client with a trunk in the arena, a hole in its floor and a block beside it, and what is built there."""
    client = VirtualClient(version=version)
    client.realm.world.put((3, 64, 6), "stone")
    client.realm.world.put((3, 63, 9), "air")
    client.realm.world.put((12, 64, 6), "dirt")
    return client, client.built


def build_in(client: VirtualClient, profile: Profile, **options: Any) -> Profile:
    """Build an arena; return the profile with it."""
    with context_on(client)(profile) as context:
        return build_arena(context, profile, **options).profile


def undo_in(client: VirtualClient, profile: Profile) -> StepResult:
    with context_on(client)(profile) as context:
        return undo_arena(context, profile)


@pytest.mark.parametrize("version", ["1.12.2", "1.13.2", "1.20.1", "1.21.11", "26.3"])
def test_on_free_flat_ground_only_the_border_is_built_and_undo_removes_it(version: str, tmp_path: Path) -> None:
    client = VirtualClient(version=version, pitch=12.0)
    questions: list[str] = []
    found = built(client, tmp_path, questions)
    arena = found.profile.marked_arena()
    assert arena.model_copy(update={"copied_to": None}) == HERE.model_copy(update={"floor": "bedrock"})
    assert found.profile.game.version == version
    assert "There is only air" in questions[0]
    assert "The floor, bedrock, is flat: it stays" in questions[0]
    ring = {block for block, name in client.built.items() if name == "lapis_block" and block[1] == 64}
    assert len(ring) == 4 * 16
    low, high = box_of(HERE)
    assert all(low[0] <= x <= high[0] and low[2] <= z <= high[2] for x, _, z in client.built)
    assert {y for _, y, _ in client.built} == {64, 127}
    rules = {"false"} & set(client.realm.rules.values())
    assert rules == {"false"}
    assert len(client.realm.rules) == 3
    assert [stack.block for stack in client.realm.player.hotbar[:2] if stack] == (
        ["planks" if version == "1.12.2" else "oak_planks", "stone"]
    )
    assert (client.cell(arena), client.realm.player.yaw, client.realm.player.pitch) == ((7, 0), 0.0, 65.0)
    undone = undo_in(client, found.profile)
    assert client.built == {}
    assert undone.profile.arena is None


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1"])
def test_blocks_in_the_way_are_copied_before_building_and_put_back_by_undo(version: str, tmp_path: Path) -> None:
    client, before = spoiled(version)
    questions: list[str] = []
    found = built(client, tmp_path, questions)
    assert ("Something stands there" if version != "1.12.2" else "What stands there is not known") in questions[0]
    if version != "1.12.2":
        assert "minecraft:stone at (3, 64, 6)" in questions[0]
    assert "it is replaced by obsidian" in questions[0]
    world = client.realm.world
    assert {world.block_at((x, 63, z)) for x in range(-8, 9) for z in range(-1, 16)} == {"obsidian"}
    assert {world.block_at((x, y, z)) for x in range(-7, 8) for y in (64, 65) for z in range(15)} == {"air"}
    assert world.block_at((12, 64, 6)) == "dirt"
    undo_in(client, found.profile)
    assert client.built == before


def test_live_game_can_be_played_in_a_built_arena(tmp_path: Path) -> None:
    client, _ = spoiled()
    profile = built(client, tmp_path).profile
    arena = profile.marked_arena()
    line = load_scenario("line")
    with LiveGame(line, profile, connection_to(client)) as game:
        assert game.reset(line.best_material) == line.start
        for action in (Action.BD, Action.LD, Action.F, Action.RD):
            assert game.act(action).cell == client.cell(arena)
    assert {client.realm.world.block_at(arena.block_of(cell)) for cell in ((7, 14), (6, 14))} == {"stone"}


def test_build_asks_with_a_warning_if_the_game_can_neither_compare_nor_copy_blocks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for verb in ("execute", "clone", "difficulty"):
        monkeypatch.delitem(chat_line._COMMANDS, verb)
    client, _ = spoiled("1.18.2")
    questions: list[str] = []
    found = built(client, tmp_path, questions)
    assert "What stands there is not known (minecraft:stone at (3, 64, 6)" in questions[0]
    assert "may have holes, which is unknown here: it is replaced by obsidian" in questions[0]
    assert "this can't be undone" in questions[0]
    assert found.profile.marked_arena() == HERE.model_copy(update={"floor": FLOOR})
    with context_on(client)(found.profile) as context, pytest.raises(UserError, match="no copy is known"):
        undo_arena(context, found.profile)


@pytest.mark.parametrize(("size", "standing"), [(20, None), (32, (3, 5))])
def test_a_larger_arena_is_built_copied_checked_and_undone(
    size: int, standing: tuple[int, int] | None, tmp_path: Path
) -> None:
    client, _ = spoiled()
    client.realm.world.put((-9, 64, 18), "dirt")
    before, questions = client.built, list[str]()

    def agree(question: str) -> bool:
        questions.append(question)
        return True

    profile = profile_of(client, tmp_path)
    with context_on(client, ask=agree)(profile) as context:
        arena = build_arena(context, profile, size=size, standing=standing).profile.marked_arena()
    assert (arena.size, client.cell(arena)) == (size, standing or (size // 2, 0))
    low, high = arena.region
    assert [high[axis] - low[axis] + 1 for axis in range(3)] == [size, 2, size]
    assert "Something stands there (" in questions[0]
    assert ("7 of 7 looks saw the floor, 8 more cells are out of sight" in questions[0]) == (size == 32)
    world = client.realm.world
    floor = {world.block_at((x, 63, z)) for x in range(low[0] - 1, high[0] + 2) for z in range(low[2] - 1, high[2] + 2)}
    assert floor == {"obsidian"}
    ring = {block for block, name in client.built.items() if name == "lapis_block" and block[1] == 64}
    assert len(ring) == 4 * (size + 1)
    assert {world.block_at(arena.block_of((x, y))) for x in range(size) for y in range(size)} == {"air"}
    undo_in(client, profile.model_copy(update={"arena": arena}))
    assert client.built == before


def test_design_in_the_far_corner_of_a_20_cell_arena_is_built_block_for_block(tmp_path: Path) -> None:
    client = VirtualClient()
    profile = build_in(client, profile_of(client, tmp_path), size=20)
    arena = profile.marked_arena()
    far = frozenset({(19, 19), (18, 19), (16, 17), (19, 16)})
    stone = load_scenario("line").materials[1]
    scenario = Scenario("far corner", far, (17, 14), 60, (stone,), 20)
    with LiveGame(scenario, profile, connection_to(client)) as game:
        for _ in range(2):
            assert game.reset(0) == scenario.start == client.cell(arena)
            assert standing_on(client, arena) == set()
            placed = set[Cell]()
            # Up to the far edge and the right one, which stop it; then the design.
            for action in (*[Action.R] * 3, *[Action.F] * 6, *[Action.B] * 5, *[Action.L] * 2, *build_of(scenario)):
                outcome = game.act(action)
                placed |= {outcome.placed} if outcome.placed else set()
                assert outcome.cell == client.cell(arena)
                assert standing_on(client, arena) == placed
            assert placed == far
    assert client.window.strays == []


def test_scenario_smaller_than_the_arena_is_played_in_its_near_left_corner(tmp_path: Path) -> None:
    client = VirtualClient()
    profile = build_in(client, profile_of(client, tmp_path), size=18)
    arena, line = profile.marked_arena(), load_scenario("line")
    with LiveGame(line, profile, connection_to(client)) as game:
        assert game.reset(line.best_material) == line.start == client.cell(arena)
        # The scenario's far edge stops the agent and voids its block, though the arena goes on.
        for action in (Action.F, Action.LD, Action.RD, *build_of(line)):
            assert game.act(action).cell == client.cell(arena)
    assert standing_on(client, arena) == line.design


def standing_on(client: VirtualClient, arena: Arena) -> set[Cell]:
    """Return the cells of the arena that hold a block."""
    return {
        (x, y)
        for x in range(arena.size)
        for y in range(arena.size)
        if client.realm.world.block_at(arena.block_of((x, y))) != "air"
    }


@pytest.mark.parametrize("has_sky", [True, False])
def test_arena_of_another_size_is_refused_only_while_the_earlier_one_can_be_undone(
    has_sky: bool, tmp_path: Path
) -> None:
    client, _ = spoiled()
    if not has_sky:
        client.realm.world.put((0, 128, 5), "glass")
        client.realm.world.put((0, 96, 5), "glass")
        client.realm.world.put((0, 80, 5), "glass")
    before, file = client.built, kept_profile(client, tmp_path)
    calibrate_built_arena(file, context_on(client))
    after = client.built
    if not has_sky:
        # Nothing could be copied, so nothing can be lost.
        calibrate_built_arena(file, context_on(client), size=20)
        assert load_profile(file).marked_arena().size == 20
        return
    with pytest.raises(UserError, match=rf"another size, 15 x 15 .*--undo --profile {re.escape(str(file))}"):
        calibrate_built_arena(file, context_on(client), size=20)
    assert client.built == after
    undo_built_arena(file, context_on(client))
    calibrate_built_arena(file, context_on(client), size=20)
    undo_built_arena(file, context_on(client))
    assert client.built == before


def test_building_again_at_the_same_position_keeps_the_first_copy(tmp_path: Path) -> None:
    client, before = spoiled()
    first = built(client, tmp_path).profile
    with context_on(client)(first) as context:
        again = build_arena(context, first, yes=True).profile
        assert again.arena == first.arena
        undo_arena(context, again)
    assert client.built == before


def test_a_copy_lies_below_blocks_in_the_sky(client: VirtualClient, tmp_path: Path) -> None:
    client.realm.world.put((0, 128, 5), "glass")
    found = built(client, tmp_path)
    assert found.profile.marked_arena().copied_to == (-8, 95, -1)
    assert client.realm.world.block_at((0, 128, 5)) == "glass"


def test_answering_no_changes_nothing(tmp_path: Path) -> None:
    client, before = spoiled()
    profile = profile_of(client, tmp_path)
    declining = context_on(client, ask=lambda _: False)
    with declining(profile) as context, pytest.raises(UserError, match="nothing was changed"):
        build_arena(context, profile)
    assert client.built == before
    assert client.realm.rules == {}


def far_away(client: VirtualClient) -> None:
    client.realm.view_distance = 0


def no_cheats(client: VirtualClient) -> None:
    client.realm.has_cheats = False


@pytest.mark.parametrize(
    ("prepare", "message"), [(far_away, "part of the ground isn't loaded"), (no_cheats, "allow cheats")]
)
def test_unloaded_ground_or_a_world_without_cheats_is_refused_before_anything_is_built(
    client: VirtualClient, prepare: Callable[[VirtualClient], None], message: str, tmp_path: Path
) -> None:
    prepare(client)
    with pytest.raises(UserError, match=message):
        built(client, tmp_path)
    assert client.built == {}


def test_undo_is_refused_if_the_copy_is_gone(client: VirtualClient, tmp_path: Path) -> None:
    found = built(client, tmp_path)
    low, high = box_of(HERE)
    client.realm.world.fill((low[0], 127, low[2]), (high[0], 130, high[2]), "air")
    with context_on(client)(found.profile) as context, pytest.raises(NotConfirmedError, match="no copy is at"):
        undo_arena(context, found.profile)
    assert client.realm.world.block_at((0, 63, 5)) == "bedrock"


def test_building_saves_the_arena_in_the_profile_and_undoing_removes_it(client: VirtualClient, tmp_path: Path) -> None:
    file = kept_profile(client, tmp_path)
    calibrate_built_arena(file, context_on(client))
    assert load_profile(file).marked_arena().copied_to == (-8, 127, -1)
    assert not note_path(file).exists(), "what the profile knows needs no note"
    undo_built_arena(file, context_on(client))
    assert load_profile(file).arena is None


def test_build_whose_profile_cannot_be_saved_is_undone_from_its_note(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client, before = spoiled()
    file = kept_profile(client, tmp_path)
    said: list[str] = []

    def refused(*_: object) -> None:
        raise ProfileError("the disk is full")

    monkeypatch.setattr(build, "save_profile", refused)
    with pytest.raises(ProfileError, match=f"full; .*--undo --profile {re.escape(str(file))}$"):
        calibrate_built_arena(file, context_on(client, said.append))
    assert any(f"mc-nested calibrate arena --undo --profile {file}" in line for line in said)
    assert load_profile(file).arena is None
    undo_built_arena(file, context_on(client))
    assert client.built == before
    assert not note_path(file).exists()


def test_copy_note_is_written_before_anything_is_built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    client, before = spoiled()
    file = kept_profile(client, tmp_path)

    def stopped(*_: object, **__: object) -> None:
        assert read_copy_note(file) is not None
        assert {block: name for block, name in client.built.items() if block[1] < 120} == before
        raise KeyboardInterrupt

    monkeypatch.setattr(build, "build_commands", stopped)
    with pytest.raises(KeyboardInterrupt):
        calibrate_built_arena(file, context_on(client))
    assert read_copy_note(file) is not None


def left_early(client: VirtualClient, folder: Path) -> tuple[Profile, Path]:
    """Build an arena that only its note knows; return a profile without it, and the profile's missing file."""
    file = folder / "new.toml"
    build_in(client, profile_of(client, folder), path=file)
    return profile_of(client, folder), file


def test_second_build_keeps_the_copy_of_an_unfinished_one_and_undo_needs_no_profile(tmp_path: Path) -> None:
    client, before = spoiled()
    profile, file = left_early(client, tmp_path)
    noted = note_path(file).read_bytes()
    again = build_in(client, profile, path=file)
    assert note_path(file).read_bytes() == noted
    assert again.marked_arena().copied_to == (-8, 127, -1)
    undo_built_arena(file, context_on(client))
    assert client.built == before
    assert [each.name for each in tmp_path.iterdir()] == ["ascii.png"]


def test_building_over_part_of_an_unfinished_arena_is_refused(client: VirtualClient, tmp_path: Path) -> None:
    profile, file = left_early(client, tmp_path)
    after = client.built
    with context_on(client)(profile) as context, pytest.raises(UserError, match="--undo --profile"):
        build_arena(context, profile, path=file, standing=(6, 0))
    assert client.built == after


def test_copy_note_from_another_world_is_ignored(tmp_path: Path) -> None:
    profile, file = left_early(VirtualClient(), tmp_path)
    client, before = spoiled()
    build_in(client, profile, path=file)
    undo_built_arena(file, context_on(client))
    assert client.built == before


def test_undoing_from_a_note_keeps_the_profiles_other_arena(tmp_path: Path) -> None:
    client = VirtualClient()
    profile, file = left_early(client, tmp_path)
    elsewhere = Arena.around((500, 70, 500), "east")
    save_profile(profile.model_copy(update={"arena": elsewhere}), file)
    undo_built_arena(file, context_on(client))
    assert client.built == {}
    assert load_profile(file).arena == elsewhere


def test_ground_with_a_hole_in_its_floor_is_copied_and_put_back(client: VirtualClient, tmp_path: Path) -> None:
    profile = profile_of(client, tmp_path)
    hole = Arena.around((3, 64, 0), "south").block_of((7, 0))
    client.realm.world.put((hole[0], 63, hole[2]), "air")
    before = client.built
    with context_on(client)(profile) as context:
        found = build_arena(context, profile, standing=(3, 0))
        assert found.profile.marked_arena().origin == (3, 64, 0)
        assert client.built != before
        undo_arena(context, found.profile)
    assert client.built == before


def test_findings_that_cannot_be_saved_are_a_warning_and_the_profile_is_written(
    client: VirtualClient, tmp_path: Path
) -> None:
    file = kept_profile(client, tmp_path)
    (tmp_path / "mine-calibration").write_text("no folder", "utf-8")
    said: list[str] = []
    calibrate_built_arena(file, context_on(client, said.append))
    assert load_profile(file).arena is not None
    assert "the profile is written" in said[-1]
    assert said[-1].startswith("warning: ")


def pressed_on(client: VirtualClient, patch: pytest.MonkeyPatch) -> list[str]:
    """Return the keys that are pressed from here on."""
    pressed: list[str] = []
    press = client.keyboard.press

    def noted(key: str) -> None:
        pressed.append(key)
        press(key)

    patch.setattr(client.keyboard, "press", noted)
    return pressed


def shared(client: VirtualClient, patch: pytest.MonkeyPatch) -> list[str]:
    """Make the client's world one that others may share; return the keys that are pressed from here on."""
    patch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (LAN)")
    return pressed_on(client, patch)


def test_build_in_a_shared_game_is_refused_before_any_key_is_pressed(
    client: VirtualClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pressed = shared(client, monkeypatch)
    with pytest.raises(DesktopError, match=r"others may be playing there.*--server-allowed"):
        built(client, tmp_path)
    assert pressed == []
    assert client.built == {}


def test_undo_in_a_shared_game_is_refused_unless_a_server_is_allowed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient()
    profile = built(client, tmp_path).profile
    after, pressed = client.built, shared(client, monkeypatch)
    with context_on(client)(profile) as context:
        with pytest.raises(DesktopError, match="--server-allowed"):
            undo_arena(context, profile)
        assert (client.built, pressed) == (after, [])
    with context_on(client, is_server_allowed=True)(profile) as context:
        undo_arena(context, profile)
    assert client.built == {}


@pytest.mark.parametrize("after_s", [0.3, 2.0, 5.0, 7.0])
@pytest.mark.parametrize("error", [KeyboardInterrupt(), DesktopError("the game's window has closed: open it again")])
def test_ctrl_c_or_a_closed_window_at_any_time_leaves_keys_up_and_the_profile_as_it_was(
    client: VirtualClient, error: BaseException, after_s: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = kept_profile(client, tmp_path)
    before = file.read_bytes()
    monkeypatch.setattr(client.display, "is_in_front", Cut(client, after_s, error).is_in_front)
    with pytest.raises(type(error)):
        calibrate_built_arena(file, context_on(client))
    assert file.read_bytes() == before
    assert client.window.down == set()


@pytest.mark.parametrize("after_s", [1.5, 4.0, 7.0])
@pytest.mark.parametrize("kind", ["lost_focus", "pause", "death"])
def test_lost_focus_pause_or_death_is_a_one_line_error_and_leaves_the_profile_unchanged(
    kind: Kind, after_s: float, tmp_path: Path
) -> None:
    client = disturbed(kind, after_s, tmp_path)
    before = (tmp_path / "mine.toml").read_bytes()
    with pytest.raises(McNestedError) as caught:
        calibrate_built_arena(tmp_path / "mine.toml", context_on(client))
    assert "\n" not in str(caught.value)
    assert (tmp_path / "mine.toml").read_bytes() == before
    assert client.window.down == set()
    assert client.window.strays == []


@pytest.mark.parametrize("after_s", [1.5, 4.0, 7.0])
def test_chat_opened_during_the_build_is_closed_or_ends_it_with_a_one_line_error(
    after_s: float, tmp_path: Path
) -> None:
    client, file = disturbed("chat", after_s, tmp_path), tmp_path / "mine.toml"
    before = file.read_bytes()
    try:
        calibrate_built_arena(file, context_on(client))
    except McNestedError as error:
        assert "\n" not in str(error)  # noqa: PT017 - either is right, as the moment has it
        assert file.read_bytes() == before
    else:
        other, alike = tmp_path / "other", VirtualClient()
        other.mkdir()
        kept_profile(alike, other)
        calibrate_built_arena(other / "mine.toml", context_on(alike))
        assert client.built == alike.built
        assert load_profile(str(file)).arena == load_profile(str(other / "mine.toml")).arena
    assert client.mishaps.happened
    assert client.window.down == set()
    assert client.window.strays == []


def disturbed(kind: Kind, after_s: float, folder: Path) -> VirtualClient:
    """Return a client with a profile in ``folder``, where a mishap of this kind happens about so many seconds later."""
    client = VirtualClient()
    kept_profile(client, folder)
    for try_s in range(10):
        # Nothing of the world happens while the chat is open.
        client.mishaps.plan(kind, after_s + 0.07 * try_s)
    return client


def test_profile_with_a_world_template_is_refused_with_the_mark_only_command(tmp_path: Path) -> None:
    client = VirtualClient()
    world = WorldTable(folder=str(tmp_path / "arena"), template=str(tmp_path / "template"), name="arena")
    profile = profile_of(client, tmp_path).model_copy(update={"world": world})
    with (
        context_on(client)(profile) as context,
        pytest.raises(UserError, match=r"mark the arena only, with mc-nested calibrate arena --mark-only$"),
    ):
        build_arena(context, profile)


@pytest.mark.parametrize(
    ("pitch", "says"),
    [
        (0.0, r"^no block is looked at, so .*: look down at the ground, and run this again$"),
        (30.0, r"^the debug screen names no block, .*: press F3\+F6 in the game, and set looking_at_block_state "),
    ],
)
def test_build_is_refused_before_any_key_press_if_the_debug_screen_names_no_block(
    pitch: float, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(version="26.3", pitch=pitch, debug_entries=GAME_DEFAULT)
    pressed = pressed_on(client, monkeypatch)
    with pytest.raises(UserError, match=says):
        built(client, tmp_path)
    assert pressed == []


COPIED = HERE.model_copy(update={"copied_to": (-8, 127, -1)})
FREE = GroundSurvey(True, True, "grass_block", (-8, 127, -1))


def test_question_about_free_ground_describes_floor_border_and_copy() -> None:
    assert build_question(HERE, FREE, None, ("stone", "planks")) == (
        "Build the arena from (-7, 64, 0) to (7, 65, 14), facing south? There is only air. "
        "The floor, grass_block, is flat: it stays. "
        "Every reset will remove all blocks of these two layers; around them comes a border of lapis_block. "
        "Time, weather and mobs stand still, the game mode is creative, and the first 2 slots of the hotbar are "
        "overwritten. What stands there is copied to (-8, 127, -1) first, and --undo puts it back."
    )


def test_question_names_at_most_six_blocks_in_the_way() -> None:
    in_the_way = {(x, 64, 3): "dirt" for x in range(8)}
    ground = GroundSurvey(False, False, "ice", (-8, 127, -1), LookAroundResult(in_the_way, 4, 15))
    asked = build_question(HERE, ground, None, ())
    assert asked.count("dirt at") == 6
    assert "Something stands there (dirt at (0, 64, 3), " in asked
    assert "dirt at (5, 64, 3), 4 of 15 looks saw the floor)." in asked
    assert "The floor, ice, is not of one block: it is replaced by obsidian." in asked


def test_question_counts_the_cells_out_of_sight() -> None:
    ground = GroundSurvey(None, None, "stone", None, LookAroundResult({}, 9, 10, 5))
    asked = build_question(Arena.around((7, 64, 0), "south", size=32), ground, None, ())
    assert "What stands there is not known (9 of 10 looks saw the floor, 5 more cells are out of sight)." in asked


def test_question_says_so_if_the_ground_is_unknown() -> None:
    asked = build_question(HERE, GroundSurvey(None, None, "sand", None), None, ())
    assert "What stands there is not known." in asked
    assert "may have holes" in asked
    assert "this can't be undone" in asked


@pytest.mark.parametrize(
    ("arena", "old", "is_forgotten", "is_final"),
    [
        (HERE, COPIED, True, True),
        (COPIED, COPIED, False, False),
        (HERE, HERE, False, True),
        (HERE, None, False, True),
    ],
)
def test_question_says_if_an_earlier_copy_is_forgotten_or_the_build_cannot_be_undone(
    arena: Arena, old: Arena | None, is_forgotten: bool, is_final: bool
) -> None:
    asked = build_question(arena, GroundSurvey(True, True, "stone", None), old, ())
    assert ("will be forgotten" in asked) == is_forgotten
    assert ("can't be undone" in asked) == is_final


def test_undo_hint_is_the_clone_command_that_puts_the_ground_back() -> None:
    assert undo_hint(HERE) == "No copy was kept"
    assert undo_hint(COPIED) == "What stood there comes back with /clone -8 127 -1 8 129 15 -8 63 -1"


def test_build_summary_says_whether_the_floor_stayed_and_where_the_copy_is() -> None:
    first, second = build_summary(COPIED, FREE, "mc-nested undo")
    assert first == (
        "Arena from (-7, 64, 0) to (7, 65, 14), facing south; the floor of grass_block stayed, "
        "the border was seen on all four sides."
    )
    assert second == "What stood there is copied to (-8, 127, -1): mc-nested undo puts it back."
    built = build_summary(HERE, GroundSurvey(True, False, "grass_block", None), "undo")
    assert "the floor is obsidian" in built[0]
    assert built[1].startswith("No copy was kept")
