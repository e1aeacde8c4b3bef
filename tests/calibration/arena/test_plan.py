"""The plan of an arena: its border, its floor, the place of its copy, and the commands that build it."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.arena.plan import (
    box_at,
    build_commands,
    copy_command,
    copy_positions,
    do_overlap,
    gamerules,
    is_good_floor,
    volume,
)
from mc_nested.live.model.coordinates import Facing
from mc_nested.live.profile.arena import BORDERS, FILL_LIMIT, FLOOR, Arena, border_block, border_of, box_of, floor_of
from mc_nested.live.profile.tables import GameVersion, Profile

FACINGS: list[Facing] = ["north", "south", "west", "east"]
ORIGINS = st.tuples(st.integers(-999, 999), st.integers(-60, 200), st.integers(-999, 999))
ARENA = Arena.around((10, 64, 20), "south")


@given(ORIGINS, st.sampled_from(FACINGS), st.integers(15, 32))
def test_the_border_is_the_ring_around_the_cells_and_nothing_else(
    origin: tuple[int, int, int], facing: Facing, size: int
) -> None:
    arena = Arena.around(origin, facing, size=size)
    ring = {
        (x, origin[1], z)
        for (low, high) in border_of(arena)
        for x, z in itertools.product(range(low[0], high[0] + 1), range(low[2], high[2] + 1))
    }
    around = {arena.block_of((x, y)) for x in range(-1, size + 1) for y in range(-1, size + 1)}
    cells = {arena.block_of((x, y)) for x in range(size) for y in range(size)}
    assert ring == around - cells
    assert all(low[1] == high[1] == origin[1] for low, high in border_of(arena))


@given(ORIGINS, st.sampled_from(FACINGS), st.sampled_from(["1.12.2", "1.17.1", "1.18", "26.1"]))
def test_copy_positions_are_above_the_arena_in_the_same_columns_and_inside_the_world(
    origin: tuple[int, int, int], facing: Facing, version: str
) -> None:
    box = box_of(Arena.around(origin, facing))
    assert volume(box) == 17 * 17 * 3
    for place in copy_positions(Arena.around(origin, facing), version):
        low, high = box_at(box, place)
        assert (low[0], low[2], high[0], high[2]) == (box[0][0], box[0][2], box[1][0], box[1][2])
        assert low[1] > box[1][1] + 4
        assert high[1] <= (319 if version in ("1.18", "26.1") else 255)


@pytest.mark.parametrize(
    ("floor", "version", "heights"),
    [
        (249, "1.18", [64, 32, 16]),
        (250, "1.18", [32, 16]),
        (281, "26.1", [32, 16]),
        (282, "26.1", [16]),
        (297, "1.18", [16]),
        (298, "1.18", []),
        (185, "1.17.1", [64, 32, 16]),
        (186, "1.17.1", [32, 16]),
    ],
)
def test_a_copy_and_the_air_above_it_fit_below_the_top_of_the_world(
    floor: int, version: str, heights: list[int]
) -> None:
    # The box is 3 tall, and the box above the copy is compared with it: floor + height + 6 is at most the top.
    arena = Arena.around((10, floor + 1, 20), "south")
    assert copy_positions(arena, version) == [(-5, floor + height, 19) for height in heights]


@pytest.mark.parametrize(
    ("corner", "is_shared"),
    [((2, 0, 0), True), ((3, 0, 0), False), ((-2, 0, 0), True), ((-3, 0, 0), False), ((0, 3, 0), False)],
)
def test_two_boxes_overlap_if_they_share_a_block(corner: tuple[int, int, int], is_shared: bool) -> None:
    box = ((0, 0, 0), (2, 2, 2))
    assert do_overlap(box, box_at(box, corner)) is is_shared
    assert do_overlap(box_at(box, corner), box) is is_shared


def test_build_commands_set_floor_border_gamerules_and_hotbar() -> None:
    profile = Profile(game=GameVersion(version="1.20.1"))
    assert build_commands(profile, ARENA, ("oak_planks", "stone"), builds_floor=True) == [
        "/fill -5 63 19 11 63 35 minecraft:obsidian",
        "/fill -4 64 20 10 65 34 minecraft:air",
        "/fill -5 64 19 11 64 19 minecraft:lapis_block",
        "/fill -5 64 19 -5 64 35 minecraft:lapis_block",
        "/fill -5 64 35 11 64 35 minecraft:lapis_block",
        "/fill 11 64 19 11 64 35 minecraft:lapis_block",
        "/gamemode creative",
        "/difficulty peaceful",
        "/time set 6000",
        "/weather clear",
        "/gamerule doDaylightCycle false",
        "/gamerule doWeatherCycle false",
        "/gamerule doMobSpawning false",
        "/item replace entity @s hotbar.0 with minecraft:oak_planks 64",
        "/item replace entity @s hotbar.1 with minecraft:stone 64",
    ]


def test_no_command_for_the_largest_arena_changes_more_blocks_than_the_game_allows() -> None:
    arena = Arena.around((10, 64, 20), "south", size=32)
    boxes = [box_of(arena), floor_of(arena), arena.region, *border_of(arena)]
    assert [volume(box) for box in boxes] == [34 * 34 * 3, 34 * 34, 32 * 32 * 2, *[34] * 4]
    assert max(volume(box) for box in boxes) <= FILL_LIMIT
    far = Arena.around((-29_999_960, 300, 29_999_900), "west", size=32)
    commands = [*build_commands(Profile(), far, ("stone",), builds_floor=True), copy_command(box_of(far), (0, 0, 0))]
    assert max(map(len, commands)) < 256, "what the chat takes"


def test_build_commands_without_a_new_floor_place_no_obsidian() -> None:
    commands = build_commands(Profile(), ARENA, ("stone",), builds_floor=False)
    assert not any("obsidian" in command for command in commands)
    assert volume(floor_of(ARENA)) == 17 * 17
    assert volume(floor_of(ARENA)) < FILL_LIMIT


@pytest.mark.parametrize(
    ("version", "rules"),
    [
        ("1.12.2", ("doDaylightCycle", "doWeatherCycle", "doMobSpawning")),
        ("1.21.10", ("doDaylightCycle", "doWeatherCycle", "doMobSpawning")),
        ("1.21.11", ("advance_time", "advance_weather", "spawn_mobs")),
        ("26.3", ("advance_time", "advance_weather", "spawn_mobs")),
    ],
)
def test_gamerules_are_named_as_in_each_version(version: str, rules: tuple[str, ...]) -> None:
    assert gamerules(version) == rules


def test_commands_for_1_12_use_its_block_names_and_syntax() -> None:
    profile = Profile(game=GameVersion(version="1.12.2"))
    commands = build_commands(profile, ARENA, ("oak_planks",), builds_floor=True)
    assert commands[-1] == "/replaceitem entity @s slot.hotbar.0 minecraft:planks 64 0"


def test_border_block_differs_from_every_material() -> None:
    assert border_block(("stone", "oak_planks")) == "lapis_block"
    assert border_block(("lapis_block", "stone")) == "mossy_cobblestone"
    assert FLOOR not in BORDERS


@pytest.mark.parametrize(
    ("block", "fit"), [("stone", True), ("grass_block", True), ("packed_ice", False), ("soul_sand", False)]
)
def test_slippery_or_slow_block_is_unfit_as_a_floor(block: str, fit: bool) -> None:
    assert is_good_floor(block) is fit
