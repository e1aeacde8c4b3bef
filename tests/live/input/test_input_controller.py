"""InputController: presses that keep their time, are gated by the window in front, and never leave anything down."""

import contextlib
import signal
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import NotConfirmedError, NotInFrontError, StoppedError, TakenOverError, WrongScreenError
from mc_nested.live.input.input_controller import (
    FRESH_S,
    LONGEST_S,
    OVERDUE_S,
    PATIENCE_S,
    SLOW_S,
    InputController,
    PressTarget,
)
from mc_nested.live.input.signals import EndedBySignal
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import InputTable, Profile
from tests.live.fake_game import FakeClock, FakeGame, FakeKeyboard, devices_of
from tests.live.menus.fake_menus import FakeMenus, connection_of

PROFILE = Profile(arena=Arena.around((0, 64, 0), "south"))


def _controller(game: FakeGame, fail_after: int = -1) -> InputController:
    """Return a controller for which the world was just confirmed."""
    controller = InputController(devices_of(game, FakeKeyboard(game, fail_after)), game.profile.input)
    controller.confirm_screen("world")
    return controller


def _press(controller: InputController, how: str) -> None:
    {
        "hold": lambda: controller.hold("w", 5),
        "tap": lambda: controller.tap("1"),
        "click": lambda: controller.click("right"),
        "click_at": lambda: controller.click_at(3, 4),
        "hover": lambda: controller.hover(3, 4),
        "tap_alone": lambda: controller.tap_alone("2"),
        "press": lambda: controller.wait_until(controller.press(0.0, "w")),
        "type_line": lambda: controller.type_line("/fill"),
    }[how]()


@pytest.mark.parametrize("ticks", [1, 2, 3, 5, 12])
def test_a_hold_of_n_ticks_walks_n_ticks_in_the_game(ticks: int) -> None:
    game = FakeGame(PROFILE)
    _controller(game).hold("w", ticks)
    game.clock.sleep_until(game.clock.now() + 2.0)
    walked = game.read().xyz
    assert walked is not None
    assert walked[2] - 0.5 == pytest.approx(PROFILE.walk.covered[ticks - 1], abs=0.001)


def test_tap_alone_waits_until_every_other_key_is_up() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.press(game.clock.now() + 0.1, "left.shift")
    controller.press(game.clock.now() + 0.2, "w")
    began = game.clock.now()
    controller.tap_alone("2")
    assert game.down == set()
    assert game.clock.now() - began == pytest.approx(0.2 + TICK_S)


def test_a_late_clock_delays_a_hold_by_one_wake_up_and_not_by_each() -> None:
    game = FakeGame(PROFILE, clock=FakeClock(late=0.004))
    start = game.clock.now()
    _controller(game).hold("w", 12)
    assert game.clock.now() - start == pytest.approx(0.604)


def test_a_click_lasts_the_profiles_time_and_ends_during_a_wait() -> None:
    game = FakeGame(Profile(input=InputTable(click_s=0.12)))
    controller = _controller(game)
    controller.click("right")
    controller.wait(0.119)
    assert game.down == {"right button"}
    controller.wait(0.002)
    assert game.down == set()
    assert game.presses == ["right button"]


def test_the_release_time_of_a_held_key_can_be_changed() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    start = game.clock.now()
    controller.press(start + 0.25, "w")
    controller.keep_until(start + 0.2, "w")
    controller.wait_until(start + 0.199)
    assert game.down == {"w"}
    controller.wait_until(start + 0.2)
    assert game.down == set()


@pytest.mark.parametrize("press", ["hold", "tap", "click", "click_at", "hover", "type_line"])
def test_no_key_is_pressed_while_another_window_is_in_front(press: str) -> None:
    game = FakeGame(PROFILE, front_until=0.0)
    with pytest.raises(NotInFrontError, match="not in front"):
        _press(_controller(game), press)
    assert game.presses == []


