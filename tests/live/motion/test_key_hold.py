"""KeyHold: keys down for exactly as long as planned or changed, looks meanwhile, and looks until the walk is over.

Standstill: believed at once after a coasting tail, and only slowly where the picture may have stalled.
"""

import itertools
from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import NotConfirmedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import FRESH_S, LONGEST_S, InputController
from mc_nested.live.model.timing import FRAME_S, HALF_FRAME_S, THIRD_FRAME_S
from mc_nested.live.motion.key_hold import EVERY_LOOK, SNEAK_FIRST_S, STALL_S, KeyHold, Standstill
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseFrame, PoseObserver
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import Profile
from tests.live.fake_game import FakeGame, FakeKeyboard, FakeScreen, devices_of

PROFILE = Profile(arena=Arena.around((14, 64, 0), "south"))


class TimedKeyboard(FakeKeyboard):
    """Notes when each key goes down and up, in seconds from the beginning."""

    def __init__(self, game: FakeGame) -> None:
        super().__init__(game)
        self._clock = game.clock
        self.events: list[tuple[str, float]] = []

    def press(self, key: str) -> None:
        self.events.append((f"{key} down", self._clock.now() - 100.0))
        super().press(key)

    def release(self, key: str) -> None:
        self.events.append((f"{key} up", self._clock.now() - 100.0))
        super().release(key)


class Holding:
    """An agent that stands still, on a clock that begins at 100 seconds."""

    def __init__(self) -> None:
        self.game = FakeGame(PROFILE, xyz=(7.5, 64.0, 7.5), pitch=65.0)
        self.keyboard = TimedKeyboard(self.game)
        devices = devices_of(self.game, self.keyboard)
        self.controller = InputController(devices, PROFILE.input)
        connection = GameConnection(devices, self.controller, FakeScreen(self.game))
        self.observer = PoseObserver(PROFILE, connection, PoseFrame.of_arena(PROFILE))
        self.key_hold = KeyHold(connection, self.observer, 5.0)
        self.observer.look()
        self.observer.permit_press()

    def now(self) -> float:
        return self.game.clock.now() - 100.0

    def every(self, seconds: float) -> Iterator[float]:
        while True:
            yield self.game.clock.now() + seconds


@pytest.fixture
def holding() -> Holding:
    return Holding()


def test_keys_are_down_until_the_release_time(holding: Holding) -> None:
    assert holding.key_hold.hold(100.2, "left.shift", "w") == 100.2
    downs, ups = holding.keyboard.events[:2], holding.keyboard.events[2:]
    assert downs == [("left.shift down", 0.0), ("w down", 0.0)]
    assert {name for name, _ in ups} == {"left.shift up", "w up"}
    assert [at for _, at in ups] == [pytest.approx(0.2)] * 2


def test_the_sneak_key_is_pressed_three_ticks_before_the_other_and_released_after_it(holding: Holding) -> None:
    holding.key_hold.begin_sneaking("left.shift")
    assert holding.now() == pytest.approx(SNEAK_FIRST_S)
    holding.key_hold.hold(100.0 + holding.now() + 0.1, "w", sneak="left.shift")
    names = [name for name, _ in holding.keyboard.events]
    assert names == ["left.shift down", "w down", "w up", "left.shift up"]
    assert [at for _, at in holding.keyboard.events] == pytest.approx([0.0, 0.15, 0.25, 0.25])
    assert holding.key_hold.pressed_at == pytest.approx(100.15)


def test_a_look_that_delays_the_release_keeps_the_sneak_key_down_too(holding: Holding) -> None:
    holding.key_hold.begin_sneaking("left.shift")
    holding.key_hold.hold(100.3, "w", sneak="left.shift", look_times=(100.2,), on_look=lambda: 100.4)
    assert [at for _, at in holding.keyboard.events[2:]] == pytest.approx([0.4, 0.4])


