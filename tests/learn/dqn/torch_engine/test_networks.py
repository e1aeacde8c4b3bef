"""The networks that a preset names: their shapes, their initial parameters, and a user's own."""

from pathlib import Path

import numpy as np
import pytest
import torch

from mc_nested.errors import PresetError
from mc_nested.learn.dqn.compiled_engine.networks import initial_parameters
from mc_nested.learn.dqn.engine import NetworkForm
from mc_nested.learn.dqn.torch_engine.networks import cnn, form_of, initial_rows, network_maker
from mc_nested.learn.dqn.torch_engine.rows import flat_of

OWN = "tests.learn.dqn.torch_engine.own_networks"


def streams(count: int) -> list[np.random.Generator]:
    return [np.random.default_rng(row) for row in range(count)]


def test_an_mlp_has_the_same_initial_parameters_as_in_the_compiled_engine() -> None:
    make = network_maker("mlp", [32, 32])
    form = form_of("mlp", (4,), [32, 32], 8)
    assert form == NetworkForm("mlp", (4, 32, 32, 8))
    expected = np.stack([initial_parameters((4, 32, 32, 8), stream) for stream in streams(2)])
    np.testing.assert_array_equal(initial_rows(form, lambda: make((4,), 8), streams(2)), expected)
    assert flat_of(make((4,), 8)).shape == (1480,)


@pytest.mark.parametrize("shape", [(5, 5, 5), (5, 15, 15), (5, 32, 32), (5, 84, 84)])
def test_a_cnn_gives_one_value_per_action_for_arenas_and_pictures_of_any_size(shape: tuple[int, ...]) -> None:
    assert cnn(shape, [64], 8)(torch.zeros(3, *shape)).shape == (3, 8)


def test_a_cnn_for_the_line_has_38728_parameters() -> None:
    # 5·16·9 + 16, 16·32·9 + 32, 32·4·4·64 + 64, 64·8 + 8: planes of 15 x 15 become 8 x 8, then 4 x 4.
    parameters = 5 * 16 * 9 + 16 + 16 * 32 * 9 + 32 + 512 * 64 + 64 + 64 * 8 + 8
    assert flat_of(cnn((5, 15, 15), [64], 8)).size == parameters == 38_728


def test_a_rows_initial_parameters_depend_on_its_own_generator_alone() -> None:
    make = network_maker("cnn", [8])
    form = form_of("cnn", (3, 9, 9), [8], 4)
    torch.manual_seed(5)
    before = torch.random.get_rng_state()
    both = initial_rows(form, lambda: make((3, 9, 9), 4), streams(2))
    alone = initial_rows(form, lambda: make((3, 9, 9), 4), streams(2)[1:])
    np.testing.assert_array_equal(both[1], alone[0])
    assert not np.array_equal(both[0], both[1])
    assert torch.equal(torch.random.get_rng_state(), before), "the program's own random numbers go on as they were"


def test_a_users_network_is_found_by_module_and_name() -> None:
    make = network_maker(f"{OWN}:pooled", [])
    assert make((3, 9, 9), 4)(torch.zeros(2, 3, 9, 9)).shape == (2, 4)
    assert form_of(f"{OWN}:pooled", (3, 9, 9), [32], 4) == NetworkForm(f"{OWN}:pooled", (3, 9, 9, 4))


def test_a_module_in_the_working_directory_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "net_of_mine.py").write_text(
        "from torch import nn\ndef make(shape, actions):\n    return nn.Linear(*shape, actions)\n"
    )
    monkeypatch.chdir(tmp_path)
    assert network_maker("net_of_mine:make", [])((4,), 8)(torch.zeros(2, 4)).shape == (2, 8)


@pytest.mark.parametrize(
    ("network", "says"),
    [
        ("no_such_module:make", "can't be loaded"),
        (f"{OWN}:no_such_function", "can't be loaded"),
        (f"{OWN}:one_value", r"gives \(2, 1\) for 2 states: it should give \(2, 8\)"),
        (f"{OWN}:normed", "has buffers, as BatchNorm does"),
        (f"{OWN}:for_pictures", r"fails on states of \(4,\)"),
        (f"{OWN}:tied", "has a parameter in two places"),
        (f"{OWN}:frozen", "has a frozen parameter"),
        (f"{OWN}:nothing", "fails on states"),
        (":make", "can't be loaded"),
        (f"{OWN}:halves", "no finite 32-bit floats"),
        (f"{OWN}:for_two", "fails on states"),
        (f"{OWN}:without_parameters", "has no parameter"),
        (f"{OWN}:leaves", r"fails on states of \(4,\) \(5\)"),
        (f"{OWN}:fails", r"fails on states of \(4,\) \(no idea\)"),
    ],
)
def test_a_network_that_does_not_fit_is_refused_in_one_line(network: str, says: str) -> None:
    with pytest.raises(PresetError, match=says) as caught:
        network_maker(network, [])((4,), 8)
    assert "\n" not in str(caught.value)
