"""Rows of networks: stacked, one by one and alone they give the same values and slopes."""

import numpy as np
import pytest
import torch
from torch import nn

from mc_nested.learn.dqn.torch_engine.networks import cnn, mlp
from mc_nested.learn.dqn.torch_engine.rows import NetworkRows, flat_of

SHAPE = (3, 9, 9)


def make(kind: str) -> nn.Module:
    return cnn(SHAPE, [8], 4) if kind == "cnn" else mlp(SHAPE, [8], 4)


def rows_of(kind: str, stacks: bool) -> NetworkRows:
    torch.manual_seed(0)
    flat = torch.from_numpy(np.stack([flat_of(make(kind)) for _ in range(3)]))
    return NetworkRows(lambda: make(kind), flat, stacks)


@pytest.mark.parametrize("kind", ["cnn", "mlp"])
@pytest.mark.parametrize("named", [[0, 1, 2], [2, 0], [1]])
def test_stacked_rows_give_the_values_and_gradients_of_rows_computed_one_by_one(kind: str, named: list[int]) -> None:
    inputs = torch.rand(len(named), 5, *SHAPE, generator=torch.Generator().manual_seed(1))
    found = []
    for stacks in (True, False):
        networks = rows_of(kind, stacks)
        values, leaves = networks.values(np.array(named), inputs)
        found.append((values.detach(), networks.gradient(values, 2 * values.detach(), leaves, len(named)).clone()))
    for stacked, one_by_one in zip(*found, strict=True):
        torch.testing.assert_close(stacked, one_by_one, rtol=1e-4, atol=1e-5)


def test_a_rows_gradient_depends_on_its_own_values_alone() -> None:
    networks = rows_of("mlp", True)
    values, leaves = networks.values(np.arange(3), torch.ones(3, 2, *SHAPE))
    slope = networks.gradient(values, torch.tensor([0.0, 1.0, 0.0])[:, None, None].expand_as(values), leaves, 3)
    assert slope[[0, 2]].abs().max() == 0.0
    assert slope[1].abs().max() > 0.0
