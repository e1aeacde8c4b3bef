"""Double deep Q-learning (paper, section 2.4) for many independent networks at once.

A row is one learner: an online and a target network, its optimiser's moments and its count of updates. Rows never
meet: updating some of them leaves the others untouched.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import torch
from torch import Tensor

from mc_nested.learn.networks import Sizes, activations_of, backward, forward, split

ADAM_BETA_1, ADAM_BETA_2, ADAM_EPSILON = 0.9, 0.999, 1e-8
"""Adam's constants, as its authors propose them (Kingma and Ba, 2015)."""


@dataclass(frozen=True)
class UpdateRule:
    """What an update does (README: the task): batch size, Adam's rate, γ, the target's period and Huber's δ."""

    batch: int
    learning_rate: float
    gamma: float
    target_period: int
    huber_delta: float


@dataclass(frozen=True)
class Batch:
    """Transitions for k rows: actions, rewards and terminated (k, batch), and the features of their states.

    ``states`` (k, 2 · batch, inputs) holds every s and behind them every s', so that one pass values them all.
    """

    states: Tensor
    actions: Tensor
    rewards: Tensor
    terminated: Tensor


def td_targets(rewards: Tensor, terminated: Tensor, next_online: Tensor, next_target: Tensor, gamma: float) -> Tensor:
    """Y = r + γ Q(s', argmax Q(s'; θ); θ⁻), the bootstrap dropped where the episode terminated (paper, equation 4).

    ``next_online`` and ``next_target`` are the two networks' values of s', (..., actions); the rest (...).
    """
    chosen = next_online.argmax(-1, keepdim=True)
    bootstrap = next_target.gather(-1, chosen).squeeze(-1)
    return rewards + gamma * bootstrap * ~terminated


class DDQN:
    """Rows of Q-networks with their targets and optimisers.

    Args:
        sizes: widths of every network.
        rule: what an update does.
        online: initial parameters, (rows, parameters).
    """

    def __init__(self, sizes: Sizes, rule: UpdateRule, online: Tensor) -> None:
        self.sizes = sizes
        self.rule = rule
        self.learners = _Learners(online, online.clone(), torch.zeros_like(online), torch.zeros_like(online))
        self.updates = torch.zeros(len(online), dtype=torch.int64)
        self._acting = activations_of(len(online), 1, sizes)
        self._all_rows = _Workspace(self.learners, _standing_for(online, sizes, rule.batch), sizes, rule.batch)
        # Where fewer rows are updated than there are, a copy of them is, in the first rows of these.
        self._copies = _Learners(*(torch.empty_like(part) for part in self.learners))
        self._some_rows: dict[int, _Workspace] = {}

    def q_values(self, features: Tensor, rows: Tensor | None = None) -> Tensor:
        """The online networks' values (k, actions) for one state a row, features (k, inputs); all rows unless named.

        Without ``rows`` the tensor is overwritten by the next call.
        """
        if rows is None:
            return forward(self._all_rows.online_layers, features[:, None], self._acting)[:, 0]
        layers = split(self.learners.online[rows], self.sizes)
        return forward(layers, features[:, None], activations_of(len(rows), 1, self.sizes))[:, 0]

    def update(self, rows: Tensor, batch: Batch) -> None:
        """One update of each of the named rows (k,), each on its own batch, by the gradient of the mean Huber loss."""
        work = self._workspace(len(rows))
        if work is not self._all_rows:
            for own, copy in zip(self.learners, work.learners, strict=True):
                torch.index_select(own, 0, rows, out=copy)
        self.updates[rows] += 1
        self._find_gradient(work, batch)
        self._follow_gradient(work, self.updates[rows])
        if work is not self._all_rows:
            for own, copy in zip(self.learners, work.learners, strict=True):
                own.index_copy_(0, rows, copy)
        due = rows[self.updates[rows] % self.rule.target_period == 0]
        self.learners.target[due] = self.learners.online[due]

    def state(self) -> dict[str, Tensor]:
        """Everything the next update depends on, by name."""
        return {**self.learners._asdict(), "updates": self.updates}

    def load(self, state: Mapping[str, Tensor]) -> None:
        """Go on from what ``state`` gave; KeyError or RuntimeError where it is of another shape."""
        for name, own in self.state().items():
            own.copy_(state[name])

    def _workspace(self, rows: int) -> "_Workspace":
        if rows == len(self.updates):
            return self._all_rows
        if rows not in self._some_rows:
            copies = _Learners(*(part[:rows] for part in self._copies))
            standing = _first_rows(self._all_rows.standing, rows)
            self._some_rows[rows] = _Workspace(copies, standing, self.sizes, self.rule.batch)
        return self._some_rows[rows]

    def _find_gradient(self, work: "_Workspace", batch: Batch) -> None:
        size = self.rule.batch
        values = forward(work.online_layers, batch.states, work.standing.now_and_next)
        next_target = forward(work.target_layers, batch.states[:, size:], work.standing.target_next)
        targets = td_targets(batch.rewards, batch.terminated, values[:, size:], next_target, self.rule.gamma)
        actions = batch.actions[..., None]
        errors = values[:, :size].gather(-1, actions).squeeze(-1) - targets
        slope = errors.clamp_(-self.rule.huber_delta, self.rule.huber_delta) / size
        output_gradient = work.standing.target_next[-1].zero_().scatter_(-1, actions, slope[..., None])
        states = batch.states[:, :size]
        backward(work.online_layers, states, work.now, output_gradient, work.gradient_layers, work.standing.scratch)

    def _follow_gradient(self, work: "_Workspace", updates: Tensor) -> None:
        online, _, first_moment, second_moment = work.learners
        gradient = work.standing.gradient
        count = updates[:, None].float()
        first_moment.lerp_(gradient, 1 - ADAM_BETA_1)
        second_moment.mul_(ADAM_BETA_2).addcmul_(gradient, gradient, value=1 - ADAM_BETA_2)
        step = torch.div(second_moment, 1 - ADAM_BETA_2**count, out=work.standing.step).sqrt_().add_(ADAM_EPSILON)
        torch.div(first_moment, step, out=step)
        online.sub_(step.mul_(self.rule.learning_rate / (1 - ADAM_BETA_1**count)))


