"""PoseObserver: what a look says, which looks it spares, and which steps it takes as sightings of a tick.

PoseReader: the first readable pose, and bounded patience with a screen that can't be read.

TickPhase: found from sightings that are late by chance, and not found in a game without ticks.
"""

import random
from collections.abc import Callable

import pytest

from mc_nested.errors import NotConfirmedError, NotInFrontError, UnreadableError, WrongScreenError
from mc_nested.live.input.input_controller import FRESH_S
from mc_nested.live.model.reading import Reading, Target, WorldPose
from mc_nested.live.model.timing import EARLY_LOOK_S, FRAME_S
from mc_nested.live.motion.pose_observer import ENOUGH, PoseFrame, PoseObserver, PoseReader, TickPhase, check_pose
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import Profile
from tests.live.fake_game import FakeGame, FakeScreen, connection_to

PROFILE = Profile(arena=Arena.around((14, 64, 0), "south"))
"""Cell (x, y) of this arena has its middle at (14.5 - x, 64, 0.5 + y), looked at with yaw 0 and pitch 65."""


class Steps(TickPhase):
    """Records the steps that it is given."""

    def __init__(self) -> None:
        super().__init__()
        self.seen: list[tuple[float, float]] = []

    def saw_step(self, since: float, at: float) -> None:
        self.seen.append((since, at))


class Observed:
    """An observer of one reading that a test changes, with a count of the looks at the screen."""

    def __init__(self) -> None:
        self.game = FakeGame(PROFILE)
        self.reading = Reading((7.5, 64.0, 7.5), 0.0, 65.0, Target((7, 63, 8), "stone"))
        self.looks = 0
        self.connection = connection_to(self.game, FakeScreen(self.game, self._read))
        self.observer = PoseObserver(PROFILE, self.connection, PoseFrame.of_arena(PROFILE))
        self.steps = self.observer.tick_phase = Steps()

    def _read(self) -> Reading:
        self.looks += 1
        return self.reading

    def pass_time(self, seconds: float) -> float:
        self.game.clock.time += seconds
        return self.game.clock.time

    def walk_to(self, z: float) -> None:
        self.reading = Reading((7.5, 64.0, z), 0.0, 65.0)


@pytest.fixture
def observed() -> Observed:
    return Observed()


def test_a_look_gives_the_position_in_cells_and_the_block_looked_at(observed: Observed) -> None:
    observed.reading = Reading((7.25, 64.0, 8.5), 0.0, 65.0, Target((7, 63, 9), "stone"))
    pose = observed.observer.look_and_check()
    assert (pose.position, pose.cell, pose.target) == ((7.25, 8.0), (7, 8), Target((7, 63, 9), "stone"))
    assert str(pose) == "(7.25, 8.00)"


def test_the_screen_is_read_once_within_one_frame(observed: Observed) -> None:
    observed.observer.look()
    observed.pass_time(0.004)
    observed.observer.look()
    assert observed.looks == 1
    observed.pass_time(0.002)
    observed.observer.look()
    assert observed.looks == 2


@pytest.mark.parametrize(
    ("xyz", "yaw", "pitch", "problem"),
    [
        ((7.5, 64.04, 7.5), 0.5, 64.5, None),
        ((7.5, 64.0, 7.5), 359.6, 65.5, None),
        ((7.5, 64.0, 7.5), 0.6, 65.0, "the view is 0.6 / 65, not 0 / 65"),
        ((7.5, 64.0, 7.5), 0.0, 65.6, "the view is 0 / 65.6, not 0 / 65"),
        ((7.5, 64.0, 7.5), 0.0, 64.4, "the view is 0 / 64.4, not 0 / 65"),
        ((7.5, 63.94, 7.5), 0.0, 65.0, "the feet are at y = 63.94, not 64 (the floor must be level, auto-jump off)"),
    ],
)
def test_a_turned_view_or_another_height_is_a_problem(
    xyz: tuple[float, float, float], yaw: float, pitch: float, problem: str | None, observed: Observed
) -> None:
    observed.reading = Reading(xyz, yaw, pitch)
    pose = observed.observer.look()
    assert pose.problem == problem
    if problem:
        with pytest.raises(NotConfirmedError, match="leave mouse and keys alone"):
            check_pose(pose)
    else:
        assert check_pose(pose) is pose


@pytest.mark.parametrize(
    "reading", [Reading(None, 0.0, 65.0), Reading((7.5, 64.0, 7.5), None, 65.0), Reading((7.5, 64.0, 7.5), 0.0, None)]
)
def test_an_incomplete_reading_is_an_error_after_5_s(reading: Reading, observed: Observed) -> None:
    observed.reading = reading
    began = observed.game.clock.now()
    with pytest.raises(UnreadableError, match="unreadable for 5 s: it shows no Facing line"):
        observed.observer.look()
    assert observed.game.clock.now() - began == pytest.approx(5.0, abs=FRAME_S)


