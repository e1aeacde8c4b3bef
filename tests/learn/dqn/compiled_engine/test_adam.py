"""Adam against torch's."""

import numpy as np
import torch
from torch import nn

from mc_nested.learn.dqn.compiled_engine.adam import adam_step


def test_adam_step_matches_torchs_adam() -> None:
    random = np.random.default_rng(0)
    ours = random.standard_normal(50).astype(np.float32)
    theirs = nn.Parameter(torch.from_numpy(ours.copy()))
    optimiser = torch.optim.Adam([theirs], lr=1e-2)
    first, second = np.zeros_like(ours), np.zeros_like(ours)
    for step in range(1, 30):
        gradient = random.standard_normal(50).astype(np.float32) * 10.0 ** float(random.integers(-6, 3))
        theirs.grad = torch.from_numpy(gradient.astype(np.float32).copy())
        optimiser.step()
        adam_step(ours, first, second, gradient.astype(np.float32), step, 1e-2)
        np.testing.assert_allclose(ours, theirs.detach().numpy(), rtol=1e-4, atol=1e-6)
