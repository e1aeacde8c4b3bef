"""Learning agents side by side, each a row: ε-greedy over a Q-network, a replay, and DDQN updates from it."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.learn.checkpoint import Arrays, named_for, part_of
from mc_nested.learn.ddqn import DDQN, Batch, UpdateRule
from mc_nested.learn.imitation import BestEpisodes
from mc_nested.learn.networks import initial_parameters
from mc_nested.learn.preset import Imitation, Preset
from mc_nested.learn.priorities import Priorities
from mc_nested.learn.replay import FIRST_ROOM, Replay, Transitions
from mc_nested.learn.states import StateSpace

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CHOICE_NUMBERS = 2
"""Random numbers that one ε-greedy choice takes: whether to explore, and which action then."""


class Learner:
    """Rows of one agent, a run or a part of a run each; every row learns from its own transitions only.

    Args:
        space: its states and actions.
        preset: its hyper-parameters.
        streams: a generator for each row's initial parameters.
        imitation: how it imitates its own best episodes, if it does, and how long they can be.
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
        self.replay = Replay(space.rows, space.count, preset.replay_capacity)
        wanted = preset.prioritized
        self.priorities = Priorities(space.rows, FIRST_ROOM, wanted.alpha, wanted.beta) if wanted else None
        self._gamma = update.gamma
        self._learning_starts = update.learning_starts
        self.best = BestEpisodes(space.rows, imitation[1], imitation[0].batch) if imitation else None

    def act(self, states: Ints, epsilon: Floats, uniforms: Floats, rows: Ints | None = None) -> Ints:
        """ε-greedy actions (k,) for states (k, width), ε (k,) and uniform numbers (k, 2); all rows unless named."""
        values = self.ddqn.q_values(self.space.number(states), rows)
        random = (uniforms[:, 1] * self.space.actions).astype(np.int64)
        return np.where(uniforms[:, 0] < epsilon, random, values.argmax(-1))

    def remember(
        self, rows: Ints, states: Ints, actions: Ints, rewards: Floats, next_states: Ints, terminated: Bools
    ) -> None:
        """Keep one transition for each of the named rows (k,), states (k, width); termination ends the bootstrap."""
        if self.priorities and len(rows):
            self.priorities.add(rows, self.replay.added[rows] % self.replay.capacity)
        both = self.space.number(np.stack((states, next_states)))
        self.replay.add(rows, Transitions(both, actions, rewards, self.discounts(terminated)))

    def discounts(self, terminated: Bools) -> Floats:
        """What the value of the next state counts: γ, and nothing behind the end."""
        return np.where(terminated, 0.0, self._gamma)

    def learn(self, rows: Ints, uniforms: Floats) -> None:
        """One update of each named row (k,) that holds enough transitions; numbers (k, batch) draw its batch."""
        ready = self.replay.added[rows] >= self._learning_starts
        if not ready.all():
            rows, uniforms = rows[ready], uniforms[ready]
        if len(rows):
            places, batch = self._batch(rows, uniforms)
            errors = self.ddqn.update(rows, batch)
            if self.priorities:
                drawn = slice(self.best.share if self.best else 0, None)
                self.priorities.learnt(rows, places[:, drawn], errors[:, drawn])

    def state(self) -> Arrays:
        """The networks, their optimisers and the priorities, by name: with the replay, all that later updates need."""
        return {**self.ddqn.state(), **named_for("priorities", self.priorities.state() if self.priorities else {})}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        self.ddqn.load(state)
        if self.priorities:
            self.priorities.load(part_of(state, "priorities"))

    def _batch(self, rows: Ints, uniforms: Floats) -> tuple[Ints, Batch]:
        draw = self.priorities.draw if self.priorities else self.replay.draw
        places = draw(rows, uniforms)
        drawn = self.replay.at(rows, places)
        imitated = self.best.mix_in(rows, drawn, uniforms) if self.best else np.zeros(places.shape, dtype=np.bool_)
        weights = np.ones(places.shape, np.float32)
        if self.priorities:
            weights = self.priorities.weights(rows, places, self.replay.sizes()[rows])
            weights[imitated] = 1.0
        return places, Batch(drawn.states, drawn.actions, drawn.rewards, drawn.discounts, imitated, weights)
