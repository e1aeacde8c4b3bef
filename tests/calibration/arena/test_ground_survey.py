"""The survey of the ground: whether it is free and flat, and where in the sky its copy can lie.

Questions about blocks: the command of each, and what each answer means.

Looking around an arena: where the view is turned, and what is taken for the floor or for something in the way.
"""

import math
import re

import pytest

from calibration.arena.ground_survey import (
    BlockQueries,
    GroundSurvey,
    cells_to_look_at,
    is_copy_gone,
    is_in_sight,
    look_around,
    look_at,
    survey_ground,
    teleport_and_look,
)
from calibration.arena.plan import box_at
from mc_nested.errors import UserError
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.profile.arena import Arena, box_of
from mc_nested.live.profile.tables import GameVersion, InputTable, Profile
from mc_nested.live.vision.game_screen import GameScreen
from sim.client.client import VirtualClient
from tests.calibration.arena.scripted import ScriptedConsole, ScriptedQueries, looks
from tests.sim.client.playing import connection_to

ARENA = Arena.around((7, 64, 0), "south")
FIRST, SECOND = (-8, 127, -1), (-8, 95, -1)
"""The lowest corners of the copies 64 and 32 blocks above the floor, which is at 63."""


def sees(target: Target | None, off: tuple[float, float] = (0.0, 0.0)) -> ScriptedConsole:
    def respond(command: str) -> Reading:
        yaw, pitch = (float(part) for part in command.split()[-2:])
        return Reading(xyz=(0.5, 64.0, 0.5), yaw=yaw + off[0], pitch=pitch + off[1], target=target)

    return ScriptedConsole(respond)


def survey(queries: ScriptedQueries, version: str = "1.20.1", target: str = "minecraft:grass_block") -> GroundSurvey:
    profile = Profile(game=GameVersion(version=version))
    return survey_ground(sees(Target((0, 63, 1), target)), queries, profile, ARENA, ARENA.near_middle)


def test_survey_of_free_flat_ground_picks_the_highest_copy_position_without_looking_around() -> None:
    queries = ScriptedQueries()
    ground = survey(queries)
    assert ground == GroundSurvey(True, True, "grass_block", FIRST, None)
    assert ground.keeps_floor
    # The air above the copy's floor, its border left out, is what the region is compared with.
    assert queries.compared[-1] == (ARENA.region, (-7, 128, 0))


@pytest.mark.parametrize(
    ("air", "alike"),
    [({FIRST: False}, {}), ({FIRST: None}, {}), ({}, {(-8, 130, -1): False}), ({}, {(-8, 130, -1): None})],
)
def test_survey_takes_the_second_copy_position_if_the_first_is_not_known_to_be_air(
    air: dict[tuple[int, int, int], bool | None], alike: dict[tuple[int, int, int], bool | None]
) -> None:
    assert survey(ScriptedQueries(air, alike)).copy_to == SECOND


def test_survey_without_room_in_the_sky_finds_no_copy_position_and_leaves_is_free_unknown() -> None:
    below = ARENA.block_of(ARENA.near_middle)
    ground = survey(ScriptedQueries({below: True}, otherwise=False))
    assert (ground.is_free, ground.is_flat, ground.copy_to) == (None, True, None)
    assert ground.view is not None


def test_survey_leaves_everything_unknown_if_the_game_answers_no_query() -> None:
    ground = survey(ScriptedQueries(otherwise=None, uniform=None))
    assert (ground.is_free, ground.is_flat, ground.copy_to) == (None, None, None)
    assert not ground.keeps_floor


def test_unloaded_ground_is_an_error_except_in_1_12() -> None:
    with pytest.raises(UserError, match="isn't loaded"):
        survey(ScriptedQueries(uniform=None))
    assert survey(ScriptedQueries(uniform=None), "1.12.2").is_flat is None


@pytest.mark.parametrize(("uniform", "is_free"), [(False, True), (True, False)])
def test_survey_looks_around_on_uneven_or_occupied_ground(uniform: bool, is_free: bool) -> None:
    queries = ScriptedQueries(alike={(-7, 128, 0): is_free}, uniform=uniform)
    ground = survey(queries)
    assert (ground.is_flat, ground.is_free) == (uniform, is_free)
    assert ground.view is not None
    assert ground.view.looks == 15


