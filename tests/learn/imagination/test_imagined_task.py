"""What table and networks have in common: a state's index, what is wasted, and how ε is drawn."""

import numpy as np
import pytest

from mc_nested.learn.imagination.arena_step import NOWHERE, index_of
from mc_nested.learn.imagination.imagined_task import ImaginedTask, epsilon_from, is_wasted, state_at
from tests.learn.imagination.made_games import BENT
from tests.learn.imagination.made_practice import arena_of


def test_a_state_is_its_cell_its_blocks_and_what_is_appended() -> None:
    arena = arena_of()
    task = ImaginedTask(index_of(BENT.start, arena), 3, 14, 3.0, np.array([20, 4, 1]), 1000)
    assert state_at(index_of((3, 2), arena), 2, arena, task) == 3 * 20 + 2 * 4 + 2 + 1000


def test_only_a_block_where_nothing_is_paid_is_wasted() -> None:
    arena = arena_of()
    assert is_wasted(index_of((0, 1), arena), arena)
    assert not is_wasted(index_of((2, 3), arena), arena)
    assert not is_wasted(NOWHERE, arena)


def test_epsilons_are_equally_likely_on_a_logarithmic_scale() -> None:
    assert epsilon_from(0.0, 1.0, 0.01) == pytest.approx(0.01)
    assert epsilon_from(0.5, 1.0, 0.01) == pytest.approx(0.1)
    assert epsilon_from(0.25, 0.3, 0.3) == pytest.approx(0.3)
