"""Hands: presses that keep their time, are gated by the window in front, and never leave anything down."""

import contextlib
import signal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import NotInFrontError, StoppedError, WrongScreenError
from mc_nested.live.ending import EndedBySignal
from mc_nested.live.hands import FRESH_S, LONGEST_S, OVERDUE_S, Hands, Screen
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import Arena, Input
from tests.live.fake_game import FakeClock, FakeDisplay, FakeGame, FakeKeyboard, FakePointer

PROFILE = Profile(arena=Arena.around((0, 64, 0), "south"))


def _hands(game: FakeGame, fail_after: int = -1) -> Hands:
    """Hands whose owner has just seen the world."""
    hands = Hands(FakeDisplay(game), FakeKeyboard(game, fail_after), FakePointer(game), game.clock, game.profile.input)
    hands.saw("world")
    return hands


def _press(hands: Hands, how: str) -> None:
    {
        "hold": lambda: hands.hold("w", 5),
        "tap": lambda: hands.tap("1"),
        "click": lambda: hands.click("right"),
        "click_at": lambda: hands.click_at(3, 4),
        "hover": lambda: hands.hover(3, 4),
        "type_line": lambda: hands.type_line("/fill"),
    }[how]()


@pytest.mark.parametrize("ticks", [1, 2, 3, 5, 12])
def test_a_hold_of_n_ticks_is_n_ticks_in_the_game(ticks: int) -> None:
    game = FakeGame(PROFILE)
    _hands(game).hold("w", ticks)
    game.clock.sleep_until(game.clock.now() + 2.0)
    walked = game.read().xyz
    assert walked is not None
    assert walked[2] - 0.5 == pytest.approx(PROFILE.walk.covered[ticks - 1], abs=0.001)


def test_late_wake_ups_never_add_up() -> None:
    game = FakeGame(PROFILE, clock=FakeClock(late=0.004))
    start = game.clock.now()
    _hands(game).hold("w", 12)
    assert game.clock.now() - start == pytest.approx(0.604)


def test_a_click_is_as_long_as_the_profile_says_and_ends_while_something_is_waited_for() -> None:
    game = FakeGame(Profile(input=Input(click_s=0.12)))
    hands = _hands(game)
    hands.click("right")
    hands.wait(0.119)
    assert game.down == {"right button"}
    hands.wait(0.002)
    assert game.down == set()
    assert game.presses == ["right button"]


def test_a_held_key_may_go_up_at_another_time_than_was_said() -> None:
    game = FakeGame(PROFILE)
    hands = _hands(game)
    start = game.clock.now()
    hands.press(start + 0.25, "w")
    hands.keep_until(start + 0.2, "w")
    hands.wait_until(start + 0.199)
    assert game.down == {"w"}
    hands.wait_until(start + 0.2)
    assert game.down == set()


@pytest.mark.parametrize("press", ["hold", "tap", "click", "click_at", "hover", "type_line"])
def test_nothing_is_pressed_while_another_window_is_in_front(press: str) -> None:
    game = FakeGame(PROFILE, front_until=0.0)
    with pytest.raises(NotInFrontError, match="not in front"):
        _press(_hands(game), press)
    assert game.presses == []


@pytest.mark.parametrize("press", ["hold", "tap", "click", "click_at", "hover", "type_line"])
@pytest.mark.parametrize("seen", ["world", "chat", "menu"])
def test_nothing_is_pressed_that_the_screen_just_seen_is_not_there_for(press: str, seen: Screen) -> None:
    wanted = {"click_at": "menu", "hover": "menu", "type_line": "chat"}.get(press, "world")
    game = FakeGame(PROFILE)
    hands = _hands(game)
    hands.saw(seen)
    if seen == wanted:
        # The right one, but that is some time ago.
        game.clock.sleep_until(game.clock.now() + FRESH_S + 0.01)
    with pytest.raises(WrongScreenError, match=f"the {wanted} was not just seen"):
        _press(hands, press)
    assert game.presses == []


