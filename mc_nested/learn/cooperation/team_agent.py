"""The agents of a team: one main agent and k nested agents, or k independent single agents to compare with.

shared  a main agent sees (x, y, b) of builder 0 and chooses the material; one nested agent plays every builder. It sees
        (x, y, b, number, a_M), and learns from all builders' transitions: an update for each of them
own     the same states, but each builder has a nested agent of its own, which learns from its own transitions alone
single  each builder has a ten-action agent of its own, which sees (x, y, b, m) (arena/cooperative/single_team.py)

A builder alone has no number: it is the paper's nested agent, or its single agent, to the bit.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Action
from mc_nested.arena.cooperative.team import Team
from mc_nested.arena.env import highest_observation
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.errors import PresetError
from mc_nested.learn.dqn.state_space import StateSpace
from mc_nested.learn.engine_fit import NUMBERS
from mc_nested.learn.learner import CHOICE_NUMBERS, Learner, summed_by_run
from mc_nested.learn.preset import Preset
from mc_nested.learn.state_dict import named_for, part_of
from mc_nested.learn.streams import initial_stream

Kind = Literal["shared", "own", "single"]
"""How the builders of a team learn."""

KINDS: tuple[Kind, ...] = ("shared", "own", "single")


def check_team_preset(preset: Preset) -> None:
    """PresetError if the preset explores in a way that builders in one arena can't."""
    if preset.states != NUMBERS:
        raise PresetError(f"builders in one arena see numbers, not states {preset.states!r}: take the preset paper")
    for name, table in (("[excursions]", preset.excursions), ("[imagination]", preset.imagination)):
        if table:  # both replay a path, or imagine a game, in which nobody else acts
            raise PresetError(f"{name} is for a builder alone: take the preset paper, or one with [explore_nested]")


