"""Three games that feed one learner come to the optimum in at most half the time of one, each with its own clock."""

import statistics

import pytest

from mc_nested.learn.preset import load_preset
from scripts.benches.games import Pace, scattered, until_optimum

PACE = Pace(reset_s=6.0, step_s=0.34)


@pytest.mark.slow
def test_three_games_find_scattered_designs_in_at_most_half_the_time_of_one() -> None:
    # The median over twelve designs and three seeds is 0.32: `bench.py games`.
    preset, shares = load_preset("model-based"), []
    for scenario in scattered(3):
        one, three = (until_optimum(scenario, preset, 0, games, PACE) for games in (1, 3))
        assert one.is_optimum
        assert three.is_optimum
        shares.append(three.seconds / one.seconds)
    assert statistics.median(shares) <= 0.5