def test_a_stop_releases_everything_at_once_and_ends_what_is_going_on() -> None:
    game = FakeGame(PROFILE)
    hands = _hands(game)
    hands.press(game.clock.now() + 1.0, "w")
    hands.stop("the panic key was pressed")
    assert game.down == set()
    began = game.clock.now()
    with pytest.raises(StoppedError, match="the panic key was pressed: every key is up"):
        hands.wait(1.0)
    assert game.clock.now() - began <= 0.1
    with pytest.raises(StoppedError):
        hands.tap("1")
    assert game.presses == ["w"]


def test_nothing_is_held_longer_than_the_longest_hold() -> None:
    game = FakeGame(PROFILE)
    hands = _hands(game)
    hands.press(game.clock.now() + 60.0, "w")
    hands.wait(LONGEST_S + 0.01)
    assert game.down == set()


def test_what_nobody_released_in_time_is_the_watchdogs() -> None:
    game = FakeGame(PROFILE)
    hands = _hands(game)
    hands.press(game.clock.now() + 0.25, "w")
    game.clock.sleep_until(game.clock.now() + 0.26)
    hands.release_overdue()
    assert game.down == {"w"}
    game.clock.sleep_until(game.clock.now() + OVERDUE_S)
    hands.release_overdue()
    assert game.down == set()


def test_what_was_pressed_in_the_world_can_be_released_again() -> None:
    game = FakeGame(PROFILE)
    hands = _hands(game)
    hands.hold("w", 2)
    game.down = {"w"}
    hands.release_again()
    assert game.down == set()


def test_a_key_goes_up_within_a_tick_of_losing_the_window() -> None:
    game = FakeGame(PROFILE)
    start = game.clock.now()
    game.front_until = start + 0.07
    with pytest.raises(NotInFrontError):
        _hands(game).hold("w", 12)
    assert game.down == set()
    assert game.clock.now() - start <= 0.07 + 0.05


def test_a_failing_release_is_tried_again_when_the_hands_are_left() -> None:
    game = FakeGame(PROFILE)
    with pytest.raises(OSError, match="keyboard is gone"), _hands(game, fail_after=1) as hands:
        hands.hold("w", 2)
    assert game.down == set()


class _JammingKeyboard(FakeKeyboard):
    """Its keys stay down when they are released too early: "a" the first time, "b" the first two times."""

    def __init__(self, game: FakeGame) -> None:
        super().__init__(game)
        self._jams = ["a", "b", "b"]

    def type(self, text: str) -> None:
        self.press(text)
        raise KeyboardInterrupt

    def release(self, key: str) -> None:
        if key in self._jams:
            self._jams.remove(key)
            raise OSError("the keyboard is gone")
        super().release(key)


def _jamming_hands(game: FakeGame) -> Hands:
    hands = Hands(FakeDisplay(game), _JammingKeyboard(game), FakePointer(game), game.clock, PROFILE.input)
    hands.saw("world")
    return hands


def test_one_key_that_can_not_be_released_does_not_keep_the_others_down() -> None:
    game = FakeGame(PROFILE)
    hands = _jamming_hands(game)
    hands.press(game.clock.now() + 1.0, "a", "b", "c")
    with pytest.raises(OSError, match="keyboard is gone"):
        hands.release_all()
    assert game.down == {"a", "b"}
    with pytest.raises(OSError, match="keyboard is gone"):
        hands.release_all()
    assert game.down == {"b"}
    hands.release_all()
    assert game.down == set()


def test_a_letter_that_is_interrupted_after_its_press_goes_up_again() -> None:
    game = FakeGame(PROFILE)
    hands = _jamming_hands(game)
    hands.saw("chat")
    with pytest.raises(KeyboardInterrupt):
        hands.type_line("c")
    assert game.presses == ["c"]
    assert game.down == set()


