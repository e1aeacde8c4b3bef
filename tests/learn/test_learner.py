"""One learner: who explores, when there are updates, and what is learnt."""

import numpy as np
import pytest

from mc_nested.learn.dqn.replay import Transitions
from mc_nested.learn.dqn.states import StateSpace
from mc_nested.learn.learner import Learner
from mc_nested.learn.preset import Imitation, Prioritized, load_preset

PAPER = load_preset("paper")


def learner(highest: list[list[int]], actions: int = 8) -> Learner:
    streams = [np.random.default_rng(run) for run in range(len(highest))]
    return Learner(StateSpace(np.array(highest), actions), PAPER, streams)


def values(learner: Learner, states: list[list[int]]) -> np.ndarray:
    return learner.engine.q_values(learner.states.encoded(np.array(states)))


def test_a_number_below_epsilon_explores_and_a_second_number_picks_the_action() -> None:
    three = learner([[14, 14, 11]] * 3)
    states = np.array([[7, 14, 11]] * 3)
    greedy = three.act(states, np.zeros(3), np.zeros((3, 2)))
    uniforms = np.array([[0.49, 0.99], [0.5, 0.99], [0.0, 0.0]])
    assert three.act(states, np.full(3, 0.5), uniforms).tolist() == [7, greedy[1], 0]
    best = values(three, states.tolist()).argmax(1)
    assert greedy.tolist() == best.tolist()


def remember(learner: Learner, rows: list[int]) -> None:
    k = len(rows)
    states, ones = np.zeros((k, 3), dtype=np.int64), np.ones(k)
    learner.store(np.array(rows), states, np.zeros(k, dtype=np.int64), ones, states, ones > 0)


def test_learning_starts_with_the_first_full_batch() -> None:
    one = learner([[14, 14, 11]] * 2)
    both, draws = np.arange(2), np.zeros((2, 32))
    for _ in range(31):
        remember(one, [0, 1])
        one.learn(both, draws)
    assert one.engine.updates.tolist() == [0, 0]
    remember(one, [1])
    one.learn(both, draws)
    assert one.engine.updates.tolist() == [0, 1]


def test_a_learner_learns_the_values_of_terminal_rewards() -> None:
    one = learner([[14]], actions=2)
    row, random = np.array([0]), np.random.default_rng(0)
    state, over = np.array([[3]]), np.array([True])
    for step in range(40):
        action = step % 2
        one.store(row, state, np.array([action]), np.array([4.0 if action else -1.0]), state, over)
    for _ in range(1500):
        one.learn(row, random.random((1, 32)))
    assert values(one, [[3]]).tolist()[0] == pytest.approx([-1.0, 4.0], abs=0.1)


def test_the_stored_discount_is_gamma_or_0_after_termination() -> None:
    one = learner([[14]])
    for over in (False, True):
        one.store(np.array([0]), np.array([[3]]), np.array([1]), np.array([1.0]), np.array([[4]]), np.array([over]))
    kept = one.replay.added_since(None)
    assert kept["discounts"].tolist() == [pytest.approx(0.95), 0.0]
    assert kept["states"].tolist() == [[3, 4], [3, 4]]


def prioritized_imitator(share: int = 8) -> Learner:
    """Return a learner of one row with 100 transitions of equal priority, which imitates an episode of one step."""
    preset = PAPER.model_copy(update={"prioritized": Prioritized(alpha=0.6, beta=0.4)})
    space, streams = StateSpace(np.array([[120]]), 2), [np.random.default_rng(0)]
    one = Learner(space, preset, streams, (Imitation(batch=share, margin=0.5), 60))
    row, last = np.array([0]), np.array([True])
    for number in range(100):
        state = np.array([[number]])
        one.store(row, state, np.array([0]), np.ones(1), state, last)
    assert one.best is not None
    one.best.keep(0, Transitions(np.array([[120], [120]]), np.array([1]), np.full(1, 1000.0), np.zeros(1)))
    return one


def test_old_and_new_transitions_are_drawn_equally_often_beside_imitation() -> None:
    one, random = prioritized_imitator(), np.random.default_rng(1)
    counts = np.zeros(121)
    for _ in range(200):
        _, batch = one._batch(np.array([0]), random.random((1, 32)))
        np.add.at(counts, batch.states[0, 0], 1)
    assert counts[120] == 200 * 8
    for fifth in counts[:100].reshape(5, 20).sum(axis=1):
        assert fifth == pytest.approx(200 * 24 / 5, rel=0.1)


def test_imitated_transitions_change_no_priorities() -> None:
    one, random = prioritized_imitator(), np.random.default_rng(1)
    assert one.priorities is not None
    for _ in range(50):
        before = one.priorities.state()["leaves"][0].copy()
        indices, batch = one._batch(np.array([0]), uniforms := random.random((1, 32)))
        one.learn(np.array([0]), uniforms)
        changed = np.flatnonzero(one.priorities.state()["leaves"][0] != before)
        assert set(changed) <= set(indices[~batch.imitated])
        assert len(changed) > 10
    assert one.priorities.state()["highest"][0] < 20, "the imitated step's error is some 1,000"
    all_imitated = prioritized_imitator(share=32)
    assert all_imitated.priorities is not None
    before = all_imitated.priorities.state()["leaves"][0].copy()
    all_imitated.learn(np.array([0]), random.random((1, 32)))
    np.testing.assert_array_equal(all_imitated.priorities.state()["leaves"][0], before)


@pytest.mark.parametrize(("weight", "learns"), [(0.0, False), (1.0, True)])
def test_td_errors_change_the_networks_only_with_a_positive_weight(weight: float, learns: bool) -> None:
    imitation = Imitation(batch=8, margin=0.5, td_weight=weight), 60
    one = Learner(StateSpace(np.array([[14]]), 2), PAPER, [np.random.default_rng(0)], imitation)
    before = one.engine.online.copy()
    state, over = np.array([[3]]), np.array([True])
    for _ in range(40):
        one.store(np.array([0]), state, np.array([1]), np.array([4.0]), state, over)
    one.learn(np.array([0]), np.random.default_rng(0).random((1, 32)))
    assert one.engine.updates.tolist() == [1]
    assert bool((one.engine.online != before).any()) is learns