def test_slippery_floor_is_not_kept() -> None:
    assert not survey(ScriptedQueries(), target="minecraft:blue_ice").keeps_floor


@pytest.mark.parametrize("target", [None, Target((0, 63, 1), None)])
@pytest.mark.parametrize(
    ("version", "remedy"),
    [
        ("1.20.1", "stand on solid ground"),
        ("1.21.10", "set looking_at_block to In F3$"),
        ("26.3", "set looking_at_block_state to In Overlay$"),
    ],
)
def test_survey_ends_after_one_look_if_the_debug_screen_names_no_block(
    target: Target | None, version: str, remedy: str
) -> None:
    screen, profile = sees(target), Profile(game=GameVersion(version=version))
    with pytest.raises(UserError, match=f"names no block, though the ground is looked at: .*{remedy}"):
        survey_ground(screen, ScriptedQueries(), profile, ARENA, ARENA.near_middle)
    assert len(looks(screen.sent)) == 1


def test_teleport_without_an_effect_is_an_error_that_asks_for_cheats() -> None:
    screen = ScriptedConsole(lambda _: Reading(xyz=(0.5, 64.0, 0.5), yaw=0.0, pitch=0.0))
    with pytest.raises(UserError, match="a teleport had no effect: allow cheats"):
        survey_ground(screen, ScriptedQueries(), Profile(), ARENA, ARENA.near_middle)


def test_copy_counts_as_gone_if_its_box_equals_the_air_above() -> None:
    with_copy = ARENA.model_copy(update={"copied_to": FIRST})
    assert is_copy_gone(ScriptedQueries(otherwise=None), ARENA), "none was ever made"
    queries = ScriptedQueries()
    assert is_copy_gone(queries, with_copy)
    assert queries.compared == [(box_at(box_of(ARENA), FIRST), (-8, 130, -1))]
    assert not is_copy_gone(ScriptedQueries(otherwise=False), with_copy)
    assert not is_copy_gone(ScriptedQueries(otherwise=None), with_copy)
    assert not is_copy_gone(ScriptedQueries(alike={(-8, 130, -1): False}), with_copy), "a hole in the copied floor"
    # Under the player's cell (7, 0), which is at x = 0, z = 0, one block of the copy's floor.
    assert not is_copy_gone(ScriptedQueries({(0, 127, 0): False}), with_copy)


BOX = ((0, 64, 0), (2, 65, 4))


def turns(command: str) -> Reading:
    """Return the view that the command's last two numbers ask for."""
    yaw, pitch = command.split()[-2:]
    return Reading(xyz=(0.5, 64.0, 0.5), yaw=float(yaw), pitch=float(pitch))


def queries(console: ScriptedConsole, version: str = "1.20.1", *, reads_chat: bool = True) -> BlockQueries:
    profile = Profile(game=GameVersion(version=version), input=InputTable(reads_chat=reads_chat))
    return BlockQueries(console, profile, screen(), 90.0)


def screen() -> GameScreen:
    return connection_to(VirtualClient()).screen


def test_query_answers_yes_if_the_conditional_teleport_turns_the_view() -> None:
    console = ScriptedConsole(turns)
    assert queries(console).is_air((1, -2, 3)) is True
    assert console.sent == ["/execute if block 1 -2 3 minecraft:air run tp @s ~ ~ ~ 90 20"]


def test_query_answers_no_if_the_opposite_teleport_turns_the_view() -> None:
    console = ScriptedConsole(lambda command: turns(command) if " unless " in command else None)
    assert queries(console).are_alike(BOX, (10, 64, 10)) is False
    assert console.sent == [
        "/execute if blocks 0 64 0 2 65 4 10 64 10 all run tp @s ~ ~ ~ 90 20",
        "/execute unless blocks 0 64 0 2 65 4 10 64 10 all run tp @s ~ ~ ~ 90 21",
    ]


