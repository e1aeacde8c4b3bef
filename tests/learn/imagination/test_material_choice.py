"""The main agent's imagined scores: what a material brought, optimism for one never tried, and learning them."""

import numpy as np
import pytest

from mc_nested.arrays import Float64s
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.imagination.material_choice import CLOSE, LAST, learn_choice, scores_of_materials
from mc_nested.learn.learner import Learner
from tests.learn.imagination.made_games import BENT, SMALL

START = np.array(BENT.start_state)


def brought(*extras: tuple[int, float], paid: int = 1) -> Float64s:
    """Return what materials brought, in episodes in which so many blocks were paid."""
    return np.array([(*each, paid) for each in extras], dtype=np.float64).reshape(len(extras), 3)


def main_of(runs: int) -> Learner:
    main = Agent(AGENT_SPECS["nested"], [BENT] * runs, SMALL, 0).main
    assert main is not None
    return main


def test_before_the_first_episode_all_materials_are_worth_the_same() -> None:
    # The most that 3 blocks bring, 2.4, and 3 blocks more.
    assert scores_of_materials(brought(), 2, 3, 2.4).tolist() == [5.4, 5.4]


def test_an_untried_material_is_worth_all_blocks_more_than_the_best() -> None:
    assert scores_of_materials(brought((0, -5.0)), 2, 3, 3.0).tolist() == [-2.0, 1.0]
    assert scores_of_materials(brought((1, 10.0)), 3, 4, 4.0).tolist() == [18.0, 14.0, 18.0]


def test_the_material_that_brought_most_is_the_best_once_all_were_tried() -> None:
    assert scores_of_materials(brought((0, -5.0), (1, 10.0)), 2, 3, 3.0).tolist() == [-2.0, 13.0]


def test_a_materials_score_is_the_mean_of_its_last_three_episodes() -> None:
    assert LAST == 3
    extras = brought((1, 90.0), (1, 1.0), (0, -5.0), (1, 2.0), (1, 6.0))
    assert scores_of_materials(extras, 2, 3, 0.0).tolist() == [-5.0, 3.0]


def test_a_material_is_tried_again_once_a_whole_design_was_built_twice() -> None:
    short, whole = brought((0, 2.0), (1, 10.0)), brought((1, 10.0), paid=3)
    assert scores_of_materials(np.vstack((short, whole)), 2, 3, 3.0).tolist() == [5.0, 13.0], "once may be by chance"
    twice = np.vstack((short, whole, whole))
    assert scores_of_materials(twice, 2, 3, 3.0).tolist() == [16.0, 13.0]
    missed = np.vstack((twice, brought((0, 4.0), paid=2)))
    assert scores_of_materials(missed, 2, 3, 3.0).tolist() == [7.0, 13.0], "once is enough, whatever it built"


def test_of_a_material_the_episodes_count_in_which_all_blocks_were_paid() -> None:
    whole, short = brought((1, 10.0), (1, 10.0), (0, 6.0), paid=3), brought((0, 2.0), (0, 2.0))
    assert scores_of_materials(np.vstack((whole, short)), 2, 3, 3.0).tolist() == [9.0, 13.0]


@pytest.mark.parametrize("scores", [(-2.0, 13.0), (13.0, -2.0), (5.4, 5.4), (0.0, 0.5)])
def test_the_learnt_values_are_close_to_the_scores(scores: tuple[float, ...]) -> None:
    main = main_of(1)
    learn_choice(main, 0, START, np.array(scores))
    values = main.engine.q_values(main.states.encoded(START[None]))[0]
    # The last update begins within CLOSE; it moves each value a little more.
    np.testing.assert_allclose(values, scores, atol=1.2 * CLOSE)
    if abs(scores[0] - scores[1]) > 2.4 * CLOSE:
        assert main.act(START[None], np.zeros(1), np.zeros((1, 2)))[0] == int(np.argmax(scores))


def test_learning_the_same_scores_again_takes_at_most_three_updates() -> None:
    main = main_of(1)
    scores = np.array([-2.0, 13.0])
    learn_choice(main, 0, START, scores)
    before = int(main.engine.updates[0])
    learn_choice(main, 0, START, scores)
    assert int(main.engine.updates[0]) - before <= 3


def test_a_runs_main_agent_learns_the_same_alone_and_leaves_another_runs_unchanged() -> None:
    beside, alone = main_of(2), main_of(1)
    untouched = beside.engine.online[1].copy()
    for main in (beside, alone):
        learn_choice(main, 0, START, np.array([-2.0, 13.0]))
    np.testing.assert_array_equal(beside.engine.online[1], untouched)
    np.testing.assert_array_equal(beside.engine.online[0], alone.engine.online[0])
    assert beside.engine.updates.tolist() == [alone.engine.updates[0], 0]


def test_an_untried_material_that_another_game_tries_is_worth_less_than_the_best() -> None:
    assert scores_of_materials(brought(), 3, 3, 2.4, elsewhere=[0]).tolist() == pytest.approx([-0.6, 5.4, 5.4])
    assert scores_of_materials(brought((1, 10.0)), 2, 4, 4.0, elsewhere=[0]).tolist() == [10.0, 14.0]
    assert scores_of_materials(brought((1, 10.0)), 2, 4, 4.0, elsewhere=[1]).tolist() == [18.0, 14.0]
