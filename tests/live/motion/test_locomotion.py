"""Locomotion: the right keys for the right number of ticks, and where the agent stops."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import NotConfirmedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import displacement
from mc_nested.live.model.reading import Reading
from mc_nested.live.motion.locomotion import SPRINT_WINDOW_S, Locomotion
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseFrame, PoseObserver
from mc_nested.live.motion.walk_tracker import CoastingState
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import Profile, WalkTable
from tests.live.fake_game import FakeGame, FakeKeyboard, FakeScreen, connection_to, devices_of

PROFILE = Profile(arena=Arena.around((14, 64, 0), "south"))
AT_REST = CoastingState(GroundVector(7.0, 7.0), GroundVector(0.0, 0.0))
TICK = 0.05


class LateGame(FakeGame):
    """A game whose steps are on the screen 28 ms after their tick."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.steps = [(0.0, self.xyz)]

    def _walk(self) -> None:
        super()._walk()
        self.steps.append((self._next_tick, self.xyz))

    def read(self) -> Reading:
        super().read()
        shown_at = self.clock.now() - PROFILE.walk.capture_latency_s
        x, y, z = next(xyz for tick, xyz in reversed(self.steps) if tick <= shown_at)
        return Reading((round(x, 3), y, round(z, 3)), self.yaw, self.pitch)


class Walk:
    """An agent in the middle of cell (7, 7) of the arena above."""

    def __init__(self, profile: Profile = PROFILE, phase: float = 0.02) -> None:
        self.game = LateGame(profile, xyz=(7.5, 64.0, 7.5), yaw=0.0, pitch=65.0, phase=phase)
        self.connection = connection_to(self.game)
        self.observer = PoseObserver(profile, self.connection, PoseFrame.of_arena(profile))
        self.locomotion = Locomotion(profile, self.connection, self.observer)

    def know_ticks(self) -> None:
        """Let the observer know the game's tick phase."""
        for count in range(20):
            seen = 100.0 + self.game.phase + count * TICK + PROFILE.walk.capture_latency_s
            self.observer.tick_phase.saw_step(seen, seen)
        self.game.clock.time += 2.0

    def walk(self, right: float, forward: float) -> tuple[CoastingState, PoseEstimate]:
        self.observer.look()
        self.observer.permit_press()
        return self.locomotion.follow_to_end(self.locomotion.walk(AT_REST, GroundVector(right, forward)))

    def end(self) -> tuple[float, float]:
        """Return where the agent is once it has stopped."""
        self.game.clock.time += 1.0
        self.game.read()
        return PROFILE.marked_arena().position_of(self.game.xyz)


@pytest.mark.parametrize(
    ("right", "forward", "key"),
    [(1.0, 0.2, "d"), (-1.0, 0.2, "a"), (0.2, 1.0, "w"), (0.2, -1.0, "s"), (1.0, 1.0, "w")],
)
def test_the_axis_with_the_larger_offset_is_walked(right: float, forward: float, key: str) -> None:
    walk = Walk()
    state, _ = walk.walk(right, forward)
    assert walk.game.presses == [key]
    assert state.end == pytest.approx(walk.end(), abs=0.005)


@given(st.sampled_from([1, 2, 3, 5, 8]), st.floats(0.0, 0.049), st.floats(0.0, 0.05))
def test_a_hold_is_felt_for_exactly_its_ticks_once_the_tick_phase_is_known(
    ticks: int, phase: float, later: float
) -> None:
    walk = Walk(phase=phase)
    walk.know_ticks()
    walk.game.clock.time += later
    walk.locomotion.set_coasting(CoastingState(walk.observer.look().position, AT_REST.velocity))
    walk.walk(displacement(ticks), 0.0)
    assert walk.end() == pytest.approx((7.0 + displacement(ticks), 7.0), abs=0.001)


def test_locomotion_sneaks_an_offset_that_no_walking_hold_meets() -> None:
    walk = Walk(PROFILE.model_copy(update={"walk": WalkTable(covered=(0.5, 1.0, 1.5, 2.0))}))
    walk.walk(0.0, 0.24)
    assert walk.game.presses == ["left.shift", "w"]


def test_the_agents_end_is_known_before_it_stands_still() -> None:
    walk = Walk()
    state, pose = walk.walk(1.0, 0.0)
    assert pose.position.right < state.end.right - 0.01
    assert walk.locomotion.coasting_at(state.position) == state
    assert walk.locomotion.end_if_late == pytest.approx(state.end)


def test_a_holds_latest_end_is_one_tick_farther_while_it_lasts() -> None:
    walk = Walk()
    latest: list[GroundVector] = []
    walk.observer.look()
    walk.observer.permit_press()
    pose = walk.locomotion.walk(AT_REST, GroundVector(1.0, 0.0))
    walk.locomotion.follow_to_end(pose, lambda _: latest.append(walk.locomotion.end_if_late))
    assert latest[0] == pytest.approx((7.0 + displacement(6), 7.0), abs=0.005)


class CountingKeyboard(FakeKeyboard):
    """Counts releases."""

    releases = 0

    def release(self, key: str) -> None:
        self.releases += 1
        super().release(key)


