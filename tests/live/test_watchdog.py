"""The watchdog: what is held too long goes up, even while the program does nothing."""

import time

from mc_nested.live.hands import OVERDUE_S, Hands
from mc_nested.live.profile import Profile
from mc_nested.live.watchdog import watched
from tests.live.fake_game import FakeDisplay, FakeGame, FakeKeyboard, FakePointer


def test_a_key_that_is_held_past_its_time_goes_up_though_nobody_waits() -> None:
    game = FakeGame(Profile())
    hands = Hands(FakeDisplay(game), FakeKeyboard(game), FakePointer(game), game.clock, game.profile.input)
    hands.saw("world")
    with watched(hands):
        hands.press(game.clock.now() + 0.25, "w")
        game.clock.time += 0.25 + OVERDUE_S
        until = time.monotonic() + 2.0
        while game.down and time.monotonic() < until:
            time.sleep(0.01)
        assert game.down == set()


def test_what_is_held_for_a_while_is_left_alone() -> None:
    game = FakeGame(Profile())
    hands = Hands(FakeDisplay(game), FakeKeyboard(game), FakePointer(game), game.clock, game.profile.input)
    hands.saw("world")
    with watched(hands):
        hands.press(game.clock.now() + 0.25, "w")
        time.sleep(0.12)
        assert game.down == {"w"}
    hands.release_all()