@pytest.mark.parametrize("press", ["hold", "tap", "click", "click_at", "hover", "type_line"])
@pytest.mark.parametrize("seen", ["world", "chat", "menu"])
def test_a_press_for_a_screen_that_was_not_just_seen_is_refused(press: str, seen: PressTarget) -> None:
    wanted = {"click_at": "menu", "hover": "menu", "type_line": "chat"}.get(press, "world")
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.confirm_screen(seen)
    if seen == wanted:
        # The right one, but that is some time ago.
        game.clock.sleep_until(game.clock.now() + FRESH_S + 0.01)
    with pytest.raises(WrongScreenError, match=f"the {wanted} was not just seen"):
        _press(controller, press)
    assert game.presses == []


@pytest.mark.parametrize("press", ["hold", "tap", "click"])
def test_a_press_long_after_a_look_is_sent_only_if_a_second_look_confirms_the_screen(press: str) -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    looks: list[str] = []

    def look_again() -> None:
        looks.append(press)
        if len(looks) == 1:
            raise NotConfirmedError("the player was turned")
        controller.confirm_screen("world")

    controller.confirm_screen("world", look_again)
    game.clock.sleep_until(game.clock.now() + FRESH_S + 0.01)
    with pytest.raises(NotConfirmedError, match="turned"):
        _press(controller, press)
    assert game.presses == []
    _press(controller, press)
    assert len(looks) == 2
    assert len(game.presses) == 1


@pytest.mark.parametrize("slow_s", [FRESH_S + 0.01, 0.9, SLOW_S - 0.01])
def test_a_press_waits_for_a_quick_look_where_looks_are_slow_for_a_while(slow_s: float) -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    quick_from = game.clock.now() + slow_s

    def look() -> bool:
        game.clock.sleep_until(game.clock.now() + (0.01 if game.clock.now() >= quick_from else FRESH_S + 0.01))
        return True

    def look_again() -> None:
        look()
        controller.confirm_screen("world", look_again)

    controller.guard_world(look)
    controller.confirm_screen("world", look_again)
    controller.tap("1")
    assert game.presses == ["1"]


def test_a_press_is_refused_where_every_look_is_slow() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)

    def look() -> bool:
        game.clock.sleep_until(game.clock.now() + FRESH_S + 0.01)
        return True

    def look_again() -> None:
        controller.confirm_screen("world", look_again)
        look()

    controller.guard_world(look)
    controller.confirm_screen("world", look_again)
    began = game.clock.now()
    with pytest.raises(WrongScreenError, match="the world was not just seen"):
        controller.tap("1")
    assert SLOW_S <= game.clock.now() - began < SLOW_S + 1.0
    assert game.presses == []


def test_a_stall_just_after_a_second_look_makes_a_press_late_and_does_not_refuse_it() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    stalls = iter([FRESH_S + 0.01])

    def look_again() -> None:
        controller.confirm_screen("world", look_again)
        game.clock.sleep_until(game.clock.now() + next(stalls, 0.0))

    controller.confirm_screen("world", look_again)
    game.clock.sleep_until(game.clock.now() + FRESH_S + 0.01)
    controller.tap("1")
    assert game.presses == ["1"]


def test_a_press_soon_after_a_look_or_for_another_screen_does_not_look_again() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.confirm_screen("world", lambda: pytest.fail("looked again"))
    controller.click("right")
    controller.confirm_screen("menu", lambda: pytest.fail("looked again"))
    game.clock.sleep_until(game.clock.now() + FRESH_S + 0.01)
    with pytest.raises(WrongScreenError):
        controller.click("right")
    assert game.presses == ["right button"]


@pytest.mark.parametrize("press", ["hold", "tap", "click"])
def test_a_press_into_the_world_is_refused_while_the_world_is_not_seen(press: str) -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.press(game.clock.now() + 1.0, "left.shift")
    controller.guard_world(lambda: False)
    began = game.clock.now()
    with pytest.raises(WrongScreenError, match="the world is not seen with nothing over it"):
        _press(controller, press)
    assert PATIENCE_S <= game.clock.now() - began < PATIENCE_S + 0.1
    assert (game.presses, game.down) == (["left.shift"], set())


def test_a_press_waits_until_a_briefly_hidden_world_is_seen_again() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    looks = iter([False, False, True, True])
    again: list[float] = []
    controller.guard_world(lambda: next(looks))
    controller.confirm_screen("world", lambda: again.append(game.clock.now()))
    controller.tap("1")
    assert game.presses == ["1"]
    assert len(again) == 1


