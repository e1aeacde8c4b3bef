"""Self-imitation: the large-margin loss against autograd, and best episodes in the batch."""

import numpy as np
import pytest

from mc_nested.learn.dqn.replay import Transitions
from mc_nested.learn.dqn.self_imitation import BestEpisodes, rival


@pytest.mark.parametrize(
    ("values", "pushed_down"),
    [
        ([2.0, 1.0, 0.0], 0),  # 2 + 0.5 is above 1
        ([1.2, 1.5, 0.0], 0),  # 1.2 + 0.5 is within the margin of 1.5
        ([0.9, 1.5, 0.0], 1),  # 1.5 is greedy by more than the margin
        ([1.0, 1.5, 0.0], 1),  # by just the margin
        ([2.0, 1.0, 3.0], 2),  # of two rivals, the greediest
    ],
)
def test_the_greediest_rival_within_the_margin_is_pushed_down(values: list[float], pushed_down: int) -> None:
    assert rival(np.array(values, np.float32), 1, 0.5) == pushed_down


def transitions(*numbers: int) -> Transitions:
    n = np.array(numbers)
    return Transitions(np.stack([n, n + 1]), n % 8, n / 2, np.full(len(n), 0.5))


def drawn(rows: int, batch: int) -> Transitions:
    whole = np.full((rows, batch), 90)
    return Transitions(np.stack([whole] * 2), whole.copy(), whole.astype(np.float32), whole.astype(np.float32))


def test_the_best_episode_fills_the_first_places_of_a_batch() -> None:
    best = BestEpisodes(rows=3, longest=10, share=2)
    best.keep(1, transitions(10, 11, 12, 13))
    batch = drawn(rows=2, batch=3)
    imitated = best.mix_in(np.array([1, 2]), batch, np.array([[0.0, 0.8, 0.5], [0.0, 0.8, 0.5]]))
    assert imitated.tolist() == [[True, True, False], [False, False, False]]
    assert batch.states[0].tolist() == [[10, 13, 90], [90, 90, 90]]
    assert batch.rewards.tolist() == [[5.0, 6.5, 90.0], [90.0, 90.0, 90.0]]
    assert batch.states[1].tolist() == [[11, 14, 90], [90, 90, 90]]


@pytest.mark.parametrize("shorter", [True, False])
def test_a_newly_kept_episode_replaces_the_last_one(shorter: bool) -> None:
    best = BestEpisodes(rows=1, longest=10, share=8)
    best.keep(0, transitions(*range(5)))
    best.keep(0, transitions(*range(20, 22 if shorter else 29)))
    batch = drawn(rows=1, batch=8)
    best.mix_in(np.array([0]), batch, np.arange(8)[None] / 8)
    assert min(batch.states[0, 0]) == 20


def test_a_forgotten_episode_is_not_imitated() -> None:
    best = BestEpisodes(rows=1, longest=10, share=2)
    best.keep(0, transitions(1, 2))
    best.forget(0)
    assert not best.mix_in(np.array([0]), drawn(1, 4), np.zeros((1, 4))).any()