def test_looks_come_at_their_times_but_not_just_before_the_release(holding: Holding) -> None:
    looks: list[float] = []
    holding.key_hold.hold(100.1, "w", look_times=holding.every(0.03), on_look=lambda: looks.append(holding.now()))
    assert looks == pytest.approx([0.03, 0.06, 0.09])
    looks.clear()
    began = holding.now()
    holding.observer.look()
    holding.observer.permit_press()
    release_at = 100.0 + began + 0.06 + HALF_FRAME_S / 2
    holding.key_hold.hold(release_at, "w", look_times=holding.every(0.03), on_look=lambda: looks.append(holding.now()))
    assert looks == pytest.approx([began + 0.03])
    assert holding.now() == pytest.approx(release_at - 100.0)


def test_a_look_can_change_the_release_time(holding: Holding) -> None:
    later = iter([None, 100.4])
    assert holding.key_hold.hold(100.2, "w", look_times=(100.05, 100.1), on_look=lambda: next(later)) == 100.4
    name, at = holding.keyboard.events[-1]
    assert name == "w up"
    assert at == pytest.approx(0.4)


def test_a_look_can_end_the_hold_at_once(holding: Holding) -> None:
    holding.key_hold.hold(100.5, "w", look_times=holding.every(0.05), on_look=holding.game.clock.now)
    name, at = holding.keyboard.events[-1]
    assert name == "w up"
    assert at == pytest.approx(0.05)


def test_a_look_that_fails_leaves_no_key_down(holding: Holding) -> None:
    def fail() -> float | None:
        raise NotConfirmedError("turned")

    with pytest.raises(NotConfirmedError, match="turned"):
        holding.key_hold.hold(100.5, "w", look_times=(100.1,), on_look=fail)
    assert holding.game.down == set()
    assert holding.now() == pytest.approx(0.1)


@pytest.mark.parametrize("look_s", [THIRD_FRAME_S, HALF_FRAME_S])
def test_the_first_looks_come_fast_or_all_of_them_on_request(look_s: float, holding: Holding) -> None:
    for fast_looks, gaps in ((3, [look_s] * 3 + [FRAME_S] * 2), (EVERY_LOOK, [look_s] * 5)):
        times: list[float] = []

        def is_over(pose: PoseEstimate, times: list[float] = times) -> bool:
            times.append(holding.now())
            return len(times) == 6 and pose.problem is None

        last = holding.key_hold.follow(holding.observer.look(), is_over, fast_looks, look_s)
        assert [after - before for before, after in itertools.pairwise(times)] == pytest.approx(gaps)
        assert last.position == (7.0, 7.0)


def test_a_walk_that_is_over_at_the_first_pose_needs_no_look(holding: Holding) -> None:
    pose = holding.observer.look()
    assert holding.key_hold.follow(pose, lambda _: True) is pose
    assert holding.now() == 0.0


def test_keys_are_released_again_at_every_twentieth_look_until_the_patience_ends(holding: Holding) -> None:
    holding.key_hold.hold(100.1, "w")
    with pytest.raises(NotConfirmedError, match="does not stand still"):
        holding.key_hold.follow(holding.observer.look(), lambda _: False)
    again = [at for name, at in holding.keyboard.events[2:] if name == "w up"]
    # 19 looks, six of them a third of a frame after the one before; then 20 looks a frame apart.
    assert again[0] == pytest.approx(0.1 + 15 * FRAME_S)
    assert again[1] == pytest.approx(again[0] + 20 * FRAME_S)
    assert holding.now() == pytest.approx(5.1, abs=FRAME_S)


def begin_with_a_slow_look(holding: Holding, seconds: float) -> None:
    """Sneak, and let the look before the next press take so long, as where the screen can't be read for a while."""
    holding.key_hold.begin_sneaking("left.shift")

    def look_again() -> None:
        holding.controller.wait(seconds)
        holding.controller.confirm_screen("world")

    holding.controller.confirm_screen("world", look_again)
    holding.game.clock.sleep_until(holding.game.clock.now() + FRESH_S + 0.01)


