"""The target networks' values of every state, renewed by row."""

import numpy as np
import torch

from mc_nested.learn.dqn.compiled_engine.networks import initial_parameters
from mc_nested.learn.dqn.compiled_engine.target_values import AT_ONCE, TargetValues, table_pays
from mc_nested.learn.dqn.states import StateSpace
from tests.learn.dqn.compiled_engine.test_networks import reference

SIZES = (3, 4, 4, 8)


def test_the_table_holds_every_states_target_values_and_renews_named_rows_only() -> None:
    space = StateSpace(np.array([[14, 14, 2], [14, 14, 1]]), actions=8)
    assert space.count > 2 * AT_ONCE, "more than one part, the last not full"
    assert space.count % AT_ONCE
    target = np.stack([initial_parameters(SIZES, np.random.default_rng(row)) for row in range(3)])
    found = TargetValues(space, SIZES, target[:2])

    def expected(row: int, parameters: int) -> np.ndarray:
        features = torch.from_numpy(space.features_of(row)[:, :-1])
        return np.asarray(reference(torch.from_numpy(target[parameters]), SIZES, features).detach().numpy())

    for row in (0, 1):
        np.testing.assert_allclose(found.values[row], expected(row, row), rtol=1e-4, atol=1e-5)
    found.renew(np.array([1]), target[[2]])
    np.testing.assert_allclose(found.values[0], expected(0, 0), rtol=1e-4, atol=1e-5)
    np.testing.assert_allclose(found.values[1], expected(1, 2), rtol=1e-4, atol=1e-5)


def test_a_table_pays_up_to_as_many_states_as_a_target_period_draws() -> None:
    assert table_pays(15 * 15 * 17 * 2, batch=32, target_period=500), "the paper's and the shipped presets'"
    assert table_pays(16_000, batch=32, target_period=500)
    assert not table_pays(16_001, batch=32, target_period=500)
    assert not table_pays(15 * 15 * 101 * 8, batch=32, target_period=500), "a hundred blocks, eight materials"


def test_target_values_without_a_table_keep_nothing() -> None:
    space = StateSpace(np.array([[14, 14, 100, 7]]), actions=8)
    target = initial_parameters((4, 4, 4, 8), np.random.default_rng(0))[None]
    found = TargetValues(space, (4, 4, 4, 8), target, tabulated=False)
    found.renew(np.array([0]), target)
    assert found.values.shape == (1, 0, 8)
