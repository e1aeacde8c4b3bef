"""Learners in rows: each is ε-greedy over a Q-network and has DDQN updates from its own replay."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays, Bools, Float64s, Int64s, named_for, part_of
from mc_nested.learn.dqn.engine import Batch, UpdateRule
from mc_nested.learn.dqn.engines import EngineChoice, made_engine
from mc_nested.learn.dqn.prioritized import Priorities
from mc_nested.learn.dqn.replay import FIRST_ROOM, Replay, Transitions
from mc_nested.learn.dqn.self_imitation import BestEpisodes
from mc_nested.learn.dqn.states import States
from mc_nested.learn.preset import Imitation, Preset

CHOICE_NUMBERS = 2
"""Random numbers per ε-greedy choice: whether to explore, and which action then."""


class Learner:
    """Rows of one agent, each a run or a part of a run; every row learns from its own transitions only.

    Args:
        states: what its rows see and do.
        preset: its hyper-parameters.
        streams: a generator for each row's initial parameters.
        imitation: how it imitates its best episodes and how long they can be; None if it doesn't.
    """

    def __init__(
        self,
        states: States,
        preset: Preset,
        streams: list[np.random.Generator],
        imitation: tuple[Imitation, int] | None = None,
    ) -> None:
        update = preset.update
        self.states = states
        margin = imitation[0].margin if imitation else 0.0
        rule = UpdateRule(update.batch, update.learning_rate, update.target_period, update.huber_delta, margin)
        choice = EngineChoice(preset.engine, preset.device, preset.network, tuple(preset.hidden))
        self.engine = made_engine(states, choice, rule, streams)
        self.parameters = int(self.engine.online.shape[1])  # of one row's network
        self.replay = Replay(states, preset.replay_capacity)
        wanted = preset.prioritized
        self.priorities = Priorities(states.rows, FIRST_ROOM, wanted.alpha, wanted.beta) if wanted else None
        self._gamma = update.gamma
        self._learning_starts = update.learning_starts
        self._td_weight = np.float32(imitation[0].td_weight if imitation else 1.0)
        self._of_equal_weight = np.full((states.rows, update.batch), self._td_weight)
        self._not_imitated = np.zeros((states.rows, update.batch), dtype=np.bool_)
        self.best = BestEpisodes(states.rows, imitation[1], imitation[0].batch) if imitation else None

    def act(self, states: NDArray[Any], epsilon: Float64s, uniforms: Float64s, rows: Int64s | None = None) -> Int64s:
        """Return ε-greedy actions (k,) for states (k, …), ε (k,) and uniform numbers (k, 2); all rows unless named."""
        actions = (uniforms[:, 1] * self.states.actions).astype(np.int64)
        greedy = (uniforms[:, 0] >= epsilon).nonzero()[0]
        if len(greedy):
            named = greedy if rows is None else rows[greedy]
            actions[greedy] = self.engine.q_values(self.states.encoded(states[greedy]), named).argmax(-1)
        return actions

    def store(
        self,
        rows: Int64s,
        states: NDArray[Any],
        actions: Int64s,
        rewards: Float64s,
        next_states: NDArray[Any],
        terminated: Bools,
    ) -> None:
        """Store one transition for each of the named rows (k,), states (k, …); no bootstrap after termination."""
        if self.priorities and len(rows):
            self.priorities.add(rows, self.replay.added[rows] % self.replay.capacity)
        both = self.states.encoded(np.array((states, next_states)))
        self.replay.add(rows, Transitions(both, actions, rewards, self.discounts(terminated)))

    def discounts(self, terminated: Bools) -> Float64s:
        """Return the factor of the next state's value: γ, and 0 after termination."""
        return np.where(terminated, 0.0, self._gamma)

    def learn(self, rows: Int64s, uniforms: Float64s) -> None:
        """Update each named row (k,) that holds enough transitions once; numbers (k, batch) select its batch."""
        ready = self.replay.added[rows] >= self._learning_starts
        if not ready.all():
            rows, uniforms = rows[ready], uniforms[ready]
        if len(rows):
            indices, batch = self._batch(rows, uniforms)
            errors = self.engine.update(rows, batch)
            if self.priorities:
                drew = ~batch.imitated[:, -1]  # what is imitated comes first in its row, and wasn't drawn
                if drew.any():
                    own = np.where(batch.imitated, errors[:, -1:], errors)
                    self.priorities.update_priorities(rows[drew], indices[drew], own[drew])

    def state(self) -> Arrays:
        """Return networks, optimisers and priorities, by name; later updates depend on these and the replay alone."""
        return {**self.engine.state(), **named_for("priorities", self.priorities.state() if self.priorities else {})}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if the shape differs."""
        self.engine.load(state)
        if self.priorities:
            self.priorities.load(part_of(state, "priorities"))

    def _batch(self, rows: Int64s, uniforms: Float64s) -> tuple[Int64s, Batch]:
        if self.priorities:
            indices = self.priorities.sample(rows, uniforms, self.best.replaced(rows) if self.best else None)
        else:
            indices = self.replay.sample(rows, uniforms)
        drawn = self.replay.gather(rows, indices)
        imitated = self.best.mix_in(rows, drawn, uniforms) if self.best else self._not_imitated[: len(rows)]
        weights = self._of_equal_weight[: len(rows)]
        if self.priorities:
            # Imitated transitions weren't drawn, so they don't count for the largest weight either.
            indices = np.where(imitated, indices[:, -1:], indices)
            weights = self.priorities.weights(rows, indices, self.replay.sizes()[rows])
            weights[imitated] = 1.0
            weights *= self._td_weight
        return indices, Batch(drawn.states, drawn.actions, drawn.rewards, drawn.discounts, imitated, weights)
