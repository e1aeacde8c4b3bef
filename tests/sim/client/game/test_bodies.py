"""Players in one world: each is as solid to the others as a block."""

import pytest

from sim.client.game.bodies import kept_apart, touches
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.physics import Vector
from sim.client.game.realm import Player, Realm, Stack
from sim.client.game.world import VirtualWorld

HEIGHT = 1.8


def two(first: Vector, second: Vector) -> tuple[VirtualGame, VirtualGame]:
    one = Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player(first))
    other = Realm(Edition("1.20.1"), one.world, Player(second), "Player2", players=one.players)
    return VirtualGame(one), VirtualGame(other)


@pytest.mark.parametrize(
    ("other", "is_touched"),
    [((0.59, 64.0, 0.0), True), ((0.61, 64.0, 0.0), False), ((0.5, 64.0, 0.59), True), ((0.0, 65.9, 0.0), False)],
)
def test_players_are_0_6_wide_and_1_8_high(other: Vector, is_touched: bool) -> None:
    assert touches((0.0, 64.0, 0.0), other, HEIGHT) == is_touched


def test_a_way_into_somebody_is_not_gone_and_the_other_way_is() -> None:
    before, after = (0.0, 64.0, 0.0), (0.5, 64.0, 0.1)
    assert kept_apart(before, after, [(1.0, 64.0, 0.0)], HEIGHT) == (0.0, 64.0, 0.1)
    assert kept_apart(before, after, [(5.0, 64.0, 0.0)], HEIGHT) == after


def test_who_is_in_somebody_may_leave() -> None:
    assert kept_apart((0.0, 64.0, 0.0), (0.1, 64.0, 0.0), [(0.2, 64.0, 0.0)], HEIGHT) == (0.1, 64.0, 0.0)


def test_a_player_walks_up_to_another_and_no_further() -> None:
    walker, _ = two((0.5, 64.0, 0.5), (0.5, 64.0, 3.5))
    walker.keys.press("w")
    for _ in range(60):
        walker.tick()
    assert 2.6 < walker.realm.player.feet[2] <= 2.9
    walker.keys.release("w")
    walker.keys.press("d")
    for _ in range(60):
        walker.tick()
    assert walker.realm.player.feet[0] < -3, "beside it the way is free"


def test_no_block_is_placed_into_another_player() -> None:
    builder, other = two((0.5, 64.0, 0.5), (0.5, 64.0, 1.5))
    builder.realm.player.hotbar[0] = Stack("stone", 64)
    builder.realm.player.look(0.0, 65.0)
    builder.keys.press("right button")
    builder.tick()
    assert builder.realm.world.built() == {}
    builder.keys.release("right button")
    other.realm.player.go_to((4.5, 64.0, 4.5))
    for _ in range(5):
        builder.tick()
    builder.keys.press("right button")
    builder.tick()
    assert other.realm.world.built() == {(0, 64, 1): "stone"}, "the other sees it, it is the same world"


def test_alone_there_are_no_others() -> None:
    realm = Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5)))
    assert realm.others() == []
