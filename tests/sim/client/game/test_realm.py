from pathlib import Path

import pytest

from sim.client.game.edition import Edition
from sim.client.game.physics import AT_REST
from sim.client.game.realm import Player, Realm, Stack, read_world, write_world
from sim.client.game.world import AIR, VirtualWorld


def realm(version: str = "1.20.1") -> Realm:
    return Realm(Edition(version), VirtualWorld(64, "dirt"), Player((8.5, 64.0, 8.5)))


@pytest.mark.parametrize(("pitch", "kept"), [(-91.0, -90.0), (-90.0, -90.0), (12.5, 12.5), (90.5, 90.0)])
def test_the_pitch_stops_at_straight_up_and_down(pitch: float, kept: float) -> None:
    player = realm().player
    player.look(400.0, pitch)
    assert (player.yaw, player.pitch) == (400.0, kept)


def test_go_to_leaves_the_player_standing_still() -> None:
    player = realm().player
    player.velocity = (1.0, 2.0, 3.0)
    player.go_to((1.0, 2.0, 3.0))
    assert (player.feet, player.velocity) == ((1.0, 2.0, 3.0), AT_REST)


def test_placing_uses_up_blocks_in_survival_and_not_in_creative() -> None:
    player = realm().player
    player.hotbar[0] = Stack("stone", 2)
    player.use_one()
    assert player.hotbar[0] == Stack("stone", 2)
    player.mode = "survival"
    player.use_one()
    assert player.hotbar[0] == Stack("stone", 1)
    player.use_one()
    assert player.hotbar[0] is None
    player.use_one()
    assert player.hotbar[0] is None


@pytest.mark.parametrize(("version", "name"), [("1.21.10", "keepInventory"), ("1.21.11", "keep_inventory")])
def test_a_rule_has_the_name_of_its_version(version: str, name: str) -> None:
    world = realm(version)
    assert not world.rule("keepInventory", "keep_inventory", False)
    assert world.rule("keepInventory", "keep_inventory", True)
    world.rules[name] = "true"
    assert world.rule("keepInventory", "keep_inventory", False)
    world.rules[name] = "false"
    assert not world.rule("keepInventory", "keep_inventory", True)


def test_the_eyes_are_lower_while_sneaking() -> None:
    world = realm()
    assert world.eye() == (8.5, 64.0 + 1.62, 8.5)
    assert world.size() == (1.8, 1.62)
    world.player.is_sneaking = True
    assert world.eye() == (8.5, 64.0 + 1.27, 8.5)


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


def test_writing_the_same_world_again_gives_the_same_file_and_keeps_other_files(tmp_path: Path) -> None:
    (tmp_path / "icon.png").write_bytes(b"icon")
    write_world(saved(), tmp_path)
    first = (tmp_path / "level.dat").read_bytes()
    write_world(saved(), tmp_path)
    assert (tmp_path / "level.dat").read_bytes() == first
    assert (tmp_path / "icon.png").read_bytes() == b"icon"