def test_a_step_between_two_looks_a_frame_apart_is_counted(observed: Observed) -> None:
    observed.observer.look()
    since = observed.game.clock.now()
    at = observed.pass_time(FRAME_S)
    observed.walk_to(7.6)
    observed.observer.look()
    observed.pass_time(FRAME_S)
    observed.observer.look()
    assert observed.steps.seen == [(since, at)]


def test_a_step_after_a_longer_time_or_an_unreadable_frame_is_not_counted(observed: Observed) -> None:
    observed.observer.look()
    observed.pass_time(1.6 * FRAME_S)
    observed.walk_to(7.6)
    observed.observer.look()
    readings = iter([Reading(problem="covered"), Reading((7.5, 64.0, 7.7), 0.0, 65.0)])
    screen = FakeScreen(observed.game, lambda: next(readings, None))
    observer = PoseObserver(PROFILE, connection_to(observed.game, screen), PoseFrame.of_arena(PROFILE))
    observer.tick_phase = observed.steps
    observer.look()
    assert observed.steps.seen == []


def test_an_awaited_step_seen_by_the_first_look_counts_as_unseen_a_frame_before(observed: Observed) -> None:
    tick = observed.game.clock.now()
    observed.observer.wait_for_step(tick)
    observed.observer.look()
    observed.observer.note_awaited_step()
    at = tick + 0.028 - EARLY_LOOK_S
    assert observed.steps.seen == [pytest.approx((at - FRAME_S, at))]


def test_an_awaited_step_seen_only_by_a_later_look_is_not_counted(observed: Observed) -> None:
    observed.observer.note_awaited_step()
    observed.observer.wait_for_step(observed.game.clock.now())
    observed.pass_time(FRAME_S)
    observed.observer.look()
    observed.observer.note_awaited_step()
    assert observed.steps.seen == []


def test_watch_ends_when_its_condition_holds_or_its_time_is_over(observed: Observed) -> None:
    began = observed.game.clock.now()

    def after(seconds: float) -> Callable[[object], bool]:
        return lambda _: observed.game.clock.now() >= began + seconds

    observed.observer.watch(after(0.1), 1.0)
    assert observed.game.clock.now() - began == pytest.approx(0.1, abs=FRAME_S)
    observed.observer.watch(after(9.0), 1.0)
    assert observed.game.clock.now() - began == pytest.approx(1.1, abs=2 * FRAME_S)


def test_read_position_gives_the_position_or_none_if_unreadable(observed: Observed) -> None:
    assert observed.observer.read_position() == (7.0, 7.0)
    observed.reading = Reading(problem="covered")
    assert observed.observer.read_position() is None


def test_a_press_is_permitted_only_while_the_chat_is_closed(observed: Observed) -> None:
    with pytest.raises(WrongScreenError):
        observed.connection.controller.click("right")
    observed.observer.permit_press()
    observed.connection.controller.click("right")
    assert observed.game.presses == ["right button"]
    observed.game.send(PROFILE.keys.chat, is_down=True)
    observed.pass_time(0.1)
    observed.observer.permit_press()
    with pytest.raises(WrongScreenError, match="close the chat"):
        observed.connection.controller.click("right")
    assert observed.game.presses == ["right button", PROFILE.keys.chat]


def test_a_press_long_after_the_look_looks_again(observed: Observed) -> None:
    observed.observer.look()
    observed.observer.permit_press()
    observed.pass_time(FRESH_S + 0.01)
    before = observed.looks
    observed.connection.controller.click("right")
    assert observed.looks == before + 1
    assert observed.game.presses == ["right button"]


def test_a_press_is_refused_if_the_second_look_shows_a_changed_pose(observed: Observed) -> None:
    observed.observer.look()
    observed.observer.permit_press(lambda pose: pose.position.forward < 7.5)
    observed.walk_to(8.5)
    observed.pass_time(FRESH_S + 0.01)
    with pytest.raises(NotConfirmedError, match=r"the agent is at \(7\.00, 8\.00\) now"):
        observed.connection.controller.click("right")
    observed.observer.permit_press()
    observed.reading = Reading((7.5, 64.0, 7.5), 20.0, 65.0)
    observed.pass_time(FRESH_S + 0.01)
    with pytest.raises(NotConfirmedError, match="the view is 20 / 65"):
        observed.connection.controller.click("right")
    assert observed.game.presses == []