def test_query_answer_is_unknown_if_neither_teleport_has_an_effect() -> None:
    console = ScriptedConsole()
    assert queries(console).is_air((0, 0, 0)) is None
    assert len(console.sent) == 2


@pytest.mark.parametrize(("off", "answer"), [(0.1, True), (-0.1, True), (0.5, None), (-0.5, None)])
def test_query_accepts_a_view_a_tenth_of_a_degree_off_the_command(off: float, answer: bool | None) -> None:
    def turned(command: str) -> Reading:
        return Reading(xyz=(0.5, 64.0, 0.5), yaw=90.0, pitch=float(command.split()[-1]) + off)

    assert queries(ScriptedConsole(turned)).is_air((0, 0, 0)) is answer


def test_queries_reuse_a_pitch_only_after_forty_questions() -> None:
    console = ScriptedConsole(turns)
    asking = queries(console)
    for _ in range(42):
        asking.is_air((0, 0, 0))
    pitches = [int(command.split()[-1]) for command in console.sent]
    assert pitches[:41] == [*range(20, 60), 20]
    assert pitches[41] == 21


def test_in_1_12_a_query_for_air_answers_yes_or_unknown() -> None:
    console = ScriptedConsole(turns)
    assert queries(console, "1.12.2").is_air((1, 2, 3)) is True
    assert console.sent == ["/execute @s ~ ~ ~ detect 1 2 3 minecraft:air 0 tp @s ~ ~ ~ 90 20"]
    assert queries(ScriptedConsole(), "1.12.2").is_air((1, 2, 3)) is None


def test_in_1_12_boxes_cannot_be_compared_without_reading_the_chat() -> None:
    console = ScriptedConsole()
    assert queries(console, "1.12.2", reads_chat=False).are_alike(BOX, (10, 64, 10)) is None
    assert console.sent == []


def test_in_1_12_the_chat_is_cleared_before_boxes_are_compared() -> None:
    console = ScriptedConsole()
    assert queries(console, "1.12.2").are_alike(BOX, (10, 64, 10)) is None, "its screen shows no answer"
    assert console.sent == ["clear", "/testforblocks 0 64 0 2 65 4 10 64 10"]


def test_floor_is_uniform_if_it_equals_itself_shifted_by_one_block_both_ways() -> None:
    console = ScriptedConsole(turns)
    assert queries(console).is_uniform(((0, 63, 0), (16, 63, 16))) is True
    regions = [re.search(r"blocks (.*) all", command) for command in console.sent]
    assert [match and match[1] for match in regions] == ["0 63 0 15 63 16 1 63 0", "0 63 0 0 63 15 0 63 1"]


def test_floor_that_differs_along_one_direction_is_not_uniform() -> None:
    def along_only(command: str) -> Reading | None:
        holds = "0 63 0 15 63 16" in command
        return turns(command) if holds == (" if " in command) else None

    assert queries(ScriptedConsole(along_only)).is_uniform(((0, 63, 0), (16, 63, 16))) is False


def test_look_at_turns_the_view_from_the_eyes_to_the_point() -> None:
    console = sees(None)
    # 3 blocks east, 4 south, at the height of the feet: 5 blocks away, the eyes 1.62 above.
    look_at(console, (3.5, 64.0, 4.5))
    yaw, pitch = -math.degrees(math.atan2(3, 4)), math.degrees(math.atan2(1.62, 5))
    assert console.sent == [f"/tp @s ~ ~ ~ {yaw:.1f} {pitch:.1f}"] == ["/tp @s ~ ~ ~ -36.9 18.0"]


def test_look_at_turns_the_view_up_to_a_higher_point() -> None:
    console = sees(None)
    look_at(console, (0.5, 64.0 + 1.62 + 4, -3.5))
    assert console.sent in (["/tp @s ~ ~ ~ -180.0 -45.0"], ["/tp @s ~ ~ ~ 180.0 -45.0"])


