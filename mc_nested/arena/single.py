"""The single agent's view of the arenas: ten actions, the first two of which choose the material (paper, appendix).

The main and the nested agent's actions are one set: 0 to M - 1 choose one of the M materials, the rest are the eight
building actions. The state is (x, y, b, m); m is 0 until a material is chosen, then its action + 1
(docs/explanation/task.md). The choice earns the material's p and counts as a step. A first action that is no material
ends the episode with score 0. A later material action does nothing, and counts as a step.

With parts, a later material action takes that material in hand, and counts as a step. What a material is worth is
earned block by block: a step earns what it adds to r_M, the last one also the share of the blocks that are missing.

Several single agents may share an arena (arena/cooperative), a row each. It is cleared for one material, so that one
choice has to count: that of its first builder, at the first tick. What the others do at that tick does nothing.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.spaces import Discrete
from gymnasium.vector import VectorEnv, VectorWrapper
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from mc_nested.arena.action import Action
from mc_nested.arena.env import BLOCKS_LEFT, X, Y, highest_observation, space_up_to
from mc_nested.arena.game import Resumable
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.tally import tally_of
from mc_nested.arena.vector import NO_ACTION, Foreseeing, foresees, reset_options, resumable_arenas
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s

OWN = "single_of_"
"""What the names of its own tally begin with in a snapshot; the arenas within may have one, too."""


class SingleAgentVectorEnv(VectorWrapper):
    """Arenas whose material is chosen by an action of the episode.

    Args:
        env: the arenas, autoreset disabled.
        scenarios: each row's scenario; all with the same number of materials.
        builders: how many rows in turn share an arena.
    """

    def __init__(self, env: VectorEnv[Int64s, Int64s, Any], scenarios: Sequence[Scenario], builders: int = 1) -> None:
        super().__init__(env)
        runs = env.num_envs
        self._builders = builders
        self._resumable = resumable_arenas(env)
        self.foresees = foresees(env)
        self._within: Foreseeing = env  # type: ignore[assignment]  # asked only where it foresees
        self._scenarios = tuple(scenarios)
        self._tally = tally_of(scenarios)
        self._in_parts = np.array([bool(scenario.parts) for scenario in scenarios])
        self._worth = np.array([[material.p for material in scenario.materials] for scenario in scenarios])
        self._step_limit = np.array([scenario.step_limit for scenario in scenarios])
        self._materials = self._worth.shape[1]
        highest = np.max([highest_observation(scenario) for scenario in scenarios], axis=0)
        self.single_observation_space = space_up_to(np.append(highest, self._materials))
        self.single_action_space = Discrete(self._materials + len(Action))
        self.observation_space = batch_space(self.single_observation_space, runs)
        self.action_space = batch_space(self.single_action_space, runs)
        self._first_builder = np.arange(runs) % builders == 0
        self._start = np.array([scenario.start_state for scenario in scenarios])
        self._observations = self._start.copy()
        self._chosen = np.zeros(runs, dtype=np.int64)
        self._steps = np.zeros(runs, dtype=np.int64)
        self._score = np.zeros(runs)
        self._terminated = np.zeros(runs, dtype=np.bool_)
        self._truncated = np.zeros(runs, dtype=np.bool_)

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,  # noqa: ARG002 - the arenas within begin when a material is chosen
        options: dict[str, Any] | None = None,
    ) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode in the masked arenas (all, without a mask); no material is chosen yet."""
        mask, _ = reset_options({**(options or {}), "material": np.zeros(self.num_envs, np.int64)}, self._scenarios)
        self._observations[mask] = self._start[mask]
        self._chosen[mask] = self._steps[mask] = 0
        self._score[mask] = 0.0
        self._terminated[mask] = self._truncated[mask] = False
        return self._seen(), {}

    def step(self, actions: Int64s) -> tuple[Int64s, Float64s, Bools, Bools, dict[str, Any]]:
        """Do one of the ten actions in every running arena; ``info["score"]`` is as that of the arenas within."""
        running = ~(self._terminated | self._truncated)
        first = running & (self._chosen == 0)
        chooses = first & (self._of_first_builder(actions) < self._materials)
        acts = running & ~first & (actions >= self._materials)
        rewards = np.zeros(self.num_envs)
        within: dict[str, Any] = {}
        if chooses.any():
            materials = self._of_first_builder(actions)
            self.env.reset(options={"reset_mask": chooses, "material": np.where(chooses, materials, 0)})
            self._chosen[chooses] = materials[chooses] + 1
            earns = chooses & self._first_builder
            rewards[earns] = self._worth[earns, actions[earns]]
            if self._tally:
                self._tally.begin(chooses, actions)
        if self._tally:
            takes = running & ~first & (actions < self._materials) & self._in_parts
            self._chosen[takes] = actions[takes] + 1
            self._tally.take(takes, actions)
        if acts.any():
            observations, earned, terminated, within = self._step_within(acts, actions)
            seen = running & ~first  # where another builder acts, the blocks left change
            self._observations[seen] = observations[seen]
            rewards[acts] = earned[acts]
            self._terminated |= terminated & seen
        self._terminated |= first & ~chooses
        self._steps += running
        self._truncated |= running & ~self._terminated & (self._steps >= self._step_limit)
        ended = running & (self._terminated | self._truncated)
        before = self._score.copy()
        self._score += self._of_all_builders(rewards)
        if self._tally:
            by_block = running & self._in_parts & (self._chosen > 0)
            self._score = np.where(by_block, self._tally.total(ended), self._score)
            rewards = np.where(by_block, self._score - before, rewards)
        info = {"score": np.where(ended, self._score, 0.0), "_score": ended}
        if "instead" in within:
            info |= {"instead": within["instead"] + self._materials, "_instead": within["_instead"]}
        return self._seen(), rewards, self._terminated.copy(), self._truncated.copy(), info

    def occupied(self) -> Bools:
        """Return the cells where a block landed in each arena, (runs, size, size); none before a material is chosen."""
        within: Bools = self.env.occupied()  # type: ignore[attr-defined]  # both kinds of arenas have it
        return within & (self._chosen > 0)[:, None, None]

    def _step_within(self, acts: Bools, actions: Int64s) -> tuple[Int64s, Float64s, Bools, dict[str, Any]]:
        """Do a building action in each of the masked arenas within.

        Return what they showed and earned, which terminated, and what more they said.
        """
        observations, earned, terminated, _, info = self.env.step(self._taken_within(acts, actions))
        if self._tally:
            landed = acts & (observations[:, BLOCKS_LEFT] < self._observations[:, BLOCKS_LEFT])
            self._tally.lay(landed, observations[:, X], observations[:, Y] + 1)  # in front of the agent
        return observations, earned, terminated, info

    def _taken_within(self, acts: Bools, actions: Int64s) -> Int64s:
        """Return what the arenas within take of these actions, where the mask says so."""
        within = np.where(acts, actions - self._materials, NO_ACTION)
        return np.stack((within, self._tally.in_hand), axis=1) if self._tally else within

    def expected(self, actions: Int64s) -> tuple[Int64s, Bools, Bools]:
        """Return what a step will show by the rules, where it builds, and where it goes on; no choice is ever due."""
        builds = (self._chosen > 0) & (actions >= self._materials)
        observations, goes_on, _ = self._within.expected(self._taken_within(builds, actions))
        seen = np.concatenate((observations, self._chosen[:, None]), axis=1)
        return seen, goes_on & (self._steps + 1 < self._step_limit), np.zeros_like(builds)

    def announce(self, following: Int64s) -> None:
        """Announce what is to be built next; choosing a material is no action of the arenas within."""
        self._within.announce(self._taken_within(following >= self._materials, following))

    @property
    def resumable(self) -> Resumable | None:
        """This view, if the arenas within can be resumed."""
        return self if self._resumable else None

    def snapshot(self) -> Arrays:
        """Return every arena as it stands, for ``restore``."""
        own = {f"single{name}": getattr(self, name).copy() for name in self._STATE}
        own |= {f"{OWN}{name}": kept for name, kept in self._tally.snapshot().items()} if self._tally else {}
        return {**own, **(self._resumable.snapshot() if self._resumable else {})}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put every arena back as it stood at ``snapshot``."""
        for name in self._STATE:
            setattr(self, name, snapshot[f"single{name}"].copy())
        if self._tally:
            self._tally.restore({name.removeprefix(OWN): kept for name, kept in snapshot.items() if OWN in name})
        if self._resumable:
            self._resumable.restore(snapshot)

    _STATE = ("_observations", "_chosen", "_steps", "_score", "_terminated", "_truncated")

    def _of_first_builder(self, actions: Int64s) -> Int64s:
        """Return, in each row, what the first builder of its arena does."""
        return np.repeat(actions[:: self._builders], self._builders)

    def _of_all_builders(self, rewards: Float64s) -> Float64s:
        """Return, in each row, the sum over the builders of its arena."""
        return np.repeat(rewards.reshape(-1, self._builders).sum(axis=1), self._builders)

    def _seen(self) -> Int64s:
        return np.concatenate((self._observations, self._chosen[:, None]), axis=1)
