"""The DDQN target by hand, an update against torch's own Adam and Huber loss, and rows that don't affect each other."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from torch import Tensor, nn

from mc_nested.arrays import Float32s, Int32s
from mc_nested.errors import DivergedError
from mc_nested.learn.dqn.compiled_engine.engine import CompiledEngine, all_finite, greedy_actions, td_target
from mc_nested.learn.dqn.compiled_engine.networks import initial_parameters
from mc_nested.learn.dqn.engine import Batch, UpdateRule
from mc_nested.learn.dqn.states import StateSpace
from tests.learn.dqn.compiled_engine.test_networks import reference
from tests.learn.dqn.made_engines import RULE, batch_of, part, space_of

SIZES = (4, 32, 32, 8)


def test_double_dqn_target_takes_the_target_networks_value_of_the_online_networks_choice() -> None:
    # The online network prefers action 1; plain DQN would take the target network's own best, action 2:
    # 1 + 0.5 · 7 = 4.5. Double DQN takes the target network's value of action 1 (paper, equation 4).
    online, target = np.array([[2.0], [5.0], [3.0]], np.float32), np.array([1.0, 4.0, 7.0], np.float32)
    assert td_target(1.0, 0.5, target[greedy_of(online)[0]]) == 1.0 + 0.5 * 4.0


def test_td_target_is_the_reward_plus_the_discounted_next_value() -> None:
    assert td_target(1.0, 0.0, 9.0) == 1.0
    assert td_target(0.0, 0.95, -2.0) == pytest.approx(-1.9)


def test_the_first_of_several_highest_values_is_the_greedy_action() -> None:
    assert greedy_of(np.array([[1.0, 4.0], [3.0, 4.0], [3.0, -1.0]], np.float32)).tolist() == [1, 0]


@given(arrays(np.float32, st.tuples(st.integers(1, 10), st.integers(1, 40)), elements=st.integers(-3, 3)))
def test_greedy_actions_are_the_argmax_of_each_column(values: Float32s) -> None:
    assert greedy_of(values).tolist() == values.argmax(axis=0).tolist()


def greedy_of(values: Float32s) -> Int32s:
    greedy = np.full(values.shape[1], 7, np.int32)
    greedy_actions(values, greedy)
    return greedy


def learners(rows: int, rule: UpdateRule = RULE) -> CompiledEngine:
    online = np.stack([initial_parameters(SIZES, np.random.default_rng(row)) for row in range(rows)])
    return CompiledEngine(space_of(rows), SIZES, rule, online)


@pytest.mark.parametrize("rows", [1, 4])
@pytest.mark.parametrize("tabulated", [True, False])
def test_updates_match_torchs_adam_on_the_huber_and_large_margin_losses(rows: int, tabulated: bool) -> None:
    ours = learners(rows, RULE._replace(target_period=1000) if tabulated else RULE)
    assert bool(ours._target_values.values.size) is tabulated
    ours.rule = RULE
    parameters = [nn.Parameter(torch.from_numpy(row.copy())) for row in ours.online]
    optimisers = [torch.optim.Adam([parameter], lr=RULE.learning_rate) for parameter in parameters]
    targets = [parameter.detach().clone() for parameter in parameters]
    for update in range(1, 11):
        batch = batch_of(rows, seed=update)
        errors = ours.update(np.arange(rows), batch)
        for row, (parameter, optimiser) in enumerate(zip(parameters, optimisers, strict=True)):
            expected = _reference_update(ours.space, parameter, optimiser, targets[row], part(batch, [row]))
            np.testing.assert_allclose(errors[row], expected, rtol=1e-4, atol=1e-4)
            if update % RULE.target_period == 0:
                targets[row] = parameter.detach().clone()
    expected = torch.stack([p.detach() for p in parameters]).numpy()
    np.testing.assert_allclose(ours.online, expected, rtol=1e-3, atol=1e-5)
    np.testing.assert_allclose(ours.target, torch.stack(targets).numpy(), rtol=1e-3, atol=1e-5)
    assert ours.updates.tolist() == [10] * rows


def _reference_update(
    space: StateSpace, parameter: nn.Parameter, optimiser: torch.optim.Adam, target: Tensor, batch: Batch
) -> np.ndarray:
    states, following = (torch.from_numpy(space.features_of(0)[numbers[0], :-1]) for numbers in batch.states)
    rewards, discounts, actions, imitated, weights = (
        torch.from_numpy(getattr(batch, name)[0]) for name in ("rewards", "discounts", "actions", "imitated", "weights")
    )
    with torch.no_grad():
        best = reference(parameter, SIZES, following).argmax(1, keepdim=True)
        goal = rewards + discounts * reference(target, SIZES, following).gather(1, best)[:, 0]
    values = reference(parameter, SIZES, states)
    chosen = values.gather(1, actions[:, None])[:, 0]
    huber = (nn.functional.huber_loss(chosen, goal, delta=RULE.huber_delta, reduction="none") * weights).mean()
    raised = values + RULE.margin * (torch.arange(8) != actions[:, None])
    imitation = ((raised.max(1).values - chosen) * imitated).mean()
    optimiser.zero_grad()
    (huber + imitation).backward()  # type: ignore[no-untyped-call]  # torch
    optimiser.step()
    return np.array((chosen - goal).detach().numpy())


def test_updates_are_the_same_with_and_without_a_table_of_target_values() -> None:
    tabulated, by_batch = (learners(2, RULE._replace(target_period=period)) for period in (1000, 3))
    assert tabulated._target_values.values.size
    assert not by_batch._target_values.values.size
    by_batch.rule = tabulated.rule
    for engine in (tabulated, by_batch):
        engine.load_online(engine.online[::-1].copy())
    for update in range(5):
        errors = [engine.update(np.arange(2), batch_of(2, update)) for engine in (tabulated, by_batch)]
        np.testing.assert_allclose(errors[0], errors[1], rtol=1e-5, atol=1e-6)
        tabulated.online[:] = by_batch.online  # so that rounding in one update isn't the next one's


def test_a_row_learns_the_same_to_the_bit_beside_others_and_alone() -> None:
    every, some, alone = learners(4), learners(4), learners(1)
    alone.load_online(every.online[[3]].copy())
    for update in range(7):
        batch = batch_of(4, update)
        every.update(np.arange(4), batch)
        for rows in ([3, 1], [0], [2]):
            some.update(np.array(rows), part(batch, rows))
        alone.update(np.array([0]), part(batch, [3]))
    for name, kept in every.state().items():
        np.testing.assert_array_equal(some.state()[name], kept)
        np.testing.assert_array_equal(alone.state()[name][0], kept[3])


def test_each_row_scales_states_by_its_own_scenario() -> None:
    space = StateSpace(np.array([[14, 14, 11, 1], [14, 14, 16, 1]]), actions=8)
    same = initial_parameters(SIZES, np.random.default_rng(0))
    both = CompiledEngine(space, SIZES, RULE, np.stack([same, same]))
    state = space.encoded(np.array([[7, 14, 11, 1]] * 2))
    values = both.q_values(state)
    assert not np.array_equal(values[0], values[1])
    scaled = torch.tensor([[0.0, 1.0, 2 * 11 / 16 - 1, 1.0]])
    expected = reference(torch.from_numpy(same), SIZES, scaled)[0].numpy()
    np.testing.assert_allclose(values[1], expected, rtol=1e-5, atol=1e-6)


def test_a_batch_of_the_wrong_size_is_refused() -> None:
    with pytest.raises(ValueError, match=r"batches of \(1, 32\), not \(1, 64\)"):
        learners(1, RULE._replace(batch=64)).update(np.arange(1), batch_of(1, seed=0))


def test_q_values_come_from_each_rows_online_network() -> None:
    engine = learners(3)
    states = np.array([5, 77, 1234])
    features = torch.from_numpy(engine.space.features_of(0)[states, :-1])
    expected = [reference(torch.from_numpy(engine.online[row]), SIZES, features[row]).numpy() for row in range(3)]
    np.testing.assert_allclose(engine.q_values(states), np.stack(expected), rtol=1e-5, atol=1e-6)
    some = engine.q_values(states[[2, 0]], np.array([2, 0]))
    np.testing.assert_allclose(some, np.stack([expected[2], expected[0]]), rtol=1e-5, atol=1e-6)


def test_each_row_reports_the_loss_and_q_value_of_its_last_update() -> None:
    engine = learners(2)
    batch = batch_of(1, 3)._replace(weights=np.ones((1, 32), np.float32))
    states, actions = batch.states[0], batch.actions
    own = engine.q_values(np.tile(states[0], 2)[:2] * 0 + states[0, 0])[1, actions[0, 0]]
    errors = engine.update(np.array([1]), batch)
    assert np.isnan(engine.last.loss()[0])
    assert np.isnan(engine.last.q()[0])
    size = np.abs(errors[0])
    assert engine.last.loss()[1] == pytest.approx(np.where(size <= 1, size**2 / 2, size - 0.5).mean(), rel=1e-5)
    assert engine.last.values[1, 0] == pytest.approx(own, rel=1e-4, abs=1e-6)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("place", [0, 500, -1])
def test_all_finite_notices_nan_and_infinity_at_any_position(value: float, place: int) -> None:
    values = np.random.default_rng(0).standard_normal(1480).astype(np.float32)
    values[:3] = 0.0, -0.0, np.finfo(np.float32).max
    assert all_finite(values)
    values[place] = value
    assert not all_finite(values)


def test_row_returns_views_of_the_engines_arrays() -> None:
    engine, same = learners(3), learners(3)
    for each in (engine, same):
        each.update(np.arange(3), batch_of(3, 1))
    online, target, first, second, updates = engine.row(1)
    for part_, name in ((online, "online"), (target, "target"), (first, "first_moment"), (second, "second_moment")):
        np.testing.assert_array_equal(part_, same.state()[name][1])
        part_[:] = 7.0
    updates[0] = 42
    for name, kept in engine.state().items():
        assert (kept[1] == (42 if name == "updates" else 7.0)).all(), name
        np.testing.assert_array_equal(kept[[0, 2]], same.state()[name][[0, 2]], err_msg=name)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_check_finite_raises_for_the_diverged_row_alone(value: float) -> None:
    engine = learners(3)
    engine.row(1)[0][5] = value
    engine.check_finite(0)
    engine.check_finite(2)
    with pytest.raises(DivergedError, match="lower it in the preset"):
        engine.check_finite(1)
