"""Abilities that only the torch engine has: planes, convolutions, devices."""

import numpy as np
import pytest
import torch

from mc_nested.errors import PresetError
from mc_nested.learn.dqn.engine import Batch, Engine, UpdateRule
from mc_nested.learn.dqn.engines import EngineChoice, made_engine
from mc_nested.learn.dqn.states import PlaneStates
from mc_nested.learn.dqn.torch_engine import engine as module
from mc_nested.learn.dqn.torch_engine.engine import device_named
from tests.learn.dqn.made_engines import part

RULE = UpdateRule(batch=4, learning_rate=1e-2, target_period=5, huber_delta=1.0)
SHAPE = (2, 6, 6)


def engine_of(rows: int, network: str = "cnn") -> Engine:
    streams = [np.random.default_rng(row) for row in range(rows)]
    return made_engine(PlaneStates(rows, 3, SHAPE), EngineChoice("torch", "cpu", network, (8,)), RULE, streams)


def batch_of(rows: int, seed: int) -> Batch:
    random = np.random.default_rng(seed)
    return Batch(
        random.integers(0, 256, (2, rows, 4, *SHAPE), dtype=np.uint8),
        random.integers(0, 3, (rows, 4)),
        random.random((rows, 4)).astype(np.float32),
        np.zeros((rows, 4), np.float32),
        np.zeros((rows, 4), np.bool_),
        np.ones((rows, 4), np.float32),
    )


@pytest.mark.parametrize("network", ["cnn", "mlp", "tests.learn.dqn.torch_engine.own_networks:pooled"])
def test_the_torch_engine_learns_the_values_of_terminal_rewards_from_images(network: str) -> None:
    engine, batch = engine_of(1, network), batch_of(1, 0)
    for _ in range(300):
        errors = engine.update(np.array([0]), batch)
    assert np.abs(errors).max() < 0.05
    values = engine.q_values(batch.states[0, 0, :1])
    assert values[0, batch.actions[0, 0]] == pytest.approx(batch.rewards[0, 0], abs=0.05)


def test_a_row_learns_the_same_alone_and_beside_another() -> None:
    both, alone = engine_of(2), engine_of(1)
    for update in range(5):
        batch = batch_of(2, update)
        both.update(np.arange(2), batch)
        alone.update(np.array([0]), part(batch, [0]))
    np.testing.assert_allclose(both.online[0], alone.online[0], rtol=1e-5, atol=1e-7)


def test_networks_see_planes_scaled_to_between_0_and_1() -> None:
    engine = engine_of(1, "mlp")
    engine.load_online(np.eye(1, engine.online.shape[1], dtype=np.float32))  # the first node sees the first input alone
    full, empty = np.zeros((2, 1, *SHAPE), np.uint8)
    full[0, 0, 0, 0] = 255
    weights = torch.zeros(3, 9)
    weights[1, 0] = 1.0
    online = engine.online.copy()
    online[0, -27:] = weights.ravel()
    engine.load_online(online)
    assert engine.q_values(full)[0].tolist() == [0.0, pytest.approx(np.tanh(1.0)), 0.0]
    assert engine.q_values(empty)[0].tolist() == [0.0, 0.0, 0.0]


def test_a_missing_device_is_refused_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    assert device_named("cpu") == torch.device("cpu")
    with pytest.raises(PresetError, match="device 'cuda': torch finds no such device on this computer: take cpu"):
        device_named("cuda")


def test_too_little_memory_is_refused_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    engine = engine_of(1)

    def runs_out(*_: object, **__: object) -> None:
        raise torch.OutOfMemoryError("CUDA out of memory. Tried to allocate 2 GiB\nmore lines")

    monkeypatch.setattr(module, "adam_step", runs_out)
    with pytest.raises(PresetError, match="device 'cpu': out of memory: lower") as caught:
        engine.update(np.array([0]), batch_of(1, 0))
    assert "\n" not in str(caught.value)
