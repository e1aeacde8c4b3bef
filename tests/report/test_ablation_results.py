"""What the trials of an ablation come to."""

import math

from mc_nested.report.ablation_results import measures_on
from tests.report.made_ablation import made_ablation

FOUND = {part.name: measures for part, measures in measures_on(made_ablation(), "line")}


def test_the_parts_are_in_their_order_with_their_own_trials() -> None:
    assert list(FOUND) == ["whole", "no | hope", "old"]
    assert FOUND["whole"].played.tolist() == [5, 7, 6, 9]
    assert (FOUND["whole"].solved, FOUND["whole"].median, FOUND["whole"].worst) == (4, 6.5, 9)
    assert FOUND["whole"].updates == 1500


def test_a_trial_that_was_never_at_the_optimum_counts_as_infinite() -> None:
    hopeless = FOUND["no | hope"]
    assert (hopeless.solved, hopeless.median, hopeless.worst) == (1, math.inf, math.inf)
    assert hopeless.best_score == 21.0


def test_the_interval_of_a_median_holds_it_and_lies_within_the_trials() -> None:
    interval = FOUND["old"].interval
    assert interval is not None
    assert 30 <= interval.low <= FOUND["old"].median <= interval.high <= 200
    hopeless = FOUND["no | hope"].interval
    assert hopeless is not None
    assert hopeless.high == math.inf
