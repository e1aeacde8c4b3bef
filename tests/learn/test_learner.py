"""One learner: how states are encoded, and who explores."""

import numpy as np
import pytest

from mc_nested.learn.learner import Learner, StateSpace
from mc_nested.learn.preset import load_preset
from mc_nested.learn.replay import Transitions

PAPER = load_preset("paper")


def learner(highest: list[list[int]], actions: int = 8) -> Learner:
    streams = [np.random.default_rng(run) for run in range(len(highest))]
    return Learner(StateSpace(np.array(highest), actions), PAPER, streams)


def test_x_y_b_are_scaled_to_one_around_zero_and_the_main_action_is_plus_or_minus_one() -> None:
    one = learner([[14, 14, 11, 1]])
    states = np.array([[[0, 7, 11, 0], [14, 14, 0, 1]]])
    assert one.encode(states, np.array([0])).tolist() == [[[-1.0, 0.0, 1.0, -1.0], [1.0, 1.0, -1.0, 1.0]]]


def test_each_run_is_scaled_by_its_own_scenario() -> None:
    both = learner([[14, 14, 11], [14, 14, 16]])
    assert both.encode(np.array([[0, 0, 11], [0, 0, 16]])).tolist() == [[-1.0, -1.0, 1.0]] * 2


def test_the_choice_of_a_single_material_says_nothing() -> None:
    one = learner([[14, 14, 11, 0]])
    assert one.encode(np.array([[14, 14, 11, 0]])).tolist() == [[1.0, 1.0, 1.0, 0.0]]


def test_three_materials_lie_on_one_dimension() -> None:
    one = learner([[2]])
    assert one.encode(np.array([[[0], [1], [2]]]), np.array([0])).flatten().tolist() == [-1.0, 0.0, 1.0]


def test_a_number_below_epsilon_explores_and_the_second_says_where() -> None:
    three = learner([[14, 14, 11]] * 3)
    states = np.array([[7, 14, 11]] * 3)
    greedy = three.act(states, np.zeros(3), np.zeros((3, 2)))
    uniforms = np.array([[0.49, 0.99], [0.5, 0.99], [0.0, 0.0]])
    assert three.act(states, np.full(3, 0.5), uniforms).tolist() == [7, greedy[1], 0]
    best = three.ddqn.q_values(three.encode(states)).argmax(1)
    assert greedy.tolist() == best.tolist()


def test_learning_starts_with_the_first_full_batch() -> None:
    one = learner([[14, 14, 11]] * 2)
    both, draws = np.arange(2), np.zeros((2, 32))
    seen = Transitions(np.zeros((2, 3), int), np.zeros(2, int), np.ones(2), np.zeros((2, 3), int), np.ones(2, bool))
    alone = Transitions(np.zeros((1, 3), int), np.zeros(1, int), np.ones(1), np.zeros((1, 3), int), np.ones(1, bool))
    for _ in range(31):
        one.replay.add(both, seen)
        one.learn(both, draws)
    assert one.ddqn.updates.tolist() == [0, 0]
    one.replay.add(np.array([1]), alone)
    one.learn(both, draws)
    assert one.ddqn.updates.tolist() == [0, 1]


def test_a_learner_learns_what_a_terminal_reward_is_worth() -> None:
    one = learner([[14]], actions=2)
    row, random = np.array([0]), np.random.default_rng(0)
    for step in range(40):
        action = step % 2
        worth = np.array([4.0 if action else -1.0])
        one.replay.add(row, Transitions(np.array([[3]]), np.array([action]), worth, np.array([[3]]), np.array([True])))
    for _ in range(1500):
        one.learn(row, random.random((1, 32)))
    assert one.ddqn.q_values(one.encode(np.array([[3]]))).tolist()[0] == pytest.approx([-1.0, 4.0], abs=0.1)
