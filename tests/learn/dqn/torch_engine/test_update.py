"""The slopes by hand, against autograd's; Adam against torch's own, each row at its own step."""

import numpy as np
import torch
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.learn.dqn.engine import UpdateRule
from mc_nested.learn.dqn.torch_engine.update import adam_step, huber_slopes, margin_slopes

RULE = UpdateRule(batch=4, learning_rate=1e-3, target_period=10, huber_delta=0.5, margin=0.8)


@given(st.integers(0, 2**31))
def test_huber_slopes_match_autograds_of_torchs_huber_loss(seed: int) -> None:
    random = torch.Generator().manual_seed(seed)
    values = torch.randn(2, 4, 3, generator=random).requires_grad_()
    taken = torch.randint(3, (2, 4, 1), generator=random)
    goals, weights = torch.randn(2, 4, generator=random), torch.rand(2, 4, generator=random)
    chosen = values.gather(-1, taken).squeeze(-1)
    losses = torch.nn.functional.huber_loss(chosen, goals, reduction="none", delta=RULE.huber_delta)
    (expected,) = torch.autograd.grad((weights * losses).sum() / RULE.batch, values)
    with torch.no_grad():
        found = huber_slopes(values, taken, chosen - goals, weights, RULE)
    torch.testing.assert_close(found, expected)


@given(st.integers(0, 2**31))
def test_margin_slopes_match_autograds_of_the_large_margin_loss(seed: int) -> None:
    random = torch.Generator().manual_seed(seed)
    values = torch.randn(2, 4, 3, generator=random).requires_grad_()
    taken = torch.randint(3, (2, 4, 1), generator=random)
    imitated = torch.rand(2, 4, generator=random) < 0.5
    margins = torch.full_like(values, RULE.margin).scatter(-1, taken, 0.0)
    losses = (values + margins).amax(-1) - values.gather(-1, taken).squeeze(-1)
    (expected,) = torch.autograd.grad((losses * imitated).sum() / RULE.batch, values)
    with torch.no_grad():
        found = margin_slopes(values, taken, imitated, RULE)
    torch.testing.assert_close(found, expected)


def test_an_action_a_margin_ahead_of_all_others_has_no_slope() -> None:
    values = torch.tensor([[[2.0, 0.0, 1.0]] * 4])
    taken = torch.zeros(1, 4, 1, dtype=torch.int64)
    assert margin_slopes(values, taken, torch.ones(1, 4, dtype=torch.bool), RULE).abs().max() == 0.0


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
        for whole, part in zip((ours, *moments), own, strict=True):
            whole[named] = part
        for row in named:
            theirs[row].grad = gradient[row]
            optimisers[row].step()
    torch.testing.assert_close(ours, torch.stack([row.detach() for row in theirs]))