def test_a_frame_around_a_pose_measures_from_there_and_expects_its_view_and_height() -> None:
    frame = PoseFrame.around(WorldPose((10.5, 70.0, -3.5), 90.0, 20.0))
    # Yaw 90 looks west, which is -X; right of it is north, which is -Z.
    assert frame.position_of((9.5, 70.0, -5.5)) == pytest.approx((2.0, 1.0))
    assert frame.problem(WorldPose((0.0, 70.04, 0.0), 90.4, 20.4)) is None
    assert frame.problem(WorldPose((0.0, 70.0, 0.0), 91.0, 20.0)) == "the view is 91 / 20, not 90 / 20"


READABLE = Reading((7.5, 64.0, 7.5), 90.0, 20.0, Target((7, 63, 8), "stone"))


def _reader(game: FakeGame, *readings: Reading) -> PoseReader:
    coming = iter(readings)
    return PoseReader(connection_to(game, FakeScreen(game, lambda: next(coming, None))), 5.0)


def test_a_readable_frame_gives_its_pose_its_target_and_its_time() -> None:
    game = FakeGame(Profile())
    reader = _reader(game, READABLE)
    began = game.clock.now()
    assert reader.read() == (began, WorldPose((7.5, 64.0, 7.5), 90.0, 20.0), Target((7, 63, 8), "stone"))
    assert not reader.is_delayed


def test_unreadable_frames_are_waited_out_a_frame_at_a_time() -> None:
    game = FakeGame(Profile())
    reader = _reader(game, *[Reading(problem="covered")] * 3, READABLE, READABLE)
    began = game.clock.now()
    assert reader.read()[0] - began == pytest.approx(3 * FRAME_S)
    assert reader.is_delayed
    reader.read()
    assert not reader.is_delayed


@pytest.mark.parametrize(
    ("missing", "reason"),
    [
        (Reading(None, 0.0, 65.0, problem="chat covers it"), "chat covers it"),
        (Reading((7.5, 64.0, 7.5), None, 65.0), "it shows no Facing line"),
        (Reading((7.5, 64.0, 7.5), 0.0, None), "it shows no Facing line"),
    ],
)
def test_reading_a_pose_fails_after_5_s_if_a_part_stays_missing(missing: Reading, reason: str) -> None:
    game = FakeGame(Profile())
    began = game.clock.now()
    with pytest.raises(UnreadableError, match=f"unreadable for 5 s: {reason}"):
        _reader(game, *[missing] * 1000).read()
    assert game.clock.now() - began == pytest.approx(5.0, abs=FRAME_S)


def test_a_window_in_front_of_the_game_is_an_error_at_once() -> None:
    game = FakeGame(Profile())
    game.front_until = game.clock.now()
    with pytest.raises(NotInFrontError):
        _reader(game, Reading(problem="covered")).read()


TICK = 0.05


def _sightings(count: int, phase: float, seed: int) -> list[float]:
    """Return when steps are seen first: half a frame and 10 to 30 ms behind ticks."""
    rng = random.Random(seed)  # noqa: S311 - chance, not secrets
    return [
        100 + phase + TICK * rng.randrange(2000) + rng.uniform(0, 1 / 60) + rng.uniform(0.01, 0.03)
        for _ in range(count)
    ]


@pytest.mark.parametrize("phase", [0.0, 0.013, 0.031, 0.049])
@pytest.mark.parametrize("seed", range(5))
def test_ticks_are_known_to_a_few_milliseconds_after_some_steps(phase: float, seed: int) -> None:
    tick_phase = TickPhase()
    for seen in _sightings(40, phase, seed):
        tick_phase.saw_step(seen - 0.004, seen + 0.004)
    assert tick_phase.is_known
    off = (tick_phase.next(500.0) - phase + TICK / 2) % TICK - TICK / 2
    assert abs(off) < 0.008


def test_the_tick_phase_is_unknown_after_few_sightings() -> None:
    tick_phase = TickPhase()
    for seen in _sightings(int(ENOUGH) - 1, 0.01, 0):
        tick_phase.saw_step(seen, seen)
    assert not tick_phase.is_known


def test_steps_at_random_times_give_no_tick_phase() -> None:
    tick_phase, rng = TickPhase(), random.Random(1)  # noqa: S311
    for _ in range(60):
        seen = rng.uniform(0, 100)
        tick_phase.saw_step(seen, seen)
    assert not tick_phase.is_known


def test_the_next_tick_is_never_in_the_past() -> None:
    tick_phase = TickPhase()
    for seen in _sightings(20, 0.02, 2):
        tick_phase.saw_step(seen, seen)
    first = tick_phase.next(7.0, 0.0125)
    assert 7.0 <= first < 7.05
    assert tick_phase.next(first + 0.001, 0.0125) == pytest.approx(first + TICK)
