"""Adam against torch's own, each row at a step of its own."""

import numpy as np
import torch

from mc_nested.learn.dqn.torch_engine.adam import adam_step


def test_rows_at_other_steps_are_each_as_torchs_adam() -> None:
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
