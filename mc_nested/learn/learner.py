"""Learners in rows: each is ε-greedy over a Q-network and has DDQN updates from its own replay."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.dqn.ddqn import DDQN, Batch, UpdateRule
from mc_nested.learn.dqn.networks import initial_parameters
from mc_nested.learn.dqn.prioritized import Priorities
from mc_nested.learn.dqn.replay import FIRST_ROOM, Replay, Transitions
from mc_nested.learn.dqn.self_imitation import BestEpisodes
from mc_nested.learn.dqn.state_space import StateSpace
from mc_nested.learn.preset import Imitation, Preset
from mc_nested.learn.state_dict import named_for, part_of

CHOICE_NUMBERS = 2
"""Random numbers per ε-greedy choice: whether to explore, and which action then."""


class Learner:
    """Rows of one agent, each a run or a part of a run; every row learns from its own transitions only.

    Args:
        space: its states and actions.
        preset: its hyper-parameters.
        streams: a generator for each row's initial parameters.
        imitation: how it imitates its best episodes and how long they can be; None if it doesn't.
    """

    def __init__(
        self,
        space: StateSpace,
        preset: Preset,
        streams: list[np.random.Generator],
        imitation: tuple[Imitation, int] | None = None,
    ) -> None:
        sizes = space.network(preset.hidden)
        update = preset.update
        self.space = space
        self.ddqn = DDQN(
            space,
            sizes,
            UpdateRule(
                update.batch,
                update.learning_rate,
                update.target_period,
                update.huber_delta,
                imitation[0].margin if imitation else 0.0,
            ),
            np.stack([initial_parameters(sizes, stream) for stream in streams]),
        )
        self.replay = Replay(space.rows, space.count, space.actions, preset.replay_capacity)
        wanted = preset.prioritized
        self.priorities = Priorities(space.rows, FIRST_ROOM, wanted.alpha, wanted.beta) if wanted else None
        self._gamma = update.gamma
        self._learning_starts = update.learning_starts
        self._td_weight = np.float32(imitation[0].td_weight if imitation else 1.0)
        self.best = BestEpisodes(space.rows, imitation[1], imitation[0].batch) if imitation else None

    def act(self, states: Int64s, epsilon: Float64s, uniforms: Float64s, rows: Int64s | None = None) -> Int64s:
        """ε-greedy actions (k,) for states (k, width), ε (k,) and uniform numbers (k, 2); all rows unless named."""
        values = self.ddqn.q_values(self.space.index(states), rows)
        random = (uniforms[:, 1] * self.space.actions).astype(np.int64)
        return np.where(uniforms[:, 0] < epsilon, random, values.argmax(-1))

    def store(
        self, rows: Int64s, states: Int64s, actions: Int64s, rewards: Float64s, next_states: Int64s, terminated: Bools
    ) -> None:
        """Store one transition for each of the named rows (k,), states (k, width); no bootstrap after termination."""
        if self.priorities and len(rows):
            self.priorities.add(rows, self.replay.added[rows] % self.replay.capacity)
        both = self.space.index(np.stack((states, next_states)))
        self.replay.add(rows, Transitions(both, actions, rewards, self.discounts(terminated)))

    def discounts(self, terminated: Bools) -> Float64s:
        """The factor of the next state's value: γ, and 0 after termination."""
        return np.where(terminated, 0.0, self._gamma)

    def learn(self, rows: Int64s, uniforms: Float64s) -> None:
        """One update of each named row (k,) that holds enough transitions; numbers (k, batch) select its batch."""
        ready = self.replay.added[rows] >= self._learning_starts
        if not ready.all():
            rows, uniforms = rows[ready], uniforms[ready]
        if len(rows):
            indices, batch = self._batch(rows, uniforms)
            errors = self.ddqn.update(rows, batch)
            drew = ~batch.imitated[:, -1]  # what is imitated comes first in its row, and wasn't drawn
            if self.priorities and drew.any():
                own = np.where(batch.imitated, errors[:, -1:], errors)
                self.priorities.update_priorities(rows[drew], indices[drew], own[drew])

    def state(self) -> Arrays:
        """The networks, optimisers and priorities, by name: with the replay, all that later updates depend on."""
        return {**self.ddqn.state(), **named_for("priorities", self.priorities.state() if self.priorities else {})}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if the shape differs."""
        self.ddqn.load(state)
        if self.priorities:
            self.priorities.load(part_of(state, "priorities"))

    def _batch(self, rows: Int64s, uniforms: Float64s) -> tuple[Int64s, Batch]:
        if self.priorities:
            indices = self.priorities.sample(rows, uniforms, self.best.replaced(rows) if self.best else None)
        else:
            indices = self.replay.sample(rows, uniforms)
        drawn = self.replay.gather(rows, indices)
        imitated = self.best.mix_in(rows, drawn, uniforms) if self.best else np.zeros(indices.shape, dtype=np.bool_)
        weights = np.ones(indices.shape, np.float32)
        if self.priorities:
            # What is imitated wasn't drawn: it has no part in the largest weight either.
            indices = np.where(imitated, indices[:, -1:], indices)
            weights = self.priorities.weights(rows, indices, self.replay.sizes()[rows])
            weights[imitated] = 1.0
        weights *= self._td_weight
        return indices, Batch(drawn.states, drawn.actions, drawn.rewards, drawn.discounts, imitated, weights)
