import pytest

from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import Player, Realm
from sim.client.game.world import VirtualWorld
from sim.window.smooth_eye import SmoothEye


def game() -> VirtualGame:
    return VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))


def test_between_two_ticks_the_eye_moves_evenly() -> None:
    played = game()
    eye = SmoothEye(played)
    played.tick()
    played.realm.player.feet = (0.5, 64.0, 0.7)
    assert eye.at(1.0).position == pytest.approx((0.5, 65.62, 0.5))
    assert eye.at(1.025).position == pytest.approx((0.5, 65.62, 0.6))
    assert eye.at(1.05).position == eye.at(1.2).position == pytest.approx((0.5, 65.62, 0.7))


def test_a_teleport_and_a_turn_are_seen_at_once() -> None:
    played = game()
    eye = SmoothEye(played)
    played.tick()
    played.realm.player.feet = (30.5, 64.0, 0.5)
    played.realm.player.look(90.0, 20.0)
    seen = eye.at(1.0)
    assert seen.position == pytest.approx((30.5, 65.62, 0.5))
    assert (seen.yaw, seen.pitch) == (90.0, 20.0)