@pytest.mark.parametrize(
    ("off", "is_seen"),
    [((0.1, 0.1), True), ((0.5, 0.0), False), ((-0.5, 0.0), False), ((0.0, 0.5), False), ((0.0, -0.5), False)],
)
def test_looked_at_block_counts_only_if_the_view_is_as_commanded(off: tuple[float, float], is_seen: bool) -> None:
    stone = Target((1, 2, 3), "minecraft:stone")
    seen = teleport_and_look(sees(stone, off), "1 2 3 90 45", 90.0, 45.0)
    assert seen == (stone if is_seen else None)


def test_looked_at_block_counts_up_to_two_tenths_of_a_degree_off() -> None:
    stone = Target((1, 2, 3), "minecraft:stone")
    assert teleport_and_look(sees(stone, (0.2, 0.2)), "1 2 3 0 0", 0.0, 0.0) == stone
    assert teleport_and_look(sees(stone, (0.3, 0.0)), "1 2 3 0 0", 0.0, 0.0) is None
    assert teleport_and_look(sees(stone, (0.0, 0.3)), "1 2 3 0 0", 0.0, 0.0) is None


def test_looked_at_block_does_not_count_if_the_view_cannot_be_read() -> None:
    blind = Reading(xyz=(0.5, 64.0, 0.5))
    assert teleport_and_look(ScriptedConsole(lambda _: blind), "~ ~ ~ 0 0", 0.0, 0.0) is None


def test_look_around_counts_the_looks_that_see_their_own_cells_floor() -> None:
    floors = iter([ARENA.block_of(cell) for cell in cells_to_look_at(15)])

    def respond(command: str) -> Reading:
        yaw, pitch = (float(part) for part in command.split()[-2:])
        x, y, z = next(floors)
        return Reading(xyz=(0.5, 64.0, 0.5), yaw=yaw, pitch=pitch, target=Target((x, y - 1, z), "minecraft:stone"))

    seen = look_around(ScriptedConsole(respond), ARENA, (7, 0))
    assert (seen.in_the_way, seen.floor, seen.looks) == ({}, 15, 15)


@pytest.mark.parametrize(
    ("target", "in_the_way"),
    [
        (Target((3, 64, 5), "minecraft:dirt"), {(3, 64, 5): "minecraft:dirt"}),
        (Target((3, 65, 5), None), {(3, 65, 5): "a block"}),
        (Target((3, 63, 500), "minecraft:dirt"), {}),
        (Target(None, "minecraft:dirt"), {}),
        (None, {}),
    ],
)
def test_only_blocks_at_or_above_foot_level_count_as_in_the_way(
    target: Target | None, in_the_way: dict[tuple[int, int, int], str]
) -> None:
    seen = look_around(sees(target), ARENA, (7, 0))
    assert (seen.in_the_way, seen.floor, seen.looks) == (in_the_way, 0, 15)


def test_all_cells_to_look_at_in_a_15_cell_arena_are_in_sight_from_its_corners() -> None:
    assert cells_to_look_at(15) == [(x, y) for y in (3, 8, 13) for x in (1, 4, 7, 10, 13)]
    corners = [(0, 0), (14, 0), (0, 14), (14, 14)]
    assert all(is_in_sight(cell, corner) for cell in cells_to_look_at(15) for corner in corners)


@pytest.mark.parametrize(("cell", "is_seen"), [((16, 19), True), ((16, 20), False), ((0, 11), True), ((0, 12), False)])
def test_floor_is_in_sight_up_to_twenty_blocks_from_the_eyes(cell: tuple[int, int], is_seen: bool) -> None:
    # From (16, 0), eyes 1.62 up: 19.07 and 20.07, 19.48 and 20.06 blocks away.
    assert is_in_sight(cell, (16, 0)) is is_seen


@pytest.mark.parametrize(("size", "looks"), [(20, 15), (32, 8)])
def test_cells_out_of_sight_are_counted_and_not_looked_at(size: int, looks: int) -> None:
    arena = Arena.around((7, 64, 0), "south", size=size)
    console = sees(None)
    seen = look_around(console, arena, arena.near_middle)
    assert len(cells_to_look_at(size)) == 15
    assert (seen.looks, seen.out_of_sight, len(console.sent)) == (looks, 15 - looks, looks)
