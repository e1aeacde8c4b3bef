"""The DDQN target by hand, an update against torch's own Adam and Huber loss, and rows that never meet."""

import numpy as np
import pytest
import torch
from torch import Tensor, nn

from mc_nested.learn.ddqn import DDQN, Batch, UpdateRule, td_targets
from mc_nested.learn.networks import initial_parameters
from tests.learn.test_networks import columns, reference

SIZES = (4, 32, 32, 8)
RULE = UpdateRule(batch=32, learning_rate=1e-3, target_period=3, huber_delta=1.0)
GAMMA = 0.95


def test_the_target_takes_the_online_networks_choice_and_the_target_networks_value() -> None:
    # The online network prefers action 1; plain DQN would take the target network's own best, action 2:
    # 1 + 0.5 · 7 = 4.5. Double DQN takes the target network's value of action 1 (paper, equation 4).
    target = td_targets(
        rewards=np.array([[1.0]], np.float32),
        discounts=np.array([[0.5]], np.float32),
        next_online=np.array([[[2.0], [5.0], [3.0]]], np.float32),
        next_target=np.array([[[1.0], [4.0], [7.0]]], np.float32),
    )
    assert target.tolist() == [[1.0 + 0.5 * 4.0]]


def test_a_terminated_transition_is_worth_its_reward_alone() -> None:
    targets = td_targets(
        rewards=np.array([[1.0, 0.0]], np.float32),
        discounts=np.array([[0.0, 0.95]], np.float32),
        next_online=np.array([[[0.0, 3.0], [1.0, 1.0]]], np.float32),
        next_target=np.array([[[9.0, -2.0], [9.0, 8.0]]], np.float32),
    )
    assert targets.tolist() == [[1.0, pytest.approx(-1.9)]]


def learners(rows: int) -> DDQN:
    return DDQN(SIZES, RULE, np.stack([initial_parameters(SIZES, np.random.default_rng(row)) for row in range(rows)]))


def batch_of(rows: int, seed: int) -> Batch:
    random = np.random.default_rng(seed)
    inputs = np.ones((2, rows, 5, 32), np.float32)
    inputs[:, :, :-1] = random.uniform(-1, 1, (2, rows, 4, 32))
    return Batch(
        inputs=inputs,
        actions=random.integers(0, 8, (rows, 32)),
        # Some rewards far beyond δ, so that both branches of the Huber loss are taken.
        rewards=(random.standard_normal((rows, 32)) * 3).astype(np.float32),
        discounts=np.where(random.random((rows, 32)) < 0.2, 0.0, GAMMA).astype(np.float32),
    )


def part(batch: Batch, rows: list[int]) -> Batch:
    return Batch(batch.inputs[:, rows], batch.actions[rows], batch.rewards[rows], batch.discounts[rows])


def all_of(ddqn: DDQN) -> np.ndarray:
    return np.ones(len(ddqn.updates), dtype=np.bool_)


@pytest.mark.parametrize("rows", [1, 4])
def test_updates_are_those_of_torchs_adam_on_the_huber_loss(rows: int) -> None:
    ours = learners(rows)
    parameters = [nn.Parameter(torch.from_numpy(row.copy())) for row in ours.online]
    optimisers = [torch.optim.Adam([parameter], lr=RULE.learning_rate) for parameter in parameters]
    targets = [parameter.detach().clone() for parameter in parameters]
    for update in range(1, 11):
        batch = batch_of(rows, seed=update)
        for row, (parameter, optimiser) in enumerate(zip(parameters, optimisers, strict=True)):
            _reference_update(parameter, optimiser, targets[row], part(batch, [row]))
            if update % RULE.target_period == 0:
                targets[row] = parameter.detach().clone()
        ours.update_all(batch, all_of(ours))
    expected = torch.stack([p.detach() for p in parameters]).numpy()
    np.testing.assert_allclose(ours.online, expected, rtol=1e-4, atol=2e-6)
    np.testing.assert_allclose(ours.target, torch.stack(targets).numpy(), rtol=1e-4, atol=2e-6)
    assert ours.updates.tolist() == [10] * rows


