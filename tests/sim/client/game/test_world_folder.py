from pathlib import Path

from sim.client.game.edition import Edition
from sim.client.game.realm import Player, Realm, Stack
from sim.client.game.world import AIR, VirtualWorld
from sim.client.game.world_folder import read_world, write_world


def saved() -> Realm:
    world = VirtualWorld(64, "bedrock")
    world.put((1, 64, -2), "stone")
    world.put((0, 63, 0), AIR)
    hotbar = [Stack("stone", 7), None, *[None] * 7]
    player = Player((1.5, 64.0, 2.5), 30.0, -10.0, mode="survival", slot=3, hotbar=hotbar)
    return Realm(Edition("1.20.1"), world, player, rules={"keepInventory": "true"}, day_time=123)


def test_a_written_world_is_read_back_with_its_player_and_rules(tmp_path: Path) -> None:
    write_world(saved(), tmp_path / "world")
    other = Realm(Edition("1.12.2"), VirtualWorld(0, "dirt"), Player((0.0, 0.0, 0.0)), "Somebody", has_cheats=False)
    read = read_world(other, tmp_path / "world")
    assert read.world.built() == {(1, 64, -2): "stone", (0, 63, 0): AIR}
    assert (read.world.floor, read.world.floor_block) == (64, "bedrock")
    assert read.player == saved().player
    assert (read.rules, read.day_time) == ({"keepInventory": "true"}, 123)
    assert (read.edition, read.player_name, read.has_cheats) == (Edition("1.12.2"), "Somebody", False)


def test_the_same_world_is_the_same_file_and_other_files_stay(tmp_path: Path) -> None:
    (tmp_path / "icon.png").write_bytes(b"icon")
    write_world(saved(), tmp_path)
    first = (tmp_path / "level.dat").read_bytes()
    write_world(saved(), tmp_path)
    assert (tmp_path / "level.dat").read_bytes() == first
    assert (tmp_path / "icon.png").read_bytes() == b"icon"