def test_a_press_for_a_menu_or_the_chat_does_not_check_the_world() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.guard_world(lambda: False)
    controller.confirm_screen("menu")
    controller.tap("esc", on="menu")
    controller.confirm_screen("chat")
    controller.tap("enter", on="chat")
    assert game.presses == ["esc", "enter"]


@pytest.mark.parametrize("look_s", [0.0, 0.03, 0.3])
def test_a_slow_look_delays_a_hold_but_does_not_shorten_it(look_s: float) -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    began = game.clock.now()

    def look() -> bool:
        game.clock.sleep_until(game.clock.now() + look_s)
        return True

    controller.guard_world(look)
    controller.hold("w", 3)
    assert game.clock.now() - began == pytest.approx(look_s + 3 * TICK_S)
    assert game.down == set()


def test_a_stop_releases_every_key_at_once_and_ends_waits_and_presses() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.press(game.clock.now() + 1.0, "w")
    controller.stop("the panic key was pressed")
    assert game.down == set()
    began = game.clock.now()
    with pytest.raises(StoppedError, match="the panic key was pressed: every key is up"):
        controller.wait(1.0)
    assert game.clock.now() - began <= 0.1
    with pytest.raises(StoppedError):
        controller.tap("1")
    assert game.presses == ["w"]


def test_no_key_is_held_longer_than_the_longest_hold() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.press(game.clock.now() + 60.0, "w")
    controller.wait(LONGEST_S + 0.01)
    assert game.down == set()


def test_the_watchdog_releases_only_overdue_keys() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.press(game.clock.now() + 0.25, "w")
    game.clock.sleep_until(game.clock.now() + 0.26)
    controller.release_overdue()
    assert game.down == {"w"}
    game.clock.sleep_until(game.clock.now() + OVERDUE_S)
    controller.release_overdue()
    assert game.down == set()


def test_a_key_is_overdue_a_quarter_of_a_second_after_its_release_time() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.press(100.25, "w")
    game.clock.sleep_until(100.499)
    controller.release_overdue()
    assert game.down == {"w"}
    game.clock.sleep_until(100.5)
    controller.release_overdue()
    assert game.down == set()


def test_a_key_pressed_in_the_world_can_be_released_again() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.hold("w", 2)
    game.down = {"w"}
    controller.release_again()
    assert game.down == set()


def test_a_changed_release_time_is_cut_to_the_longest_hold() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.press(game.clock.now() + 0.2, "w")
    controller.keep_until(game.clock.now() + 60.0, "w")
    controller.wait(LONGEST_S - 0.01)
    assert game.down == {"w"}
    controller.wait(0.02)
    assert game.down == set()


def test_changing_the_release_time_of_a_key_that_is_up_presses_nothing() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.keep_until(game.clock.now() + 1.0, "w")
    controller.wait(1.1)
    assert (game.presses, game.down) == ([], set())


def test_a_screen_that_was_just_confirmed_permits_presses_for_a_quarter_of_a_second() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    game.clock.sleep_until(game.clock.now() + FRESH_S)
    controller.tap("1")
    assert game.presses == ["1"]


def test_a_press_before_any_screen_was_confirmed_is_refused() -> None:
    game = FakeGame(PROFILE)
    controller = InputController(devices_of(game), game.profile.input)
    with pytest.raises(WrongScreenError, match="the world was not just seen"):
        controller.tap("1")
    assert game.presses == []


def test_only_keys_pressed_in_the_world_are_released_again() -> None:
    game = FakeGame(PROFILE)
    keyboard = CountingKeyboard(game)
    controller = InputController(devices_of(game, keyboard), game.profile.input)
    controller.confirm_screen("menu")
    controller.tap("esc", on="menu")
    controller.confirm_screen("world")
    controller.tap("1")
    assert keyboard.released == ["esc", "1"]
    controller.release_again()
    assert keyboard.released == ["esc", "1", "1"]