def _reference_update(parameter: nn.Parameter, optimiser: torch.optim.Adam, target: Tensor, batch: Batch) -> None:
    states, following = (torch.from_numpy(inputs[0, :-1].T.copy()) for inputs in batch.inputs)
    rewards, discounts, actions = (
        torch.from_numpy(array[0]) for array in (batch.rewards, batch.discounts, batch.actions)
    )
    with torch.no_grad():
        best = reference(parameter, SIZES, following).argmax(1, keepdim=True)
        goal = rewards + discounts * reference(target, SIZES, following).gather(1, best)[:, 0]
    chosen = reference(parameter, SIZES, states).gather(1, actions[:, None])[:, 0]
    optimiser.zero_grad()
    nn.functional.huber_loss(chosen, goal, delta=RULE.huber_delta).backward()  # type: ignore[no-untyped-call]  # torch
    optimiser.step()


def test_the_target_network_follows_every_period_and_stands_still_between() -> None:
    ddqn = learners(1)
    first = ddqn.target.copy()
    for update in range(1, 3):
        ddqn.update_all(batch_of(1, update), all_of(ddqn))
        np.testing.assert_array_equal(ddqn.target, first)
    ddqn.update_all(batch_of(1, 3), all_of(ddqn))
    np.testing.assert_array_equal(ddqn.target, ddqn.online)
    assert not np.array_equal(ddqn.target, first)


@pytest.mark.parametrize("in_place", [True, False])
def test_rows_that_are_not_named_stay_as_they_are(in_place: bool) -> None:
    ddqn = learners(4)
    ddqn.update_all(batch_of(4, 1), all_of(ddqn))
    before = {name: kept.copy() for name, kept in ddqn.state().items()}
    if in_place:
        ddqn.update_all(batch_of(4, 2), np.array([True, False, True, False]))
    else:
        ddqn.update_some(np.array([2, 0]), batch_of(2, 2))
    for name, kept in ddqn.state().items():
        np.testing.assert_array_equal(kept[[1, 3]], before[name][[1, 3]])
    assert ddqn.updates.tolist() == [2, 1, 2, 1]


def test_a_row_learns_the_same_to_the_bit_in_place_in_a_copy_and_alone() -> None:
    every, some, alone = learners(4), learners(4), DDQN(SIZES, RULE, learners(4).online[[3]])
    for update in range(7):
        batch = batch_of(4, update)
        every.update_all(batch, all_of(every))
        for rows in ([3, 1], [0], [2]):
            some.update_some(np.array(rows), part(batch, rows))
        alone.update_all(part(batch, [3]), all_of(alone))
    for name, kept in every.state().items():
        np.testing.assert_array_equal(some.state()[name], kept)
        np.testing.assert_array_equal(alone.state()[name][0], kept[3])


def test_q_values_are_the_online_networks() -> None:
    ddqn = learners(3)
    states = torch.rand(3, 4)
    expected = [reference(torch.from_numpy(ddqn.online[row]), SIZES, states[row]).numpy() for row in range(3)]
    np.testing.assert_allclose(ddqn.q_values(columns(states[:, None])), np.stack(expected), rtol=1e-5, atol=1e-6)
    some = ddqn.q_values(columns(states[[2, 0], None]), np.array([2, 0]))
    np.testing.assert_allclose(some, np.stack([expected[2], expected[0]]), rtol=1e-5, atol=1e-6)


def test_a_loaded_learner_goes_on_to_the_bit() -> None:
    one, other = learners(2), learners(2)
    one.update_all(batch_of(2, 1), all_of(one))
    other.load({name: kept.copy() for name, kept in one.state().items()})
    for ddqn in (one, other):
        ddqn.update_all(batch_of(2, 2), all_of(ddqn))
    for name, kept in one.state().items():
        np.testing.assert_array_equal(kept, other.state()[name])
