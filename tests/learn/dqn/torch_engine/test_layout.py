"""Where parameters lie in a row: a dense layer's biases beside its weights, as the compiled engine has them."""

import torch
from torch import nn

from mc_nested.learn.dqn.torch_engine.rows import Slot, bind, flat_of, parts_of, slots_of


def small() -> nn.Module:
    return nn.Sequential(nn.Conv2d(1, 2, 2), nn.Flatten(), nn.Linear(2, 3), nn.Linear(3, 1, bias=False))


def test_a_dense_layer_is_laid_out_as_each_nodes_weights_and_bias() -> None:
    module = nn.Linear(2, 3)
    module.weight.data = torch.tensor([[1.0, 2.0], [4.0, 5.0], [7.0, 8.0]])
    module.bias.data = torch.tensor([3.0, 6.0, 9.0])
    assert flat_of(module).tolist() == [1, 2, 3, 4, 5, 6, 7, 8, 9]


def test_other_layers_are_laid_out_parameter_by_parameter() -> None:
    assert slots_of(small()) == (
        Slot(("0.weight",), (2, 1, 2, 2)),
        Slot(("0.bias",), (2,)),
        Slot(("2.weight", "2.bias"), (3, 3)),
        Slot(("3.weight",), (1, 3)),
    )


def test_changing_a_row_changes_the_module_bound_to_it() -> None:
    module, states = small(), torch.ones(1, 1, 2, 2)
    row = torch.from_numpy(flat_of(module).copy())
    expected = module(states)
    bind(module, row)
    assert torch.equal(module(states), expected)
    row.zero_()
    assert module(states).item() == 0.0


def test_laying_out_the_parts_of_rows_restores_the_rows() -> None:
    slots = slots_of(small())
    rows = torch.arange(2.0 * 22).reshape(2, 22)
    parts = parts_of(rows, slots)
    assert {name: tuple(part.shape) for name, part in parts.items()} == {
        "0.weight": (2, 2, 1, 2, 2),
        "0.bias": (2, 2),
        "2.weight": (2, 3, 2),
        "2.bias": (2, 3),
        "3.weight": (2, 1, 3),
    }
    again = torch.zeros_like(rows)
    for name, part in parts_of(again, slots).items():
        part.copy_(parts[name])
    assert torch.equal(again, rows)