def test_check_front_raises_while_another_window_is_in_front() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.check_front()
    game.front_until = game.clock.now()
    with pytest.raises(NotInFrontError, match="not by a click"):
        controller.check_front()


def test_a_click_on_a_menu_moves_the_mouse_and_presses_a_tick_later() -> None:
    menus = FakeMenus("pause")
    controller = connection_of(menus).controller
    controller.confirm_screen("menu")
    controller.click_at(427, 100)
    assert menus.pressed == [(427, 100)]
    assert menus.clock.now() == pytest.approx(100.0 + 0.05 + 0.08)


def test_hovering_presses_nothing() -> None:
    menus = FakeMenus("pause")
    controller = connection_of(menus).controller
    controller.confirm_screen("menu")
    controller.hover(427, 100)
    assert menus.position() == (427, 100)
    assert menus.pressed == []


@pytest.mark.parametrize(
    ("off", "is_clicked"),
    [((3, 3), True), ((-3, -3), True), ((4, 0), False), ((0, 4), False), ((-4, 0), False), ((0, -4), False)],
)
def test_a_click_is_refused_if_the_mouse_has_been_moved_meanwhile(off: tuple[int, int], is_clicked: bool) -> None:
    class Drifting(FakeMenus):
        """The mouse ends up a little beside where it was moved to."""

        def position(self) -> tuple[int, int]:
            x, y = super().position()
            return x + off[0], y + off[1]

    menus = Drifting("pause")
    controller = connection_of(menus).controller
    controller.confirm_screen("menu")
    with contextlib.nullcontext() if is_clicked else pytest.raises(WrongScreenError, match="the mouse was moved"):
        controller.click_at(427, 100)
    assert menus.pressed == ([(427, 100)] if is_clicked else [])


def test_a_key_goes_up_within_a_tick_of_losing_the_window() -> None:
    game = FakeGame(PROFILE)
    start = game.clock.now()
    game.front_until = start + 0.07
    with pytest.raises(NotInFrontError):
        _controller(game).hold("w", 12)
    assert game.down == set()
    assert game.clock.now() - start <= 0.07 + 0.05


def test_a_failed_release_is_repeated_when_the_controller_is_left() -> None:
    game = FakeGame(PROFILE)
    with pytest.raises(OSError, match="keyboard is gone"), _controller(game, fail_after=1) as controller:
        controller.hold("w", 2)
    assert game.down == set()


class _JammingKeyboard(FakeKeyboard):
    """Its keys stay down when they are released too early: "a" the first time, "b" the first two times."""

    def __init__(self, game: FakeGame) -> None:
        super().__init__(game)
        self._jams = ["a", "b", "b"]

    def release(self, key: str) -> None:
        if key in self._jams:
            self._jams.remove(key)
            raise OSError("the keyboard is gone")
        super().release(key)


def _jamming_controller(game: FakeGame) -> InputController:
    controller = InputController(devices_of(game, _JammingKeyboard(game)), PROFILE.input)
    controller.confirm_screen("world")
    return controller


def test_a_key_whose_release_fails_does_not_keep_other_keys_down() -> None:
    game = FakeGame(PROFILE)
    controller = _jamming_controller(game)
    controller.press(game.clock.now() + 1.0, "a", "b", "c")
    with pytest.raises(OSError, match="keyboard is gone"):
        controller.release_all()
    assert game.down == {"a", "b"}
    with pytest.raises(OSError, match="keyboard is gone"):
        controller.release_all()
    assert game.down == {"b"}
    controller.release_all()
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
    controller = InputController(devices_of(game, _StealingKeyboard(game)), PROFILE.input)
    controller.confirm_screen("chat")
    with pytest.raises(NotInFrontError):
        controller.type_line("/fill")
    assert game.presses_behind == []


class CountingKeyboard(FakeKeyboard):
    """A keyboard that notes what is released."""

    def __init__(self, game: FakeGame) -> None:
        super().__init__(game)
        self.released: list[str] = []

    def release(self, key: str) -> None:
        self.released.append(key)
        super().release(key)


