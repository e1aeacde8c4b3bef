"""The real episodes in the order they were played."""

import pytest

from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.report.played import played_by


def test_an_evaluation_comes_after_the_episode_of_its_number_and_each_takes_its_time() -> None:
    episodes = [EpisodeRow(0, number, float(number), 0, 60, 0.0, 0.0) for number in (1, 2)]
    episodes.append(EpisodeRow(1, 1, 7.0, 0, 10, 0.0, 0.0))
    evaluations = [EvaluationRow(0, 0, -1.0, 0, 10), EvaluationRow(0, 1, 21.0, 0, 20)]
    one, other = played_by(episodes, evaluations, 2)
    assert one.scores.tolist() == [-1.0, 1.0, 21.0, 2.0]
    assert one.greedy.tolist() == [True, False, True, False]
    # 10, 60, 20 and 60 actions of 0.35 s, each after a reset of 1.5 s.
    assert one.minutes * 60 == pytest.approx([5.0, 27.5, 36.0, 58.5])
    assert (other.scores.tolist(), other.greedy.tolist()) == ([7.0], [False])


def test_a_trial_without_an_episode_has_none() -> None:
    (none,) = played_by([], [], 1)
    assert (none.scores.shape, none.greedy.shape, none.minutes.shape) == ((0,), (0,), (0,))
