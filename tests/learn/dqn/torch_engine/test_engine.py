"""What only the torch engine has: planes, convolutions, devices; and its slopes and its Adam against torch's own."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import PresetError
from mc_nested.learn.dqn.engine import Batch, Engine, UpdateRule
from mc_nested.learn.dqn.engines import EngineChoice, made_engine
from mc_nested.learn.dqn.states import PlaneStates
from mc_nested.learn.dqn.torch_engine import engine as module
from mc_nested.learn.dqn.torch_engine.engine import adam_step, device_named, huber_slopes, margin_slopes
from tests.learn.dqn.made_engines import part

RULE = UpdateRule(batch=4, learning_rate=1e-2, target_period=5, huber_delta=1.0)
SLOPED = UpdateRule(batch=4, learning_rate=1e-3, target_period=10, huber_delta=0.5, margin=0.8)
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


@given(st.integers(0, 2**31))
def test_huber_slopes_match_autograds_of_torchs_huber_loss(seed: int) -> None:
    random = torch.Generator().manual_seed(seed)
    values = torch.randn(2, 4, 3, generator=random).requires_grad_()
    taken = torch.randint(3, (2, 4, 1), generator=random)
    goals, weights = torch.randn(2, 4, generator=random), torch.rand(2, 4, generator=random)
    chosen = values.gather(-1, taken).squeeze(-1)
    losses = torch.nn.functional.huber_loss(chosen, goals, reduction="none", delta=SLOPED.huber_delta)
    (expected,) = torch.autograd.grad((weights * losses).sum() / SLOPED.batch, values)
    with torch.no_grad():
        found = huber_slopes(values, taken, chosen - goals, weights, SLOPED)
    torch.testing.assert_close(found, expected)


@given(st.integers(0, 2**31))
def test_margin_slopes_match_autograds_of_the_large_margin_loss(seed: int) -> None:
    random = torch.Generator().manual_seed(seed)
    values = torch.randn(2, 4, 3, generator=random).requires_grad_()
    taken = torch.randint(3, (2, 4, 1), generator=random)
    imitated = torch.rand(2, 4, generator=random) < 0.5
    margins = torch.full_like(values, SLOPED.margin).scatter(-1, taken, 0.0)
    losses = (values + margins).amax(-1) - values.gather(-1, taken).squeeze(-1)
    (expected,) = torch.autograd.grad((losses * imitated).sum() / SLOPED.batch, values)
    with torch.no_grad():
        found = margin_slopes(values, taken, imitated, SLOPED)
    torch.testing.assert_close(found, expected)


def test_an_action_a_margin_ahead_of_all_others_has_no_slope() -> None:
    values = torch.tensor([[[2.0, 0.0, 1.0]] * 4])
    taken = torch.zeros(1, 4, 1, dtype=torch.int64)
    assert margin_slopes(values, taken, torch.ones(1, 4, dtype=torch.bool), SLOPED).abs().max() == 0.0


def test_adam_matches_torchs_for_rows_at_different_steps() -> None:
    random = torch.Generator().manual_seed(0)
    first = torch.rand(2, 5, generator=random)
    ours, moments = first.clone(), (torch.zeros(2, 5), torch.zeros(2, 5))
    theirs = [torch.nn.Parameter(row.clone()) for row in first]
    optimisers = [torch.optim.Adam([row], lr=1e-2) for row in theirs]
    for step in range(1, 6):
        gradient = torch.randn(2, 5, generator=random)
        named = [0, 1] if step > 2 else [1]  # row 0 begins two steps later
        steps = np.array([step - 2, step])[named]
        own = ours[named], moments[0][named], moments[1][named]
        adam_step(*own, gradient[named], steps, 1e-2)
        for whole, changed in zip((ours, *moments), own, strict=True):
            whole[named] = changed
        for row in named:
            theirs[row].grad = gradient[row]
            optimisers[row].step()
    torch.testing.assert_close(ours, torch.stack([row.detach() for row in theirs]))
