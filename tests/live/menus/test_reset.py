"""The chat commands of a reset, by version.

Restoring a world's folder: only a marked one, whole or not at all, and the last one is kept.
"""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import ProfileError, RunError
from mc_nested.live.menus.reset import KEPT, MARKER, reset_commands, restore_world
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
def test_a_reset_fills_holes_in_a_known_floor_and_replaces_no_block(version: str, command: str) -> None:
    profile = _profile(version)
    arena = profile.marked_arena().model_copy(update={"floor": "stone"})
    commands = reset_commands(profile.model_copy(update={"arena": arena}), (7, 14), [])
    assert commands[0].endswith("minecraft:air")
    assert commands[1] == command
    assert commands[2].startswith("/tp")


@pytest.mark.parametrize(
    ("floor", "filled"), [("minecraft:stone_bricks", "minecraft:stone_bricks"), ("create:andesite", "create:andesite")]
)
def test_a_floors_namespace_is_kept_in_the_command(floor: str, filled: str) -> None:
    profile = _profile("1.20")
    arena = profile.marked_arena().model_copy(update={"floor": floor})
    commands = reset_commands(profile.model_copy(update={"arena": arena}), (7, 14), [])
    assert commands[1].endswith(f" {filled} keep")


@pytest.mark.parametrize(("facing", "yaw"), [("north", "180"), ("south", "0"), ("west", "90"), ("east", "-90")])
def test_the_teleport_turns_the_player_to_the_arenas_facing(facing: Facing, yaw: str) -> None:
    assert reset_commands(_profile(facing=facing), (0, 0), [])[1] == f"/tp @s 5.5 64 -19.5 {yaw} 65"


sizes = st.integers(15, 32)


@given(st.sampled_from(["north", "south", "west", "east"]), st.integers(-5000, 5000), st.integers(-5000, 5000), sizes)
def test_the_fill_covers_exactly_the_arenas_cells_two_blocks_high(facing: Facing, x: int, z: int, size: int) -> None:
    arena = Arena.around((x, 64, z), facing, size=size)
    words = reset_commands(Profile(arena=arena), (7, 14), [])[0].split()
    low, high = [int(word) for word in words[1:4]], [int(word) for word in words[4:7]]
    filled = {(east, south) for east in range(low[0], high[0] + 1) for south in range(low[2], high[2] + 1)}
    assert filled == {arena.block_of((column, row))[::2] for column in range(size) for row in range(size)}
    assert (low[1], high[1]) == (64, 65)


def test_every_command_of_a_reset_is_shorter_than_100_characters() -> None:
    far = Profile(arena=Arena.around((-29_999_999, 300, 29_999_900), "west"))
    assert max(map(len, reset_commands(far, (7, 14), ["waxed_weathered_cut_copper_stairs"]))) < 100


def test_a_profile_without_an_arena_has_no_reset_commands() -> None:
    with pytest.raises(ProfileError, match="run mc-nested calibrate arena"):
        reset_commands(Profile(), (7, 14), ["stone"])


def _world(folder: Path, text: str, *, marked: bool = True) -> Path:
    (folder / "region").mkdir(parents=True)
    (folder / "region" / "r.0.0.mca").write_text(text)
    (folder / "level.dat").write_text(text)
    if marked:
        (folder / MARKER).write_text("may be replaced")
    return folder


def _texts(folder: Path) -> set[str]:
    return {path.read_text() for path in folder.rglob("*") if path.is_file() and path.name != MARKER}


def test_restore_world_replaces_the_world_by_the_template_and_keeps_the_last_one(tmp_path: Path) -> None:
    world, template = _world(tmp_path / "saves/arena", "played"), _world(tmp_path / "template", "fresh")
    (world / "extra.dat").write_text("played")
    for text in ("played", "played again"):
        restore_world(world, template)
        assert _texts(world) == {"fresh"}
        assert not (world / "extra.dat").exists()
        assert _texts(tmp_path / KEPT / "arena.last") == {text}
        (world / "level.dat").write_text("played again")
        (world / "region" / "r.0.0.mca").write_text("played again")
    assert _texts(template) == {"fresh"}
    assert [path.name for path in (tmp_path / "saves").iterdir()] == ["arena"]


@pytest.mark.parametrize("unmarked", ["world", "template"])
def test_a_world_or_template_without_the_marker_file_is_refused(tmp_path: Path, unmarked: str) -> None:
    world = _world(tmp_path / "saves/arena", "mine", marked=unmarked != "world")
    template = _world(tmp_path / "template", "fresh", marked=unmarked != "template")
    with pytest.raises(RunError, match=f"has no {MARKER}"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}
    assert not (tmp_path / KEPT).exists()


def test_a_link_to_a_world_is_not_followed(tmp_path: Path) -> None:
    world, template = _world(tmp_path / "elsewhere", "mine"), _world(tmp_path / "template", "fresh")
    (tmp_path / "saves").mkdir()
    (tmp_path / "saves/arena").symlink_to(world)
    with pytest.raises(RunError, match="never replaced"):
        restore_world(tmp_path / "saves/arena", template)
    assert _texts(world) == {"mine"}


def test_a_template_inside_the_world_is_refused(tmp_path: Path) -> None:
    world = _world(tmp_path / "saves/arena", "mine")
    template = _world(world / "template", "mine")
    with pytest.raises(RunError, match="is the world itself, or in it"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}


def test_a_failed_rename_leaves_the_world_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world, template = _world(tmp_path / "saves/arena", "mine"), _world(tmp_path / "template", "fresh")
    rename = Path.rename

    def refuse(path: Path, target: Path) -> Path:
        if path.name == "arena.new":
            raise OSError("no")
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", refuse)
    with pytest.raises(RunError, match="can't be restored"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}


def test_a_copy_that_differs_from_the_template_is_not_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world, template = _world(tmp_path / "saves/arena", "mine"), _world(tmp_path / "template", "fresh")
    monkeypatch.setattr("mc_nested.live.menus.reset.filecmp.cmp", lambda *_, **__: False)
    with pytest.raises(RunError, match="differs"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}