class _StealingKeyboard(FakeKeyboard):
    """Brings another window to the front once a letter was typed."""

    def __init__(self, game: FakeGame) -> None:
        super().__init__(game)
        self._world = game

    def type(self, text: str) -> None:
        super().type(text)
        self._world.front_until = self._world.clock.now()


def test_no_letter_of_a_command_goes_to_a_window_that_comes_to_the_front() -> None:
    game = FakeGame(PROFILE)
    hands = Hands(FakeDisplay(game), _StealingKeyboard(game), FakePointer(game), game.clock, PROFILE.input)
    hands.saw("chat")
    with pytest.raises(NotInFrontError):
        hands.type_line("/fill")
    assert game.presses_behind == []


class CountingKeyboard(FakeKeyboard):
    """A keyboard that notes what is released."""

    def __init__(self, game: FakeGame) -> None:
        super().__init__(game)
        self.released: list[str] = []

    def release(self, key: str) -> None:
        self.released.append(key)
        super().release(key)


def test_releasing_everything_twice_is_fine() -> None:
    game = FakeGame(PROFILE)
    keyboard = CountingKeyboard(game)
    hands = Hands(FakeDisplay(game), keyboard, FakePointer(game), game.clock, game.profile.input)
    hands.saw("world")
    hands.press(game.clock.now() + 1.0, "w", "a")
    assert keyboard.released == []
    hands.release_all()
    hands.release_all()
    assert sorted(keyboard.released) == ["a", "w"]
    assert game.down == set()


class _EndingClock(FakeClock):
    """A clock in whose second sleep the process is sent a signal."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self._number = number

    def sleep_until(self, at: float) -> None:
        super().sleep_until(at)
        if len(self.slept) == 2:
            signal.raise_signal(self._number)


@pytest.mark.parametrize(("number", "error"), [(signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, EndedBySignal)])
def test_a_signal_in_the_middle_of_a_hold_leaves_nothing_down(number: int, error: type[BaseException]) -> None:
    game = FakeGame(PROFILE, clock=_EndingClock(number))
    before = signal.getsignal(signal.SIGTERM)
    with pytest.raises(error), _hands(game) as hands:
        hands.hold("w", 12)
    assert game.presses == ["w"]
    assert game.down == set()
    assert signal.getsignal(signal.SIGTERM) is before


hand_actions = st.one_of(
    st.tuples(st.just("hold"), st.sampled_from("wasd"), st.integers(1, 12)),
    st.tuples(st.just("press"), st.sampled_from("wasd"), st.integers(1, 200)),
    st.tuples(st.just("tap"), st.sampled_from("19t"), st.none()),
    st.tuples(st.just("click"), st.sampled_from(["left", "right"]), st.none()),
    st.tuples(st.just("type_line"), st.text("/tp @s 0.5", max_size=30), st.none()),
    st.tuples(st.just("stop"), st.just(""), st.none()),
)


@given(st.lists(hand_actions, max_size=8), st.floats(0.0, 3.0), st.integers(-1, 20))
def test_nothing_stays_down_and_nothing_goes_elsewhere_whatever_happens(
    actions: list[tuple[str, str, int | None]], front_s: float, fail_after: int
) -> None:
    game = FakeGame(PROFILE)
    game.front_until = game.clock.now() + front_s
    with contextlib.suppress(NotInFrontError, StoppedError, OSError), _hands(game, fail_after) as hands:
        for kind, what, ticks in actions:
            hands.saw("chat" if kind == "type_line" else "world")
            if kind == "hold" and ticks is not None:
                hands.hold(what, ticks)
            elif kind == "press" and ticks is not None:
                hands.press(game.clock.now() + ticks * 0.05, what)
            elif kind == "tap":
                hands.tap(what)
            elif kind == "click":
                hands.click("left" if what == "left" else "right")
            elif kind == "stop":
                hands.stop("enough")
            else:
                hands.type_line(what)
    assert game.down == set()
    assert game.presses_behind == []
