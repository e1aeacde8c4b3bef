"""PoseReader: the first readable pose, and bounded patience with a screen that can't be read."""

import pytest

from mc_nested.errors import NotInFrontError, UnreadableError
from mc_nested.live.model.reading import Reading, Target, WorldPose
from mc_nested.live.model.timing import FRAME_S
from mc_nested.live.motion.pose_reader import PoseReader
from mc_nested.live.profile.tables import Profile
from tests.live.fake_game import FakeGame, FakeScreen, connection_to

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
def test_a_part_that_stays_missing_is_an_error_after_the_patience(missing: Reading, reason: str) -> None:
    game = FakeGame(Profile())
    began = game.clock.now()
    with pytest.raises(UnreadableError, match=f"unreadable for 5 s: {reason}"):
        _reader(game, *[missing] * 1000).read()
    assert game.clock.now() - began == pytest.approx(5.0, abs=FRAME_S)


def test_a_window_in_front_of_the_game_is_the_reason_at_once() -> None:
    game = FakeGame(Profile())
    game.front_until = game.clock.now()
    with pytest.raises(NotInFrontError):
        _reader(game, Reading(problem="covered")).read()