class _Learners(NamedTuple):
    """What an update changes: parameters and Adam's moments, (rows, parameters) each."""

    online: Tensor
    target: Tensor
    first_moment: Tensor
    second_moment: Tensor


class _Standing(NamedTuple):
    """The tensors that an update works in, rows first: fresh ones each time would cost more than the arithmetic.

    ``now_and_next`` are the activations of every s and s' in the online network, ``target_next`` those of s' in the
    target network.
    """

    gradient: Tensor
    step: Tensor
    now_and_next: list[Tensor]
    target_next: list[Tensor]
    scratch: list[Tensor]


class _Workspace:
    """Learners and the standing tensors of their update, with the views of them that it needs: layers, and s alone."""

    def __init__(self, learners: _Learners, standing: _Standing, sizes: Sizes, batch: int) -> None:
        self.learners = learners
        self.standing = standing
        self.online_layers = split(learners.online, sizes)
        self.target_layers = split(learners.target, sizes)
        self.gradient_layers = split(standing.gradient, sizes)
        self.now = [part[:, :batch] for part in standing.now_and_next]


def _standing_for(online: Tensor, sizes: Sizes, batch: int) -> _Standing:
    rows = len(online)
    return _Standing(
        gradient=torch.empty_like(online),
        step=torch.empty_like(online),
        now_and_next=activations_of(rows, 2 * batch, sizes),
        target_next=activations_of(rows, batch, sizes),
        scratch=activations_of(rows, batch, sizes),
    )


def _first_rows(standing: _Standing, rows: int) -> _Standing:
    return _Standing(
        standing.gradient[:rows],
        standing.step[:rows],
        [part[:rows] for part in standing.now_and_next],
        [part[:rows] for part in standing.target_next],
        [part[:rows] for part in standing.scratch],
    )
