"""Learning agents side by side, each a row: ε-greedy over a Q-network, a replay, and DDQN updates from it."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from mc_nested.learn.ddqn import DDQN, Batch, UpdateRule
from mc_nested.learn.networks import initial_parameters
from mc_nested.learn.preset import Preset
from mc_nested.learn.replay import Replay, Transitions

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CHOICE_NUMBERS = 2
"""Random numbers that one ε-greedy choice takes: whether to explore, and which action then."""


@dataclass(frozen=True)
class StateSpace:
    """What a learner sees and does: the highest value of each integer of its state, (rows, width), and its actions."""

    highest: Ints
    actions: int


class Learner:
    """Rows of one agent, a run or a part of a run each; every row learns from its own transitions only.

    Args:
        space: its states and actions.
        preset: its hyper-parameters.
        streams: a generator for each row's initial parameters.
    """

    def __init__(self, space: StateSpace, preset: Preset, streams: list[np.random.Generator]) -> None:
        runs, width = space.highest.shape
        sizes = (width, *preset.hidden, space.actions)
        update = preset.update
        self.ddqn = DDQN(
            sizes,
            UpdateRule(update.batch, update.learning_rate, update.gamma, update.target_period, update.huber_delta),
            torch.from_numpy(np.stack([initial_parameters(sizes, stream) for stream in streams])),
        )
        self.replay = Replay(runs, width, preset.replay_capacity)
        self._actions = space.actions
        self._learning_starts = update.learning_starts
        self._highest = torch.from_numpy(space.highest).float()
        # A part of the state that has one value only (a single material) comes out as 0.
        self._spread = self._highest.clamp(min=1)

    def encode(self, states: NDArray[Any], rows: Ints | slice = slice(None)) -> torch.Tensor:
        """Each integer of the state scaled to [-1, 1] (README: the task): (k, …, width) of the named rows."""
        highest, spread = self._highest[rows], self._spread[rows]
        if states.ndim > highest.ndim:
            highest, spread = highest[:, None], spread[:, None]
        return torch.from_numpy(states).float().mul_(2).sub_(highest).div_(spread)

    def act(self, states: Ints, epsilon: Floats, uniforms: Floats, rows: Ints | None = None) -> Ints:
        """ε-greedy actions (k,) for states (k, width), ε (k,) and uniform numbers (k, 2); all rows unless named."""
        if rows is None:
            values = self.ddqn.q_values(self.encode(states))
        else:
            values = self.ddqn.q_values(self.encode(states, rows), torch.from_numpy(rows))
        random = (uniforms[:, 1] * self._actions).astype(np.int64)
        return np.where(uniforms[:, 0] < epsilon, random, values.argmax(-1).numpy())

    def learn(self, rows: Ints, uniforms: Floats) -> None:
        """One update of each named row (k,) that holds enough transitions; numbers (k, batch) draw its batch."""
        ready = self.replay.added[rows] >= self._learning_starts
        if not ready.all():
            rows, uniforms = rows[ready], uniforms[ready]
        if len(rows):
            self.ddqn.update(torch.from_numpy(rows), self._encoded(rows, self.replay.sample(rows, uniforms)))

    def state(self) -> dict[str, torch.Tensor]:
        """Everything later choices and updates depend on, by name."""
        replay = {f"replay.{name}": torch.from_numpy(kept) for name, kept in self.replay.state().items()}
        return {**{f"ddqn.{name}": kept for name, kept in self.ddqn.state().items()}, **replay}

    def load(self, state: dict[str, torch.Tensor]) -> None:
        """Go on from what ``state`` gave; KeyError, ValueError or RuntimeError where it is of another shape."""
        self.load_networks(state)
        self.replay.load({name.removeprefix("replay."): kept.numpy() for name, kept in state.items()})

    def load_networks(self, state: dict[str, torch.Tensor]) -> None:
        """Take over the networks and their optimiser alone."""
        self.ddqn.load({name.removeprefix("ddqn."): kept for name, kept in state.items()})

    def _encoded(self, rows: Ints, drawn: Transitions) -> Batch:
        states = np.concatenate((drawn.states, drawn.next_states), axis=1)
        return Batch(
            states=self.encode(states, rows),
            actions=torch.from_numpy(drawn.actions).long(),
            rewards=torch.from_numpy(drawn.rewards),
            terminated=torch.from_numpy(drawn.terminated),
        )
