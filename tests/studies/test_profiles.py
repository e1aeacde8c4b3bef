"""Interquartile means, profiles and their intervals: rliable's, of numbers that may be infinite."""

import numpy as np
import pytest
from scipy import stats

from mc_nested.studies.profiles import (
    PlayedDesigns,
    interquartile_mean,
    measures_of,
    played_designs,
    profile,
    profile_band,
    resamples,
)
from tests.studies.made_benchmark import made_benchmark

INF = np.inf


def trials(played: list[list[float]], kinds: list[str], without: float = 10.0) -> PlayedDesigns:
    return PlayedDesigns(np.array(played), np.full(len(played), without), kinds)


@pytest.mark.parametrize("count", [1, 3, 4, 7, 100])
def test_an_interquartile_mean_is_the_mean_without_a_quarter_at_either_end(count: int) -> None:
    played = np.random.default_rng(count).exponential(50, size=(count, 1))
    assert interquartile_mean(played) == pytest.approx(stats.trim_mean(played, 0.25, axis=None))


def test_unsolved_trials_count_as_infinite_and_are_left_out_up_to_a_quarter() -> None:
    assert interquartile_mean(np.array([[1.0], [2.0], [4.0], [INF]])) == 3.0
    assert interquartile_mean(np.array([[1.0], [2.0], [INF], [INF]])) == INF


def test_a_profile_is_the_share_of_trials_solved_within_each_number_of_episodes() -> None:
    played = np.array([[5.0, 7.0], [7.0, INF]])
    assert profile(played, np.array([4, 5, 6, 7, 1000])).tolist() == [0, 0.25, 0.25, 0.75, 0.75]


def test_resamples_draw_designs_within_their_kind_and_trials_within_their_design() -> None:
    own = trials([[1, 2], [3, 4], [50, 60], [70, 80], [90, 95]], ["edge", "edge", "corner", "corner", "corner"])
    drawn = [own.played[indices] for indices in resamples(own)]
    assert {each.shape for each in drawn} == {(5, 2)}
    assert all((each[:2] < 10).all() and (each[2:] > 10).all() for each in drawn)
    # Rows of one design each, which come with either trial twice and with designs twice.
    assert {tuple(each[0]) for each in drawn} == {(a, b) for pair in ((1, 2), (3, 4)) for a in pair for b in pair}
    assert any((each[2] == each[3]).all() for each in drawn)
    again = [own.played[indices] for indices in resamples(own)]
    assert all((one == other).all() for one, other in zip(drawn, again, strict=True))


def test_one_design_has_no_interval() -> None:
    own = trials([[3.0, 4.0]], ["edge"])
    assert measures_of(own).interval is None
    assert profile_band(own, np.array([1])) is None


def test_an_interval_surrounds_its_mean_and_is_narrower_with_more_designs() -> None:
    random = np.random.default_rng(0)
    widths = []
    for designs in (12, 300):
        played = random.exponential(50, size=(designs, 1))
        found = measures_of(PlayedDesigns(played, np.full(designs, 10.0), ["edge"] * designs))
        assert found.interval
        assert found.interval.low < found.mean < found.interval.high
        widths.append(found.interval.high - found.interval.low)
    assert widths[1] < widths[0] / 2


def test_measures_of_four_trials_are_right_in_numbers_and_words() -> None:
    found = measures_of(trials([[4.0], [20.0], [21.0], [INF]], ["edge"] * 4))
    assert (found.trials, found.solved, found.median, found.mean, found.worst) == (4, 3, 20.5, 20.5, INF)
    assert found.within_twice == 0.5
    assert found.interval
    assert found.interval.high == INF
    cells = [cell for _, cell in found.in_words()]
    assert cells[:2] == ["3 of 4", "20.5"]
    assert cells[2].endswith("to ∞)")
    assert cells[3:] == ["∞", "10", "50 %"]


def test_a_share_of_97_6_percent_is_not_rounded_up() -> None:
    played = [[5.0]] * 976 + [[INF]] * 24
    assert measures_of(trials(played, ["edge"] * 1000)).in_words()[-1] == ("within twice that", "97.6 %")


def test_no_interval_is_shown_without_any_finite_resample() -> None:
    assert measures_of(trials([[INF], [INF]], ["edge"] * 2)).in_words()[2] == ("interquartile mean (95 %)", "∞")


def test_within_twice_uses_each_designs_own_number_without_a_prior() -> None:
    own = PlayedDesigns(np.array([[30.0], [30.0]]), np.array([14.0, 15.0]), ["edge", "edge"])
    assert measures_of(own).within_twice == 0.5


def test_played_designs_of_a_kind_hold_that_kind_alone() -> None:
    slow = [trial for trial in made_benchmark() if trial.arm.name == "nested, sl|ow"]
    every = played_designs(slow)
    assert every.played.shape == (12, 2)
    scattered = played_designs(slow, "scattered")
    assert scattered.kinds == ["scattered"] * 4
    assert (scattered.played == every.played[2::3]).all()
    assert np.isinf(every.played).any()
