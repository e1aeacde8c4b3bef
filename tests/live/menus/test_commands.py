"""The chat commands of a reset, by version."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import ProfileError
from mc_nested.live.menus.commands import reset_commands
from mc_nested.live.model.coordinates import Facing
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import GameVersion, Profile

ITEMS = {
    "1.12.2": [
        "/replaceitem entity @s slot.hotbar.0 minecraft:planks 64 0",
        "/replaceitem entity @s slot.hotbar.1 minecraft:stone 64 0",
    ],
    "1.16.5": [
        "/replaceitem entity @s hotbar.0 minecraft:oak_planks 64",
        "/replaceitem entity @s hotbar.1 minecraft:stone 64",
    ],
    "1.21.11": [
        "/item replace entity @s hotbar.0 with minecraft:oak_planks 64",
        "/item replace entity @s hotbar.1 with minecraft:stone 64",
    ],
}


def _profile(version: str = "1.20.1", facing: Facing = "south") -> Profile:
    return Profile(game=GameVersion(version=version), arena=Arena.around((5, 64, -20), facing))


@pytest.mark.parametrize("version", ITEMS)
def test_items_come_in_the_syntax_of_the_version(version: str) -> None:
    assert reset_commands(_profile(version), (7, 14), ["oak_planks", "stone"])[2:] == ITEMS[version]


def test_a_reset_clears_teleports_and_gives_in_this_order() -> None:
    lines = reset_commands(_profile(), (7, 14), ["stone"])
    assert lines[:2] == ["/fill -9 64 -20 5 65 -6 minecraft:air", "/tp @s -1.5 64 -5.5 0 65"]
    assert len(lines) == 3


@pytest.mark.parametrize(
    ("version", "command"),
    [
        ("1.12.2", "/fill -9 63 -20 5 63 -6 minecraft:stone 0 keep"),
        ("1.13", "/fill -9 63 -20 5 63 -6 minecraft:stone keep"),
    ],
)
def test_holes_in_a_floor_that_is_known_are_filled_and_nothing_else(version: str, command: str) -> None:
    profile = _profile(version)
    arena = profile.marked_arena().model_copy(update={"floor": "stone"})
    commands = reset_commands(profile.model_copy(update={"arena": arena}), (7, 14), [])
    assert commands[0].endswith("minecraft:air")
    assert commands[1] == command
    assert commands[2].startswith("/tp")


@pytest.mark.parametrize(
    ("floor", "filled"), [("minecraft:stone_bricks", "minecraft:stone_bricks"), ("create:andesite", "create:andesite")]
)
def test_a_floor_that_names_its_namespace_keeps_it(floor: str, filled: str) -> None:
    profile = _profile("1.20")
    arena = profile.marked_arena().model_copy(update={"floor": floor})
    commands = reset_commands(profile.model_copy(update={"arena": arena}), (7, 14), [])
    assert commands[1].endswith(f" {filled} keep")


@pytest.mark.parametrize(("facing", "yaw"), [("north", "180"), ("south", "0"), ("west", "90"), ("east", "-90")])
def test_the_teleport_looks_the_arenas_way(facing: Facing, yaw: str) -> None:
    assert reset_commands(_profile(facing=facing), (0, 0), [])[1] == f"/tp @s 5.5 64 -19.5 {yaw} 65"


sizes = st.integers(15, 32)


@given(st.sampled_from(["north", "south", "west", "east"]), st.integers(-5000, 5000), st.integers(-5000, 5000), sizes)
def test_the_fill_takes_the_arenas_cells_two_high_and_no_block_more(facing: Facing, x: int, z: int, size: int) -> None:
    arena = Arena.around((x, 64, z), facing, size=size)
    words = reset_commands(Profile(arena=arena), (7, 14), [])[0].split()
    low, high = [int(word) for word in words[1:4]], [int(word) for word in words[4:7]]
    filled = {(east, south) for east in range(low[0], high[0] + 1) for south in range(low[2], high[2] + 1)}
    assert filled == {arena.block_of((column, row))[::2] for column in range(size) for row in range(size)}
    assert (low[1], high[1]) == (64, 65)


def test_no_line_is_longer_than_the_chat_takes() -> None:
    far = Profile(arena=Arena.around((-29_999_999, 300, 29_999_900), "west"))
    assert max(map(len, reset_commands(far, (7, 14), ["waxed_weathered_cut_copper_stairs"]))) < 100


def test_without_an_arena_nothing_is_typed() -> None:
    with pytest.raises(ProfileError, match="run mc-nested calibrate arena"):
        reset_commands(Profile(), (7, 14), ["stone"])