def test_the_sneak_key_is_down_for_three_ticks_even_after_a_slow_look(holding: Holding) -> None:
    def look() -> bool:
        if not holding.game.down:
            holding.game.clock.sleep_until(holding.game.clock.now() + 0.2)
        return True

    holding.controller.guard_world(look)
    holding.key_hold.begin_sneaking("left.shift")
    holding.key_hold.hold(100.0 + holding.now() + 0.1, "w", sneak="left.shift")
    (_, sneaks_at), (_, walks_at), *_ = holding.keyboard.events
    assert sneaks_at == pytest.approx(0.2)
    assert walks_at - sneaks_at == pytest.approx(SNEAK_FIRST_S)


@pytest.mark.parametrize("seconds", [0.5, 1.5, 2.5])
def test_the_sneak_key_stays_down_during_a_slow_look_before_the_other_key(seconds: float, holding: Holding) -> None:
    begin_with_a_slow_look(holding, seconds)
    holding.key_hold.hold(100.0 + holding.now() + 0.1, "w", sneak="left.shift")
    assert [name for name, _ in holding.keyboard.events] == ["left.shift down", "w down", "w up", "left.shift up"]
    assert holding.keyboard.events[2][1] - holding.keyboard.events[1][1] == pytest.approx(0.1)


def test_the_other_key_is_not_pressed_if_the_sneak_key_has_gone_up(holding: Holding) -> None:
    begin_with_a_slow_look(holding, LONGEST_S)
    with pytest.raises(NotConfirmedError, match=r"left\.shift did not stay down .*: close what slows the computer"):
        holding.key_hold.hold(100.0 + holding.now() + 0.1, "w", sneak="left.shift")
    assert "w down" not in [name for name, _ in holding.keyboard.events]
    assert holding.game.down == set()


SETTLE_S = 0.15


def _walked(ticks: int) -> list[float]:
    """Return where a walker is after each tick of a hold and of the coasting after it (FACTS: Walking)."""
    places, place, speed = [], 0.0, 0.0
    for tick in range(ticks + 12):
        speed = (speed if speed >= 0.003 else 0.0) + (0.098 if tick < ticks else 0.0)
        place += speed
        speed *= 0.546
        places.append(round(place, 3))
    return places


def _seconds_until_reached(places: list[float], tick_s: float = 0.05) -> float:
    """Return the seconds from the first position until standstill, with the last position staying."""
    standstill = Standstill((0.0, 0.0), 0.0, SETTLE_S)
    for look in range(1000):
        place = places[min(int(look * 0.01 / tick_s), len(places) - 1)]
        if standstill.is_reached((0.0, place), look * 0.01):
            return look * 0.01
    raise AssertionError("never stood")


@given(st.integers(1, 12))
def test_standstill_is_found_soon_after_the_last_step_of_a_walk(ticks: int) -> None:
    places = _walked(ticks)
    last_step_s = places.index(places[-1]) * 0.05
    assert last_step_s + SETTLE_S <= _seconds_until_reached(places) <= last_step_s + SETTLE_S + 0.02


@given(st.integers(2, 6), st.data(), st.floats(0.16, 0.9))
def test_a_stall_while_the_key_is_still_felt_is_waited_out(ticks: int, data: st.DataObject, stall_s: float) -> None:
    places = _walked(ticks)
    stalled = data.draw(st.integers(0, ticks - 1))
    late = places[:stalled] + [places[stalled]] * round(stall_s / 0.05) + places[stalled:]
    assert _seconds_until_reached(late) >= late.index(places[-1]) * 0.05 + SETTLE_S


def test_a_game_that_answers_late_is_waited_for() -> None:
    late = [0.0] * 10 + _walked(5)
    assert _seconds_until_reached(late) >= late.index(late[-1]) * 0.05


def test_a_walker_that_never_moved_stands_still_after_a_while() -> None:
    assert STALL_S <= _seconds_until_reached([0.0]) <= STALL_S + 0.02
