"""Self-imitation: the large-margin loss against autograd, and best episodes in the batch."""

import numpy as np
import pytest
import torch

from mc_nested.learn.imitation import BestEpisodes, margin_slope
from mc_nested.learn.replay import Transitions


def test_the_margin_raises_the_imitated_action_and_lowers_the_greediest_other() -> None:
    # Action 1 is to be greedy. Column 0: 2 + 0.5 is above 1; column 1: 1.2 is within the margin of 1.5; column 2: not.
    values = np.array([[[2.0, 1.2, 0.9], [1.0, 1.5, 1.5], [0.0, 0.0, 0.0]]], np.float32)
    slope = margin_slope(values, np.array([[1, 1, 1]]), margin=0.5)
    assert slope.tolist() == [[[1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [0.0, 0.0, 0.0]]]


def test_the_slope_is_autograds() -> None:
    random = np.random.default_rng(0)
    values = random.standard_normal((3, 8, 16)).astype(np.float32)
    actions = random.integers(0, 8, (3, 16))
    leaf = torch.from_numpy(values).requires_grad_()
    own = torch.from_numpy(actions)[:, None]
    raised = leaf + 0.7 * (torch.arange(8)[None, :, None] != own)
    (raised.max(1).values - leaf.gather(1, own)[:, 0]).sum().backward()  # type: ignore[no-untyped-call]  # torch
    assert leaf.grad is not None
    np.testing.assert_array_equal(margin_slope(values, actions, 0.7), leaf.grad.numpy())


def transitions(*numbers: int) -> Transitions:
    n = np.array(numbers)
    return Transitions(n, n % 8, n / 2, n + 1, np.full(len(n), 0.5))


def drawn(rows: int, batch: int) -> Transitions:
    whole = np.full((rows, batch), 90)
    return Transitions(whole.copy(), whole.copy(), whole.astype(np.float32), whole.copy(), whole.astype(np.float32))


def test_the_first_transitions_of_a_batch_are_the_best_episodes() -> None:
    best = BestEpisodes(rows=3, longest=10, share=2)
    best.keep(1, transitions(10, 11, 12, 13))
    batch = drawn(rows=2, batch=3)
    imitated = best.mix_in(np.array([1, 2]), batch, np.array([[0.0, 0.8, 0.5], [0.0, 0.8, 0.5]]))
    assert imitated.tolist() == [[True, True, False], [False, False, False]]
    assert batch.states.tolist() == [[10, 13, 90], [90, 90, 90]]
    assert batch.rewards.tolist() == [[5.0, 6.5, 90.0], [90.0, 90.0, 90.0]]
    assert batch.next_states.tolist() == [[11, 14, 90], [90, 90, 90]]


@pytest.mark.parametrize("shorter", [True, False])
def test_a_better_episode_takes_the_last_ones_place(shorter: bool) -> None:
    best = BestEpisodes(rows=1, longest=10, share=8)
    best.keep(0, transitions(*range(5)))
    best.keep(0, transitions(*range(20, 22 if shorter else 29)))
    batch = drawn(rows=1, batch=8)
    best.mix_in(np.array([0]), batch, np.arange(8)[None] / 8)
    assert min(batch.states[0]) == 20


def test_a_forgotten_episode_is_not_imitated() -> None:
    best = BestEpisodes(rows=1, longest=10, share=2)
    best.keep(0, transitions(1, 2))
    best.forget(0)
    assert not best.mix_in(np.array([0]), drawn(1, 4), np.zeros((1, 4))).any()
