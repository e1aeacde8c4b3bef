"""Comparing and copying regions by command, as each version answers."""

import pytest

from sim.client.client import VirtualClient
from sim.client.realm import Realm
from tests.sim.client.playing import command


def after(client: VirtualClient, line: str) -> Realm:
    command(client, line)
    return client.realm


def said(client: VirtualClient) -> str:
    return client.game.chat.lines(client.game.ticks)[0].text


@pytest.mark.parametrize(
    ("version", "answer"), [("1.12.2", "4 blocks cloned"), ("1.20.1", "Successfully cloned 4 blocks")]
)
def test_a_region_is_copied_to_where_its_lowest_corner_is_named(version: str, answer: str) -> None:
    client = VirtualClient(version=version)
    realm = after(client, "/clone 0 62 0 1 64 1 10 70 10")
    assert said(client) == answer.replace("4", "8")
    assert realm.world.block_at((11, 71, 11)) == "bedrock"
    assert realm.world.block_at((11, 72, 11)) == "air"
    after(client, "/clone 0 62 0 1 64 1 1 63 1")
    assert "cannot overlap" in said(client)


def test_a_condition_runs_its_command_or_says_nothing() -> None:
    client = VirtualClient()
    assert after(client, "/execute if blocks 0 64 0 3 65 3 9 80 9 all run tp @s ~ ~ ~ 0 31").player.pitch == 31
    client.realm.world.put((2, 64, 2), "stone")
    assert after(client, "/execute if blocks 0 64 0 3 65 3 9 80 9 all run tp @s ~ ~ ~ 0 32").player.pitch == 31
    assert after(client, "/execute unless blocks 0 64 0 3 65 3 9 80 9 all run tp @s ~ ~ ~ 0 33").player.pitch == 33
    assert after(client, "/execute if block 2 64 2 minecraft:air run tp @s ~ ~ ~ 0 34").player.pitch == 33
    assert after(client, "/execute unless block 2 64 2 minecraft:air run tp @s ~ ~ ~ 0 35").player.pitch == 35


def test_what_is_not_loaded_is_refused_either_way() -> None:
    client = VirtualClient()
    client.realm.view_distance = 1
    for joint in ("if", "unless"):
        after(client, f"/execute {joint} block 40 64 0 minecraft:air run tp @s ~ ~ ~ 0 44")
        assert client.realm.player.pitch == 0
        assert said(client) == "That position is not loaded"


def test_1_12_compares_in_its_own_words() -> None:
    client = VirtualClient(version="1.12.2")
    after(client, "/testforblocks 0 64 0 3 65 3 9 80 9")
    assert said(client) == "32 blocks compared"
    client.realm.world.put((2, 64, 2), "stone")
    after(client, "/testforblocks 0 64 0 3 65 3 9 80 9")
    assert said(client) == "Source and destination are not identical"
    assert after(client, "/execute @s ~ ~ ~ detect 0 64 0 minecraft:air 0 tp @s ~ ~ ~ 0 31").player.pitch == 31
    assert after(client, "/execute @s ~ ~ ~ detect 2 64 2 minecraft:air 0 tp @s ~ ~ ~ 0 32").player.pitch == 31


def test_newer_versions_do_not_know_the_older_command() -> None:
    client = VirtualClient()
    after(client, "/testforblocks 0 64 0 3 65 3 9 80 9")
    assert "<--[HERE]" in said(client)
