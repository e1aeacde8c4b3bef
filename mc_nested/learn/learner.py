"""Learning agents side by side, each a row: ε-greedy over a Q-network, a replay, and DDQN updates from it."""

import numpy as np
from numpy.typing import NDArray

from mc_nested.learn.ddqn import DDQN, Batch, UpdateRule
from mc_nested.learn.imitation import BestEpisodes
from mc_nested.learn.networks import initial_parameters
from mc_nested.learn.preset import Imitation, Preset
from mc_nested.learn.replay import Replay, Transitions
from mc_nested.learn.states import StateSpace

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CHOICE_NUMBERS = 2
"""Random numbers that one ε-greedy choice takes: whether to explore, and which action then."""

MOST_OF_THEM = 0.75
"""From this share of the rows on, all are updated as they lie and the others' updates dropped: cheaper than copies."""


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
        sizes = (space.inputs, *preset.hidden, space.actions)
        update = preset.update
        self.space = space
        self.ddqn = DDQN(
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
        self._gamma = update.gamma
        self._learning_starts = update.learning_starts
        self._every_row = np.arange(space.rows)
        self.best = BestEpisodes(space.rows, imitation[1], imitation[0].batch) if imitation else None

    def act(self, states: Ints, epsilon: Floats, uniforms: Floats, rows: Ints | None = None) -> Ints:
        """ε-greedy actions (k,) for states (k, width), ε (k,) and uniform numbers (k, 2); all rows unless named."""
        inputs = self.space.inputs_for(self.space.number(states)[:, None], self._every_row if rows is None else rows)
        random = (uniforms[:, 1] * self.space.actions).astype(np.int64)
        return np.where(uniforms[:, 0] < epsilon, random, self.ddqn.q_values(inputs, rows).argmax(-1))

    def remember(
        self, rows: Ints, states: Ints, actions: Ints, rewards: Floats, next_states: Ints, terminated: Bools
    ) -> None:
        """Keep one transition for each of the named rows (k,), states (k, width); termination ends the bootstrap."""
        number = self.space.number
        self.replay.add(
            rows, Transitions(number(states), actions, rewards, number(next_states), self.discounts(terminated))
        )

    def discounts(self, terminated: Bools) -> Floats:
        """What the value of the next state counts: γ, and nothing behind the end."""
        return np.where(terminated, 0.0, self._gamma)

    def learn(self, rows: Ints, uniforms: Floats) -> None:
        """One update of each named row (k,) that holds enough transitions; numbers (k, batch) draw its batch."""
        ready = self.replay.added[rows] >= self._learning_starts
        if not ready.all():
            rows, uniforms = rows[ready], uniforms[ready]
        if len(rows) >= MOST_OF_THEM * self.space.rows:
            active = np.zeros(self.space.rows, dtype=np.bool_)
            active[rows] = True
            numbers = np.zeros((self.space.rows, uniforms.shape[1]))
            numbers[rows] = uniforms
            self.ddqn.update_all(self._batch(self._every_row, numbers), active)
        elif len(rows):
            self.ddqn.update_some(rows, self._batch(rows, uniforms))

    def _batch(self, rows: Ints, uniforms: Floats) -> Batch:
        drawn = self.replay.sample(rows, uniforms)
        imitated = self.best.mix_in(rows, drawn, uniforms) if self.best else None
        both = np.stack((drawn.states, drawn.next_states))
        return Batch(self.space.inputs_for(both, rows), drawn.actions, drawn.rewards, drawn.discounts, imitated)
