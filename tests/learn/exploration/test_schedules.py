"""ε by hand: linear from the start to the floor over its share of the episodes, then flat."""

import numpy as np
import pytest

from mc_nested.learn.exploration.schedules import EXCURSIONS_ONLY, NEVER, decays_of, epsilon_after
from mc_nested.learn.preset import Exploration, load_preset

MAIN, NESTED = Exploration(start=1.0, floor=0.01, share=0.18), Exploration(start=1.0, floor=0.001, share=0.6)


@pytest.mark.parametrize(
    ("done", "epsilon"), [(0, 1.0), (900, 1.0 - 0.999 * 0.5), (1800, 0.001), (1801, 0.001), (3000, 0.001)]
)
def test_the_nested_agents_epsilon_reaches_its_floor_after_60_percent(done: int, epsilon: float) -> None:
    assert epsilon_after(np.array([done]), 3000, NESTED) == pytest.approx(epsilon)


def test_the_main_agents_epsilon_falls_faster_and_stays_higher() -> None:
    done = np.arange(3001)
    main, nested = epsilon_after(done, 3000, MAIN), epsilon_after(done, 3000, NESTED)
    assert (main[1:1700] < nested[1:1700]).all()
    assert (main[1800:] > nested[1800:]).all()
    assert main[540] == pytest.approx(0.01)


def test_epsilon_decays_come_from_the_preset_or_from_its_exploration() -> None:
    main, nested = decays_of(load_preset("paper"))
    assert (main, nested) == (MAIN, NESTED)
    assert decays_of(load_preset("model-based")) == (NEVER, NEVER)
    assert decays_of(load_preset("tuned"))[1] == EXCURSIONS_ONLY