def test_releasing_everything_twice_releases_once() -> None:
    game = FakeGame(PROFILE)
    keyboard = CountingKeyboard(game)
    controller = InputController(devices_of(game, keyboard), game.profile.input)
    controller.confirm_screen("world")
    controller.press(game.clock.now() + 1.0, "w", "a")
    assert keyboard.released == []
    controller.release_all()
    controller.release_all()
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
def test_a_signal_during_a_hold_leaves_no_key_down(number: int, error: type[BaseException]) -> None:
    game = FakeGame(PROFILE, clock=_EndingClock(number))
    before = signal.getsignal(signal.SIGTERM)
    with pytest.raises(error), _controller(game) as controller:
        controller.hold("w", 12)
    assert game.presses == ["w"]
    assert game.down == set()
    assert signal.getsignal(signal.SIGTERM) is before


controller_actions = st.one_of(
    st.tuples(st.just("hold"), st.sampled_from("wasd"), st.integers(1, 12)),
    st.tuples(st.just("press"), st.sampled_from("wasd"), st.integers(1, 200)),
    st.tuples(st.just("tap"), st.sampled_from("19t"), st.none()),
    st.tuples(st.just("click"), st.sampled_from(["left", "right"]), st.none()),
    st.tuples(st.just("type_line"), st.text("/tp @s 0.5", max_size=30), st.none()),
    st.tuples(st.just("stop"), st.just(""), st.none()),
)


@given(st.lists(controller_actions, max_size=8), st.floats(0.0, 3.0), st.integers(-1, 20))
def test_no_key_stays_down_or_reaches_another_window_whatever_happens(
    actions: list[tuple[str, str, int | None]], front_s: float, fail_after: int
) -> None:
    game = FakeGame(PROFILE)
    game.front_until = game.clock.now() + front_s
    with contextlib.suppress(NotInFrontError, StoppedError, OSError), _controller(game, fail_after) as controller:
        for kind, what, ticks in actions:
            controller.confirm_screen("chat" if kind == "type_line" else "world")
            if kind == "hold" and ticks is not None:
                controller.hold(what, ticks)
            elif kind == "press" and ticks is not None:
                controller.press(game.clock.now() + ticks * 0.05, what)
            elif kind == "tap":
                controller.tap(what)
            elif kind == "click":
                controller.click("left" if what == "left" else "right")
            elif kind == "stop":
                controller.stop("enough")
            else:
                controller.type_line(what)
    assert game.down == set()
    assert game.presses_behind == []


PRESSES = ("hold", "tap", "click", "click_at", "hover", "type_line", "tap_alone", "press")


@pytest.mark.parametrize("how", PRESSES)
@given(st.floats(0.0, 0.3))
def test_whatever_is_pressed_nothing_is_once_the_player_has_taken_over(how: str, after_s: float) -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.hold("d", 1)
    controller.press(game.clock.now() + 0.2, "a")
    controller.wait(after_s)
    controller.switch_over()
    assert game.down == set()
    controller.switch_over()  # given back, but nobody has taken it back yet
    before = list(game.presses)
    for screen in get_args(PressTarget):
        controller.confirm_screen(screen)
        with pytest.raises(TakenOverError):
            _press(controller, how)
    controller.release_again()
    assert (game.presses, game.down) == (before, set())
    assert controller.take_back()
    controller.confirm_screen("world")
    controller.tap("1")
    assert game.presses == [*before, "1"]


def test_a_hold_ends_as_soon_as_the_player_takes_over() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    began = game.clock.now()
    controller.press(began + 2.0, "w")
    controller.wait(0.1)
    controller.switch_over()
    with pytest.raises(TakenOverError):
        controller.wait_until(began + 2.0)
    assert game.down == set()
    assert game.clock.now() - began < 0.2


def test_what_is_borrowed_from_the_player_ends_when_they_take_over_anew() -> None:
    game = FakeGame(PROFILE)
    controller = _controller(game)
    controller.switch_over()
    with controller.borrowed():
        controller.tap("1")
        controller.switch_over()
        controller.confirm_screen("world")
        controller.tap("2")
        controller.switch_over()
        with pytest.raises(TakenOverError):
            controller.tap("3")
    assert game.presses == ["1", "2"]
    assert not controller.take_back()
