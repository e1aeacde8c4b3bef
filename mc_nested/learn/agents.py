"""The paper's three agents: who acts, and what is appended to whose state (paper, sections 4 and 5, appendix).

nested        a main agent chooses the material on (x, y, b); one nested agent does the rest on (x, y, b, a_M)
hierarchical  a top agent chooses the material on (x, y, b), and with it which low agent does the rest on (x, y, b)
single        one agent does it all on (x, y, b, m), in ten actions (arena/single.py)
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from gymnasium.vector import VectorEnv
from numpy.typing import NDArray
from pydantic import AfterValidator

from mc_nested.arena.rules import SIZE, Action
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.errors import PresetError
from mc_nested.learn.checkpoint import Arrays, named_for, part_of
from mc_nested.learn.learner import Floats, Ints, Learner
from mc_nested.learn.networks import Sizes, parameter_count
from mc_nested.learn.preset import Preset
from mc_nested.learn.states import StateSpace
from mc_nested.learn.streams import initial_stream


@dataclass(frozen=True)
class Form:
    """What makes one of the agents another.

    ``has_main``: a main (top) agent chooses the material before the first move. ``appends_material``: its choice is
    appended to the low agent's state. ``one_low_a_material``: each material has a low agent of its own.
    ``sees_choice``: an agent that chooses the material itself sees which; without it x, y and b alone.
    """

    has_main: bool
    appends_material: bool
    one_low_a_material: bool
    sees_choice: bool

    @property
    def width(self) -> int:
        """Integers in the low agent's state: x, y, b, and the material where it is told or seen."""
        return 4 if self.appends_material or self.sees_choice else 3


FORMS: Mapping[str, Form] = {
    "nested": Form(has_main=True, appends_material=True, one_low_a_material=False, sees_choice=False),
    "hierarchical": Form(has_main=True, appends_material=False, one_low_a_material=True, sees_choice=False),
    "single": Form(has_main=False, appends_material=False, one_low_a_material=False, sees_choice=True),
}
"""The agents that can be trained, by name."""


def check_exploration(form: Form, preset: Preset) -> None:
    """PresetError where the preset explores in a way that the form can't."""
    if preset.excursions and not form.has_main:  # its choice of a material is a step like any other
        raise PresetError("[excursions] are not for the single agent: take nested or hierarchical, or the preset paper")


def _known(name: str) -> str:
    if name not in FORMS:
        raise ValueError(f"must be one of {', '.join(FORMS)}")
    return name


AgentName = Annotated[str, AfterValidator(_known)]
"""The name of one of FORMS, in a file that pydantic checks."""


