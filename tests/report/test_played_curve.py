"""The curve of real episodes, in the order they were played: a point for each, in two panels."""

from pathlib import Path

import cv2
import pytest
from matplotlib.colors import to_rgb

from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.report.curve import EVALUATED, draw_played_curve, played_by


def test_an_evaluation_follows_the_episode_of_its_number_and_takes_game_time() -> None:
    episodes = [EpisodeRow(0, number, float(number), 0, 60, 0.0, 0.0) for number in (1, 2)]
    episodes.append(EpisodeRow(1, 1, 7.0, 0, 10, 0.0, 0.0))
    evaluations = [EvaluationRow(0, 0, -1.0, 0, 10), EvaluationRow(0, 1, 21.0, 0, 20)]
    one, other = played_by(episodes, evaluations, 2)
    assert one.scores.tolist() == [-1.0, 1.0, 21.0, 2.0]
    assert one.greedy.tolist() == [True, False, True, False]
    # 10, 60, 20 and 60 actions of 0.35 s, each after a reset of 1.5 s.
    assert one.minutes * 60 == pytest.approx([5.0, 27.5, 36.0, 58.5])
    assert (other.scores.tolist(), other.greedy.tolist()) == ([7.0], [False])


def test_a_trial_without_episodes_has_an_empty_curve() -> None:
    (none,) = played_by([], [], 1)
    assert (none.scores.shape, none.greedy.shape, none.minutes.shape) == ((0,), (0,), (0,))


def evaluated_area(path: Path) -> int:
    picture = cv2.imread(str(path))
    assert picture is not None
    assert picture.shape == (840, 960, 3)
    wanted = [round(255 * part) for part in reversed(to_rgb(EVALUATED))]
    return int((picture == wanted).all(axis=2).sum())


@pytest.mark.parametrize("trials", [1, 3])
def test_every_evaluation_is_a_point_in_both_panels(tmp_path: Path, trials: int) -> None:
    episodes = [EpisodeRow(trial, at, at - 5.0, 0, 60, 0.0, 0.0) for trial in range(trials) for at in range(1, 9)]
    none = played_by(episodes, [], trials)
    draw_played_curve(tmp_path / "none.png", "line", none, 21.0)
    without = evaluated_area(tmp_path / "none.png")  # the legend's
    areas = []
    for count in (1, 2):
        evaluations = [EvaluationRow(0, 3 + 4 * at, 18.0, 0, 60) for at in range(count)]
        draw_played_curve(tmp_path / "curve.png", "line", played_by(episodes, evaluations, trials), 21.0)
        areas.append(evaluated_area(tmp_path / "curve.png") - without)
    # Two points each, one in each panel, about as large as the one in the legend.
    assert areas[0] == pytest.approx(2 * without, rel=0.2)
    assert areas[1] == pytest.approx(2 * areas[0], rel=0.1)


def test_a_curve_is_drawn_before_the_first_episode(tmp_path: Path) -> None:
    draw_played_curve(tmp_path / "curve.png", "a $ in a name", played_by([], [], 1), 21.0)
    assert evaluated_area(tmp_path / "curve.png") > 0
