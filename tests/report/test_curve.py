"""The curve: trials aligned by hand, the interval, and a picture that can be opened."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from mc_nested.report.curve import align_trials, draw_curve, t_interval


def test_trials_are_aligned_by_episode() -> None:
    rows = [(1, 30, 4.0), (0, 30, 10.0), (0, 60, 12.0), (1, 60, 6.0)]
    episodes, scores = align_trials(rows, trials=2)
    assert episodes == [30, 60]
    assert scores.tolist() == [[10.0, 12.0], [4.0, 6.0]]


def test_a_trial_that_finished_early_keeps_its_last_score() -> None:
    rows = [(0, 30, 21.0), (1, 30, 4.0), (1, 60, 6.0), (1, 90, 21.0)]
    assert align_trials(rows, trials=2)[1].tolist() == [[21.0, 21.0, 21.0], [4.0, 6.0, 21.0]]


def test_no_scores_are_shown_before_every_trial_has_an_evaluation() -> None:
    episodes, scores = align_trials([(0, 30, 5.0)], trials=2)
    assert episodes == []
    assert scores.shape == (2, 0)


def test_the_interval_is_students_t_and_has_no_width_where_all_scores_agree() -> None:
    scores = np.array([[1.0, 5.0], [3.0, 5.0], [2.0, 5.0], [6.0, 5.0]])
    low, high = t_interval(scores)
    # Deviation sqrt(14 / 3) of four, and t with three degrees of freedom is 3.1824 at 0.975.
    assert (low[0], high[0]) == pytest.approx((3 - 3.1824 * (14 / 12) ** 0.5, 3 + 3.1824 * (14 / 12) ** 0.5), abs=1e-3)
    assert (low[1], high[1]) == (pytest.approx(5.0), pytest.approx(5.0))


def test_the_interval_reaches_about_two_standard_errors_from_the_mean() -> None:
    scores = np.random.default_rng(0).normal(0, 1, (400, 1))
    low, high = t_interval(scores)
    assert high[0] - low[0] == pytest.approx(2 * 1.96 / 20, rel=0.15)


def test_the_interval_ends_at_the_highest_score_where_most_trials_are_below_it() -> None:
    _, high = t_interval(np.array([[19.0, 5.0], [20.0, 6.0]]), highest=21.0)
    assert high[0] == 21.0
    assert 6.0 < high[1] < 21.0


def test_there_is_no_interval_where_half_of_the_trials_are_at_the_highest_score() -> None:
    low, high = t_interval(np.array([[21.0, 5.0], [19.0, 6.0]]), highest=21.0)
    assert np.isnan([low[0], high[0]]).all()
    assert np.isfinite([low[1], high[1]]).all()


@pytest.mark.parametrize("trials", [1, 5])
@pytest.mark.parametrize("evaluations", [0, 1, 20])
def test_a_curve_of_any_number_of_trials_and_evaluations_is_drawn(
    tmp_path: Path, trials: int, evaluations: int
) -> None:
    path = tmp_path / "curve.png"
    episodes = [30 * (index + 1) for index in range(evaluations)]
    draw_curve(path, "line", episodes, np.random.default_rng(0).random((trials, evaluations)) * 21, 21.0)
    picture = cv2.imread(str(path))
    assert picture is not None
    assert picture.shape == (540, 960, 3)