class Agent:
    """One of the paper's agents in R runs, one scenario a run.

    ``main`` is the main or top agent, None for the single agent; ``low`` is the nested agent, the low agents (a row for
    each run and material), or the single agent.

    Args:
        form: which agent.
        scenarios: each run's scenario; all with the same number of materials.
        preset: the hyper-parameters of all its learners.
        seed: of the initial parameters.
        runs: each run's number (streams.py); from 0 on unless named.

    Raises:
        PresetError: where the preset explores in a way that the form can't.
    """

    def __init__(
        self, form: Form, scenarios: Sequence[Scenario], preset: Preset, seed: int, runs: Sequence[int] | None = None
    ) -> None:
        check_exploration(form, preset)
        self.runs = tuple(range(len(scenarios)) if runs is None else runs)
        streams = [initial_stream(seed, run) for run in self.runs]
        materials = len(scenarios[0].materials)
        observed = np.array([[SIZE - 1, SIZE - 1, scenario.blocks] for scenario in scenarios])
        self.form = form
        encoding = preset.encoding
        self.main = Learner(StateSpace(observed, materials, encoding), preset, streams) if form.has_main else None
        self._lows = materials if form.one_low_a_material else 1
        appended = np.full((len(scenarios), 1), _highest_appended(form, materials))[:, : form.width - 3]
        highest = np.hstack([observed, appended])
        actions = len(Action) + (0 if form.has_main else materials)
        longest = max(scenario.step_limit for scenario in scenarios)
        self.low = Learner(
            StateSpace(np.repeat(highest, self._lows, axis=0), actions, encoding),
            preset,
            [stream for stream in streams for _ in range(self._lows)],
            (preset.imitation, longest) if preset.imitation else None,
        )

    @property
    def observed(self) -> int:
        """Integers that the env shows in this agent's view of it."""
        return 3 if self.main else 4

    def low_states(self, observations: Ints, materials: Ints) -> Ints:
        """What the low agents decide on, (runs, width): for the nested agent s_N = [s_M, a_M] (paper, section 4.1)."""
        if not self.form.appends_material:
            return observations[:, : self.form.width]
        return np.concatenate((observations, materials[:, None]), axis=1)

    def low_rows(self, runs: Ints, materials: Ints) -> Ints:
        """The rows of ``low`` that act in the named runs (k,), for the materials of all runs (runs,)."""
        if self._lows == 1:
            return runs
        return runs * self._lows + materials[runs]

    def act(self, states: Ints, materials: Ints, epsilon: Floats, uniforms: Floats) -> Ints:
        """The low agents' ε-greedy actions in every run, (runs,)."""
        rows = None if self._lows == 1 else self.low_rows(np.arange(len(states)), materials)
        return self.low.act(states, epsilon, uniforms, rows)

    @property
    def sizes(self) -> dict[str, Sizes]:
        """The widths of the networks, by role."""
        return {role: learner.ddqn.sizes for role, learner in self._learners().items()}

    @property
    def networks(self) -> int:
        """Networks that one run trains: 2 nested, 3 hierarchical with two materials, 1 single (paper, section 6)."""
        return self._lows + (self.main is not None)

    @property
    def parameters(self) -> int:
        """Parameters of one run's networks, target networks not counted."""
        main = parameter_count(self.main.ddqn.sizes) if self.main else 0
        return main + self._lows * parameter_count(self.low.ddqn.sizes)

    @property
    def updates(self) -> int:
        """Updates done, over all runs and agents."""
        return sum(int(learner.ddqn.updates.sum()) for learner in self._learners().values())

    def last_figures(self) -> Arrays:
        """Loss and mean Q of each run's last updates, (runs,), by name; nan where an agent hasn't learnt yet.

        Of several low agents of a run, the mean over those that have learnt.
        """
        figures = {}
        for role, learner in self._learners().items():
            for name, values in (("loss", learner.ddqn.last_loss()), ("q", learner.ddqn.last_q())):
                of_run = values.reshape(len(self.runs), -1)
                known = np.isfinite(of_run)
                total = np.where(known, of_run, 0.0).sum(axis=1)
                figures[f"{name}/{role}"] = np.where(
                    known.any(axis=1), total / np.maximum(known.sum(axis=1), 1), np.nan
                )
        return figures

    def state(self) -> Arrays:
        """All that later choices and updates depend on but the transitions, by name."""
        return {k: v for role, learner in self._learners().items() for k, v in named_for(role, learner.state()).items()}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        for role, learner in self._learners().items():
            learner.load(part_of(state, role))

    def networks_state(self) -> Arrays:
        """The networks and their optimisers, by name: enough to act."""
        return {
            k: v for role, learner in self._learners().items() for k, v in named_for(role, learner.ddqn.state()).items()
        }

    def load_networks(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take over the networks; KeyError or ValueError where they are of another shape."""
        for role, learner in self._learners().items():
            learner.ddqn.load(part_of(state, role))

    def online(self) -> Arrays:
        """The online networks' parameters, by role: what acting takes."""
        return {role: learner.ddqn.online for role, learner in self._learners().items()}

    def take_over(self, online: Mapping[str, NDArray[Any]]) -> None:
        """Give every run one run's online networks, by role; ValueError where they are of another shape."""
        for role, learner in self._learners().items():
            learner.ddqn.take_over(np.tile(online[role], (len(self.runs), 1)))

    def rows_of(self, run: int) -> dict[str, slice]:
        """A run's rows, by role."""
        return {"main": slice(run, run + 1), "low": slice(run * self._lows, (run + 1) * self._lows)}

    def marks(self) -> Arrays:
        """How many transitions each row has remembered so far, by role."""
        return {role: learner.replay.added.copy() for role, learner in self._learners().items()}

    def transitions_since(self, marks: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """What was remembered since those marks; everything without them."""
        return {
            k: v
            for role, learner in self._learners().items()
            for k, v in named_for(
                role, learner.replay.added_since(marks[role] if marks else np.zeros_like(learner.replay.added))
            ).items()
        }

    def remember_again(self, transitions: Mapping[str, NDArray[Any]]) -> None:
        """Take back what ``transitions_since`` gave; KeyError or ValueError where it is of another shape."""
        for role, learner in self._learners().items():
            learner.replay.extend(part_of(transitions, role))

    def forget_since(self, marks: Mapping[str, NDArray[Any]]) -> None:
        """Forget what was remembered since those marks."""
        for role, learner in self._learners().items():
            learner.replay.forget_since(marks[role])

    def networks_of(self, run: int) -> Arrays:
        """One run's networks, for ``load_networks`` of an agent in that run alone."""
        rows = self.rows_of(run)
        return {name: kept[rows[name.split(".")[0]]] for name, kept in self.networks_state().items()}

    def _learners(self) -> dict[str, Learner]:
        return {"main": self.main, "low": self.low} if self.main else {"low": self.low}


def view_of(form: Form, env: VectorEnv[Ints, Ints, Any], scenarios: Sequence[Scenario]) -> VectorEnv[Ints, Ints, Any]:
    """The arenas as that agent sees them: the single agent's actions include the choice of a material."""
    return env if form.has_main else SingleAgentVectorEnv(env, scenarios)


def chosen_materials(observations: Ints) -> Ints:
    """The materials that the single agent's observations (runs, 4) show as chosen, -1 before the choice."""
    return observations[:, 3] - 1


def _highest_appended(form: Form, materials: int) -> int:
    # The single agent's m is 0 before the choice: one value more than there are materials.
    return materials - 1 if form.appends_material else materials
