import pytest

from sim.client.desktop.clock import VirtualClock
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import Player, Realm
from sim.client.game.world import VirtualWorld
from sim.window.frame_pacer import FramePacer, SmoothEye


def test_the_clients_time_follows_the_real_time_frame_by_frame() -> None:
    clock = VirtualClock(100.0)
    pacer = FramePacer(clock, 50.0, 7.0)
    due = []
    for late in (0.0, 0.001, 0.0):
        at = pacer.next_frame + late
        due.append(pacer.next_frame)
        pacer.begin_frame(at)
        assert clock.now() == pytest.approx(100.0 + at - 7.0)
    assert due == pytest.approx([7.0, 7.02, 7.04])


def test_a_late_frame_does_not_hurry_the_next_ones() -> None:
    pacer = FramePacer(VirtualClock(), 50.0, 0.0)
    pacer.begin_frame(0.3)
    assert pacer.next_frame == pytest.approx(0.3)
    pacer.begin_frame(0.3)
    assert pacer.next_frame == pytest.approx(0.32)


def test_only_ten_ticks_are_made_up_for_after_a_long_stall() -> None:
    clock = VirtualClock(0.0)
    ticks: list[float] = []
    for number in range(100):
        clock.call_at(0.05 * number + 0.01, lambda: ticks.append(clock.now()))
    pacer = FramePacer(clock, 50.0, 0.0)
    pacer.begin_frame(3.0)
    assert len(ticks) == 10
    assert clock.now() == pytest.approx(0.5)
    pacer.begin_frame(3.1)
    assert clock.now() == pytest.approx(0.6), "what was lost stays lost"


def game() -> VirtualGame:
    return VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))


def test_the_eye_moves_evenly_between_two_ticks() -> None:
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
