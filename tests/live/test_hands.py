"""Hands: presses that keep their time, are gated by the window in front, and never leave anything down."""

import contextlib
import signal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import NotInFrontError
from mc_nested.live.ending import EndedBySignal
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import Arena, Input
from tests.live.fake_game import FakeClock, FakeDisplay, FakeGame, FakeKeyboard, FakePointer

PROFILE = Profile(arena=Arena.around((0, 64, 0), "south"))


def _hands(game: FakeGame, fail_after: int = -1) -> Hands:
    return Hands(FakeDisplay(game), FakeKeyboard(game, fail_after), FakePointer(game), game.clock, game.profile.input)


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


def test_a_click_is_as_long_as_the_profile_says() -> None:
    game = FakeGame(Profile(input=Input(click_s=0.12)))
    start = game.clock.now()
    _hands(game).click("right")
    assert game.clock.now() - start == pytest.approx(0.12)
    assert game.presses == ["right button"]


def test_a_command_arrives_whole_and_leaks_nothing_into_the_game() -> None:
    game = FakeGame(PROFILE)
    command = "/tp @s 1.5 64 3.5 -90 65"
    _hands(game).type_command("t", command)
    game.read()
    assert (game.commands, game.leaked, game.yaw, game.down) == ([command], "", -90.0, set())


@pytest.mark.parametrize("press", ["hold", "tap", "click", "type_command"])
def test_nothing_is_pressed_while_another_window_is_in_front(press: str) -> None:
    game = FakeGame(PROFILE, front_until=0.0)
    hands = _hands(game)
    with pytest.raises(NotInFrontError, match="not in front"):
        {
            "hold": lambda: hands.hold("w", 5),
            "tap": lambda: hands.tap("1"),
            "click": lambda: hands.click("right"),
            "type_command": lambda: hands.type_command("t", "/fill"),
        }[press]()
    assert game.presses == []


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
    return Hands(FakeDisplay(game), _JammingKeyboard(game), FakePointer(game), game.clock, PROFILE.input)


def test_one_key_that_can_not_be_released_does_not_keep_the_others_down() -> None:
    game = FakeGame(PROFILE)
    hands = _jamming_hands(game)
    for key in "ab":
        with pytest.raises(OSError, match="keyboard is gone"):
            hands.tap(key)
    assert game.down == {"a", "b"}
    with pytest.raises(OSError, match="keyboard is gone"):
        hands.release_all()
    assert game.down == {"b"}
    hands.release_all()
    assert game.down == set()


def test_a_letter_that_is_interrupted_after_its_press_goes_up_again() -> None:
    game = FakeGame(PROFILE)
    with pytest.raises(KeyboardInterrupt):
        _jamming_hands(game).type_command("t", "c")
    assert game.presses == ["t", "c"]
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
    with pytest.raises(NotInFrontError):
        hands.type_command("t", "/fill")
    assert game.presses_behind == []


def test_releasing_everything_twice_is_fine() -> None:
    hands = _hands(FakeGame(PROFILE))
    hands.release_all()
    hands.release_all()


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
    st.tuples(st.just("tap"), st.sampled_from("19t"), st.none()),
    st.tuples(st.just("click"), st.sampled_from(["left", "right"]), st.none()),
    st.tuples(st.just("type_command"), st.text("/tp @s 0.5", max_size=30), st.none()),
)


@given(st.lists(hand_actions, max_size=8), st.floats(0.0, 3.0), st.integers(-1, 20))
def test_nothing_stays_down_and_nothing_goes_elsewhere_whatever_happens(
    actions: list[tuple[str, str, int | None]], front_s: float, fail_after: int
) -> None:
    game = FakeGame(PROFILE)
    game.front_until = game.clock.now() + front_s
    with contextlib.suppress(NotInFrontError, OSError), _hands(game, fail_after) as hands:
        for kind, what, ticks in actions:
            if kind == "hold" and ticks is not None:
                hands.hold(what, ticks)
            elif kind == "tap":
                hands.tap(what)
            elif kind == "click":
                hands.click("left" if what == "left" else "right")
            else:
                hands.type_command("t", what)
    assert game.down == set()
    assert game.presses_behind == []