def test_an_agent_that_never_stops_is_an_error_after_repeated_releases() -> None:
    game = FakeGame(PROFILE, xyz=(7.5, 64.0, 7.5), yaw=0.0, pitch=65.0)
    keyboard = CountingKeyboard(game)
    devices = devices_of(game, keyboard)
    drift = FakeScreen(game, lambda: Reading((7.5, 64.0, game.clock.now() % 15), 0.0, 65.0))
    connection = GameConnection(devices, InputController(devices, PROFILE.input), drift)
    observer = PoseObserver(PROFILE, connection, PoseFrame.of_arena(PROFILE))
    pose = observer.look()
    observer.permit_press()
    connection.controller.hold("w", 1)
    began, before = game.clock.now(), keyboard.releases
    with pytest.raises(NotConfirmedError, match="does not stand still"):
        Locomotion(PROFILE, connection, observer).follow_to_end(pose)
    assert game.clock.now() - began == pytest.approx(PROFILE.body.patience_s, abs=0.02)
    # Every 20th look, and all but the first three come a frame apart.
    assert keyboard.releases - before == (5 * 60 + 1) // 20


def test_an_agent_whose_position_fits_no_path_is_watched_until_it_stands_still() -> None:
    walk = Walk()
    walk.locomotion.set_coasting(CoastingState(walk.observer.look().position, AT_REST.velocity))
    walk.game.xyz = (7.3, 64.0, 7.5)
    walk.game.steps.append((walk.game.clock.now(), walk.game.xyz))
    walk.game.clock.time += 0.1
    began = walk.game.clock.now()
    state, _ = walk.locomotion.follow_to_end(walk.observer.look())
    assert state.end == pytest.approx((7.2, 7.0))
    assert walk.game.clock.now() - began == pytest.approx(1.0, abs=0.03)


def test_a_late_press_delays_the_release_so_that_the_hold_keeps_its_ticks() -> None:
    walk = Walk()
    walk.know_ticks()
    walk.locomotion.set_coasting(CoastingState(walk.observer.look().position, AT_REST.velocity))
    walk.game.late_from, walk.game.late_until = walk.game.clock.now(), walk.game.clock.now() + 0.05
    walk.walk(displacement(5), 0.0)
    assert walk.end() == pytest.approx((7.0 + displacement(5), 7.0), abs=0.001)


class ForgetfulKeyboard(FakeKeyboard):
    """Loses the first presses of movement keys, and notes when each key went down, and for how many ticks."""

    def __init__(self, game: FakeGame, lost: int) -> None:
        super().__init__(game)
        self._game, self._lost = game, lost
        self._down: dict[str, float] = {}
        self.held: list[tuple[str, int]] = []
        self.pressed: list[float] = []

    def press(self, key: str) -> None:
        self._down[key] = self._game.clock.now()
        self.pressed.append(self._game.clock.now())
        if self._lost:
            self._lost -= 1
        else:
            super().press(key)

    def release(self, key: str) -> None:
        if key in self._down:
            self.held.append((key, round((self._game.clock.now() - self._down.pop(key)) / TICK)))
        super().release(key)


def forgetful(lost: int) -> tuple[Walk, ForgetfulKeyboard]:
    """Return an agent whose first presses are lost."""
    walk = Walk()
    keyboard = ForgetfulKeyboard(walk.game, lost)
    devices = devices_of(walk.game, keyboard)
    walk.connection = GameConnection(devices, InputController(devices, PROFILE.input), FakeScreen(walk.game))
    walk.observer = PoseObserver(PROFILE, walk.connection, PoseFrame.of_arena(PROFILE))
    walk.locomotion = Locomotion(PROFILE, walk.connection, walk.observer)
    return walk, keyboard


def test_holds_that_are_not_felt_make_the_next_ones_longer() -> None:
    walk, keyboard = forgetful(3)
    for _ in range(4):
        state, _ = walk.walk(displacement(1), 0.0)
    assert keyboard.held == [("d", 1), ("d", 2), ("d", 3), ("d", 4)]
    assert state.end.right == pytest.approx(7.0 + displacement(4), abs=0.005)
    keyboard.held.clear()
    walk.locomotion.walk(state, GroundVector(-displacement(1), 0.0))
    assert keyboard.held == [("a", 1)]


def test_a_teleport_resets_the_length_of_the_next_hold() -> None:
    walk, keyboard = forgetful(1)
    walk.walk(displacement(1), 0.0)
    walk.locomotion.set_coasting(CoastingState(walk.observer.look().position, AT_REST.velocity))
    walk.walk(displacement(1), 0.0)
    assert keyboard.held == [("d", 1), ("d", 1)]


def test_the_agent_sneaks_after_a_short_hold_that_led_too_far() -> None:
    walk = Walk()
    walk.locomotion.set_coasting(CoastingState(walk.observer.look().position, AT_REST.velocity))
    walk.game.late_from, walk.game.late_until = walk.game.clock.now() + 0.04, walk.game.clock.now() + 0.14
    state, _ = walk.walk(displacement(1), 0.0)
    assert state.end.right > 7.0 + displacement(2)
    walk.observer.permit_press()
    walk.locomotion.follow_to_end(walk.locomotion.walk(state, GroundVector(7.0 + displacement(1) - state.end.right, 0)))
    assert walk.game.presses == ["d", "left.shift", "a"]


def test_only_the_forward_key_waits_for_the_sprint_window_before_a_second_press() -> None:
    walk, keyboard = forgetful(0)
    for forward in (displacement(1), displacement(1), -displacement(1), -displacement(1)):
        walk.observer.look()
        walk.observer.permit_press()
        walk.locomotion.walk(AT_REST, GroundVector(0.0, forward))
    first, second, *others = keyboard.pressed
    assert second - first > SPRINT_WINDOW_S
    assert others[1] - others[0] < SPRINT_WINDOW_S / 2