class TeamAgent:
    """A team's agents in R runs of one team.

    ``main`` is the main agent, None with single agents. ``builders`` is what builds: a row a run if it is shared, or
    a row for each run and builder.

    Args:
        kind: how the builders learn.
        team: who builds what.
        preset: the hyper-parameters of all its learners.
        seed: of the initial parameters.
        runs: each run's number (streams.py).

    Raises:
        PresetError: the preset explores in a way that builders in one arena can't.
    """

    def __init__(self, kind: Kind, team: Team, preset: Preset, seed: int, runs: Sequence[int]) -> None:
        check_team_preset(preset)
        self.kind = kind
        self.team = team
        self.runs = tuple(runs)
        streams = [initial_stream(seed, run) for run in self.runs]
        materials = len(team.scenario.materials)
        observed = highest_observation(team.scenario)
        self._has_main = kind != "single"
        self._rows_a_run = 1 if kind == "shared" else team.builders
        self._has_number = self._has_main and team.builders > 1
        self.main = (
            Learner(
                StateSpace(np.tile(observed, (len(runs), 1)), materials, preset.encoding), preset.for_main(), streams
            )
            if self._has_main
            else None
        )
        appended = [materials - 1] if self._has_main else [materials]
        number = [team.builders - 1] if self._has_number else []
        highest = np.concatenate((observed, np.array([*number, *appended])))
        actions = len(Action) + (0 if self._has_main else materials)
        self.builders = Learner(
            StateSpace(np.tile(highest, (len(runs) * self._rows_a_run, 1)), actions, preset.encoding),
            preset,
            [stream for stream in streams for _ in range(self._rows_a_run)],
        )

    def states(self, observations: Int64s, materials: Int64s) -> Int64s:
        """The builders' states (runs, k, width), of what they observe (runs, k, …) and the materials (runs,)."""
        if not self._has_main:
            return observations
        runs, k, _ = observations.shape
        chosen = np.broadcast_to(materials[:, None, None], (runs, k, 1))
        numbers = np.broadcast_to(np.arange(k)[None, :, None], (runs, k, int(self._has_number)))
        return np.concatenate((observations, numbers, chosen), axis=2)

    def rows(self, runs: Int64s, builder: int) -> Int64s:
        """The rows of ``builders`` that play that builder in the named runs (n,)."""
        return runs if self._rows_a_run == 1 else runs * self._rows_a_run + builder

    def chosen_materials(self, observations: Int64s) -> Int64s:
        """The materials that single agents' observations (runs, k, 4) show as chosen, (runs,); -1 before the choice."""
        return observations[:, 0, -1] - 1

    def choose(self, runs: Int64s, epsilon: Float64s, uniforms: Float64s) -> Int64s:
        """The main agent's ε-greedy materials in the named runs (n,); 0 where there is no main agent."""
        if self.main is None:
            return np.zeros(len(runs), dtype=np.int64)
        return self.main.act(self.main_states(len(runs)), epsilon, uniforms, runs)

    def main_states(self, runs: int) -> Int64s:
        """What the main agent decides on, once a run: builder 0's cell and all blocks, (runs, 3)."""
        return np.tile((*self.team.starts[0], self.team.scenario.blocks), (runs, 1))

    def act(self, states: Int64s, epsilon: Float64s, uniforms: Float64s) -> Int64s:
        """Each builder's ε-greedy action in every run, (runs, k); ``uniforms`` are (runs, k * CHOICE_NUMBERS)."""
        every = np.arange(len(states))
        of_builder = uniforms.reshape(len(states), self.team.builders, CHOICE_NUMBERS)
        chosen = [
            self.builders.act(states[:, builder], epsilon, of_builder[:, builder], self.rows(every, builder))
            for builder in range(self.team.builders)
        ]
        return np.stack(chosen, axis=1)

    def store(
        self, runs: Int64s, states: Int64s, actions: Int64s, rewards: Float64s, next_states: Int64s, ended: Bools
    ) -> None:
        """Store a tick of the named runs (n,): a transition for each builder, by number; arrays are (n, k, …)."""
        for builder in range(self.team.builders):
            seen = states[:, builder], actions[:, builder], rewards[:, builder], next_states[:, builder]
            self.builders.store(self.rows(runs, builder), *seen, ended)

    def learn(self, runs: Int64s, draws: Float64s) -> None:
        """The updates of a tick in the named runs (n,): for each builder those of ``draws`` (n, k, updates, batch)."""
        for builder in range(self.team.builders):
            for update in range(draws.shape[2]):
                self.builders.learn(self.rows(runs, builder), draws[:, builder, update])

    @property
    def networks(self) -> int:
        """Networks that one run trains."""
        return self._rows_a_run + self._has_main

    @property
    def parameters(self) -> int:
        """Parameters of one run's networks, target networks not counted."""
        main = self.main.parameters if self.main else 0
        return main + self._rows_a_run * self.builders.parameters

    @property
    def updates(self) -> int:
        """Updates done, over all runs and agents."""
        return sum(int(learner.engine.updates.sum()) for learner in self._learners().values())

    @property
    def updates_by_run(self) -> Int64s:
        """Updates of all of a run's networks, (runs,)."""
        return summed_by_run((learner.engine.updates for learner in self._learners().values()), len(self.runs))

    @property
    def replay_bytes(self) -> Int64s:
        """Bytes of what each run's replays hold, all its agents' together, (runs,)."""
        return summed_by_run((learner.replay.bytes_held() for learner in self._learners().values()), len(self.runs))

    def online(self) -> Arrays:
        """The online networks' parameters, by role: what acting needs."""
        return {role: learner.engine.online for role, learner in self._learners().items()}

    def load_online(self, online: Mapping[str, NDArray[Any]]) -> None:
        """Load online networks, by role, a row for each of the learner's; ValueError if their shape differs."""
        for role, learner in self._learners().items():
            learner.engine.load_online(online[role])

    def rows_of(self, run: int) -> dict[str, slice]:
        """A run's rows, by role."""
        own = slice(run * self._rows_a_run, (run + 1) * self._rows_a_run)
        return {"main": slice(run, run + 1), "builders": own}

    def state(self) -> Arrays:
        """What later choices and updates depend on, by name; without the transitions."""
        return {k: v for role, learner in self._learners().items() for k, v in named_for(role, learner.state()).items()}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if the shape differs."""
        for role, learner in self._learners().items():
            learner.load(part_of(state, role))

    def marks(self) -> Arrays:
        """Where a journal of the transitions ends now, for ``transitions_since``."""
        learners = self._learners().items()
        return {k: v for role, learner in learners for k, v in named_for(role, learner.replay.marks()).items()}

    def transitions_since(self, marks: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """What ``store_again`` needs to know since those marks; everything if there are none."""
        found: Arrays = {}
        for role, learner in self._learners().items():
            added = learner.replay.added_since(part_of(marks, role) if marks else None)
            found |= named_for(role, added)
        return found

    def store_again(self, transitions: Mapping[str, NDArray[Any]]) -> None:
        """Store what ``transitions_since`` returned; KeyError or ValueError if the shape differs."""
        for role, learner in self._learners().items():
            learner.replay.extend(part_of(transitions, role))

    def _learners(self) -> dict[str, Learner]:
        return {"main": self.main, "builders": self.builders} if self.main else {"builders": self.builders}
