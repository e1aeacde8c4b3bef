"""The DDQN target by hand, an update against torch's own Adam and Huber loss, and rows that never meet."""

import numpy as np
import pytest
import torch
from torch import Tensor, nn

from mc_nested.learn.ddqn import DDQN, Batch, UpdateRule, td_targets
from mc_nested.learn.networks import initial_parameters
from tests.learn.test_networks import reference

SIZES = (4, 32, 32, 8)
RULE = UpdateRule(batch=32, learning_rate=1e-3, gamma=0.95, target_period=3, huber_delta=1.0)


def test_the_target_takes_the_online_networks_choice_and_the_target_networks_value() -> None:
    # The online network prefers action 1; plain DQN would take the target network's own best, action 2:
    # 1 + 0.5 · 7 = 4.5. Double DQN takes the target network's value of action 1 (paper, equation 4).
    target = td_targets(
        rewards=torch.tensor([1.0]),
        terminated=torch.tensor([False]),
        next_online=torch.tensor([[2.0, 5.0, 3.0]]),
        next_target=torch.tensor([[1.0, 4.0, 7.0]]),
        gamma=0.5,
    )
    assert target.tolist() == [1.0 + 0.5 * 4.0]


def test_a_terminated_transition_is_worth_its_reward_alone() -> None:
    targets = td_targets(
        rewards=torch.tensor([[1.0, 0.0]]),
        terminated=torch.tensor([[True, False]]),
        next_online=torch.tensor([[[0.0, 1.0], [3.0, 1.0]]]),
        next_target=torch.tensor([[[9.0, 9.0], [-2.0, 8.0]]]),
        gamma=0.95,
    )
    assert targets.tolist() == [[1.0, pytest.approx(-1.9)]]


def learners(rows: int) -> DDQN:
    parameters = [initial_parameters(SIZES, np.random.default_rng(row)) for row in range(rows)]
    return DDQN(SIZES, RULE, torch.from_numpy(np.stack(parameters)))


def batch_of(rows: int, seed: int) -> Batch:
    random = torch.Generator().manual_seed(seed)
    return Batch(
        states=torch.rand(rows, 64, 4, generator=random) * 2 - 1,
        actions=torch.randint(0, 8, (rows, 32), generator=random),
        # Some rewards far beyond δ, so that both branches of the Huber loss are taken.
        rewards=torch.randn(rows, 32, generator=random) * 3,
        terminated=torch.rand(rows, 32, generator=random) < 0.2,
    )


def part(batch: Batch, rows: list[int]) -> Batch:
    return Batch(*(getattr(batch, name)[rows] for name in Batch.__dataclass_fields__))


@pytest.mark.parametrize("rows", [1, 4])
def test_updates_are_those_of_torchs_adam_on_the_huber_loss(rows: int) -> None:
    ours = learners(rows)
    parameters = [nn.Parameter(row.clone()) for row in ours.learners.online]
    optimisers = [torch.optim.Adam([parameter], lr=RULE.learning_rate) for parameter in parameters]
    targets = [parameter.detach().clone() for parameter in parameters]
    for update in range(1, 11):
        batch = batch_of(rows, seed=update)
        for row, (parameter, optimiser) in enumerate(zip(parameters, optimisers, strict=True)):
            _reference_update(parameter, optimiser, targets[row], part(batch, [row]))
            if update % RULE.target_period == 0:
                targets[row] = parameter.detach().clone()
        ours.update(torch.arange(rows), batch)
    torch.testing.assert_close(
        ours.learners.online, torch.stack([p.detach() for p in parameters]), rtol=1e-4, atol=1e-6
    )
    torch.testing.assert_close(ours.learners.target, torch.stack(targets), rtol=1e-4, atol=1e-6)
    assert ours.updates.tolist() == [10] * rows


def _reference_update(parameter: nn.Parameter, optimiser: torch.optim.Adam, target: Tensor, batch: Batch) -> None:
    with torch.no_grad():
        best = reference(parameter, SIZES, batch.states[0, 32:]).argmax(1, keepdim=True)
        value = reference(target, SIZES, batch.states[0, 32:]).gather(1, best)[:, 0]
        goal = batch.rewards[0] + torch.where(batch.terminated[0], 0.0, RULE.gamma * value)
    chosen = reference(parameter, SIZES, batch.states[0, :32]).gather(1, batch.actions[0][:, None])[:, 0]
    optimiser.zero_grad()
    nn.functional.huber_loss(chosen, goal, delta=RULE.huber_delta).backward()  # type: ignore[no-untyped-call]  # torch
    optimiser.step()


def test_the_target_network_follows_every_period_and_stands_still_between() -> None:
    ddqn = learners(1)
    first = ddqn.learners.target.clone()
    for update in range(1, 3):
        ddqn.update(torch.arange(1), batch_of(1, update))
        torch.testing.assert_close(ddqn.learners.target, first, rtol=0, atol=0)
    ddqn.update(torch.arange(1), batch_of(1, 3))
    torch.testing.assert_close(ddqn.learners.target, ddqn.learners.online, rtol=0, atol=0)
    assert not torch.equal(ddqn.learners.target, first)


def test_rows_that_are_not_named_stay_as_they_are() -> None:
    ddqn = learners(4)
    before = {name: kept.clone() for name, kept in ddqn.state().items()}
    ddqn.update(torch.tensor([2, 0]), batch_of(2, 0))
    for name, kept in ddqn.state().items():
        torch.testing.assert_close(kept[[1, 3]], before[name][[1, 3]], rtol=0, atol=0)
    assert ddqn.updates.tolist() == [1, 0, 1, 0]


def test_some_rows_learn_the_same_as_all_rows_do() -> None:
    every, some = learners(4), learners(4)
    batch = batch_of(4, 7)
    every.update(torch.arange(4), batch)
    for rows in ([3, 1], [0], [2]):
        some.update(torch.tensor(rows), part(batch, rows))
    torch.testing.assert_close(some.learners.online, every.learners.online)
    assert some.updates.tolist() == every.updates.tolist()


def test_q_values_are_the_online_networks() -> None:
    ddqn = learners(3)
    states = torch.rand(3, 4)
    expected = torch.stack([reference(ddqn.learners.online[row], SIZES, states[row]) for row in range(3)])
    torch.testing.assert_close(ddqn.q_values(states), expected)


def test_a_loaded_learner_goes_on_to_the_bit() -> None:
    one, other = learners(2), learners(2)
    one.update(torch.arange(2), batch_of(2, 1))
    other.load({name: kept.clone() for name, kept in one.state().items()})
    for ddqn in (one, other):
        ddqn.update(torch.arange(2), batch_of(2, 2))
    for name, kept in one.state().items():
        torch.testing.assert_close(kept, other.state()[name], rtol=0, atol=0)
