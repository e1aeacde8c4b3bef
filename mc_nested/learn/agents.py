"""The paper's three agents: which agent acts, and what is appended to its state (paper, sections 4 and 5, appendix).

nested        a main agent sees (x, y, b) and chooses the material; one nested agent sees (x, y, b, a_M) and builds
hierarchical  a top agent sees (x, y, b) and chooses the material, and with it the low-level agent, which sees
              (x, y, b) and builds
single        one agent sees (x, y, b, m) and does all of it, in ten actions (arena/single.py)

Where several builders share an arena (builders.py), each has a row beside the others of its run.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from gymnasium.vector import VectorEnv
from numpy.typing import NDArray

from mc_nested.arena.action import Action
from mc_nested.arena.env import BLOCKS_LEFT, highest_observation
from mc_nested.arena.planes import FULL, PLANES, PlanesVectorEnv, common_size, shares, start_planes, with_material
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arrays import Arrays, Float64s, Int64s, named_parts, part_of
from mc_nested.errors import PresetError
from mc_nested.learn.builders import Builders, check_builders
from mc_nested.learn.dqn.engine import NetworkForm
from mc_nested.learn.dqn.engines import NUMBERS, SCREEN
from mc_nested.learn.dqn.replay import ReplayMark
from mc_nested.learn.dqn.states import ORDER_PLANES, REACH_PLANES, PlaneStates, Sees, States, StateSpace
from mc_nested.learn.learner import CHOICE_NUMBERS, Learner
from mc_nested.learn.objectives.arenas import side_for
from mc_nested.learn.preset import Preset
from mc_nested.learn.streams import Purpose, stream
from mc_nested.toml_file import one_of

IMAGE = "image"
"""The states that are the arena from above."""

SCREEN_SHAPE = (4, 84, 84)
"""The window's last four pictures, small and grey (live/screen_arenas.py)."""


@dataclass(frozen=True)
class AgentSpec:
    """How an agent is put together.

    ``has_main``: a main (top) agent chooses the material before the first move. ``appends_material``: its choice is
    appended to the low-level agent's state. ``low_level_per_material``: each material has its own low-level agent.
    ``sees_choice``: an agent that chooses the material itself sees its choice; otherwise only x, y and b.
    """

    has_main: bool
    appends_material: bool
    low_level_per_material: bool
    sees_choice: bool


AGENT_SPECS: Mapping[str, AgentSpec] = {
    "nested": AgentSpec(has_main=True, appends_material=True, low_level_per_material=False, sees_choice=False),
    "hierarchical": AgentSpec(has_main=True, appends_material=False, low_level_per_material=True, sees_choice=False),
    "single": AgentSpec(has_main=False, appends_material=False, low_level_per_material=False, sees_choice=True),
}
"""The agents that can be trained, by name."""


def check_exploration(spec: AgentSpec, preset: Preset) -> None:
    """Raise PresetError if the preset explores in a way, or sees what, the spec can't."""
    if preset.objectives and not spec.appends_material:  # an objective is added to the nested agent's state
        raise PresetError("[objectives] is for the nested agent: take that, or the preset paper")
    if spec.has_main:
        return
    if preset.states == SCREEN:  # it chooses a material in the game, where no window shows which
        raise PresetError('states "screen" are not for the single agent: take nested or hierarchical')
    for name, table in ((f"[{name}]", getattr(preset, name)) for name in ("excursions", "imagination")):
        if table:  # its choice of a material is a step like any other
            raise PresetError(f"{name} is not for the single agent: take nested or hierarchical, or the preset paper")


def check_parts(scenarios: Sequence[Scenario], preset: Preset) -> None:
    """Raise PresetError if the preset can't learn in scenarios with parts."""
    in_parts = next((scenario for scenario in scenarios if scenario.parts), None)
    if preset.imagination and in_parts:  # what a cell pays would depend on the part
        raise PresetError(f"[imagination] knows no parts, and {in_parts.name} has some: take the preset tuned or paper")


AgentName = Annotated[str, one_of(AGENT_SPECS)]
"""The name of one of AGENT_SPECS, in a file that pydantic checks."""


class Agent:
    """One of the paper's agents in R runs, one scenario a run.

    ``main`` is the main or top agent, None for the single agent. ``low_level`` is the nested agent, the low-level
    agents of the hierarchy (a row for each run and material), or the single agent; builders that don't share a network
    have a row each. ``size`` is the largest arena's, ``builders`` how many share an arena. ``nested_sees`` is what the
    nested agent is shown, where the main agent's actions are objectives.

    One run trains so many ``networks``, 2 nested, 3 hierarchical with two materials, 1 single (paper, section 6), with
    so many ``parameters``, target networks not counted.

    Args:
        spec: which agent.
        scenarios: each run's scenario; all with the same number of materials.
        preset: the hyper-parameters of all its learners.
        seed: of the initial parameters.
        runs: each run's number (streams.py); from 0 on unless named.
        team: who builds in each run's arena; one builder, from the scenario's start, unless given.

    Raises:
        PresetError: the preset explores in a way that such an agent, or several builders, can't.
    """

    def __init__(
        self,
        spec: AgentSpec,
        scenarios: Sequence[Scenario],
        preset: Preset,
        seed: int,
        runs: Sequence[int] | None = None,
        team: Builders | None = None,
    ) -> None:
        if team:
            check_builders(preset)
        check_exploration(spec, preset)
        check_parts(scenarios, preset)
        self.runs = tuple(range(len(scenarios)) if runs is None else runs)
        streams = [stream(Purpose.INITIAL, seed, run) for run in self.runs]
        self._materials = len(scenarios[0].materials)
        self.size = max(scenario.size for scenario in scenarios)
        self.spec = spec
        self._sees = preset.states
        self.nested_sees: Sees = preset.objectives.nested_sees if preset.objectives else "everything"
        self._team = team
        self.builders = team.count if team else 1
        self._low_levels = self._materials if spec.low_level_per_material else 1
        self._numbered = spec.appends_material and self.builders > 1
        self._share_a_row = self.builders if team and team.networks == "shared" else 1
        self._rows_a_run = self._low_levels * self.builders // self._share_a_row
        self._low_level_actions = len(Action) + (0 if spec.has_main else self._materials)
        if self._sees == NUMBERS:
            chooses, builds = self._numbers(scenarios, preset.encoding)
        elif preset.objectives:
            chooses, builds = self._objectives(len(scenarios), side_for(preset.objectives.largest))
        else:
            shape = SCREEN_SHAPE if self._sees == SCREEN else (PLANES, *(common_size(scenarios),) * 2)
            chooses, builds = self._planes(len(scenarios), shape)
        self.main = Learner(chooses, preset.for_main(), streams) if spec.has_main else None
        self._longest = self._share_a_row * max(scenario.step_limit for scenario in scenarios)
        each = [stream for stream in streams for _ in range(self._rows_a_run)]
        imitation = (preset.imitation, self._longest) if preset.imitation else None
        self.low_level = Learner(builds, preset, each, imitation)
        self.networks = self._rows_a_run + (self.main is not None)
        self.parameters = self._rows_a_run * self.low_level.parameters + (self.main.parameters if self.main else 0)

    def low_level_states(self, observations: NDArray[Any], materials: Int64s) -> NDArray[Any]:
        """Return the low-level agents' states, (runs * builders, …); the nested agent's s_N = [s_M, a_M] (section 4.1).

        ``materials`` are (runs,). To numbers, a_M is one number more. To planes, it is one plane more: "one extra
        dimension".
        """
        if not self.spec.appends_material:
            return observations[:, : (BLOCKS_LEFT + 1 if self._sees == NUMBERS else PLANES) + self.spec.sees_choice]
        if self._sees != NUMBERS:
            return with_material(observations, shares(materials + 1, self._materials))
        if not self._numbered:
            return np.concatenate((observations, materials[:, None]), axis=1)
        numbers = np.tile(np.arange(self.builders), len(materials))
        return np.column_stack((observations, numbers, self._of_builders(materials)))

    def _of_builders(self, of_runs: NDArray[Any]) -> NDArray[Any]:
        """Repeat what is given for each run for each of its builders: (runs * builders,)."""
        return of_runs if self.builders == 1 else np.repeat(of_runs, self.builders)

    def view_of(self, env: VectorEnv[Any, Int64s, Any], scenarios: Sequence[Scenario]) -> VectorEnv[Any, Int64s, Any]:
        """Return the arenas as the agent sees them: in its states.

        For the single agent, choosing a material is an action. For states "screen" the arenas have to show their
        windows already (live/screen_arenas.py).
        """
        each = self._team.scenarios_of(scenarios) if self._team else scenarios
        view = env if self.spec.has_main else SingleAgentVectorEnv(env, each, self.builders)
        return PlanesVectorEnv(view, scenarios) if self._sees == IMAGE else view

    def start_states(self, scenarios: Sequence[Scenario]) -> NDArray[Any]:
        """Return what the main agent sees of each scenario before the first move, (runs, …)."""
        if self._sees == IMAGE:
            return start_planes(scenarios)
        if self._sees == SCREEN:  # it chooses before there is a window to look at
            return np.zeros((len(scenarios), *SCREEN_SHAPE), np.uint8)
        first = self._team.scenarios_of(scenarios)[:: self.builders] if self._team else scenarios
        return np.array([each.start_state for each in first])

    def chosen_materials(self, observations: NDArray[Any]) -> Int64s:
        """Return the materials that the single agent's observations show as chosen, in their last part.

        A material is -1 before it is chosen.
        """
        if self._sees == NUMBERS:
            return observations[:, -1] - 1
        shown = observations[:, -1, 0, 0].astype(np.int64)
        return np.round(shown * self._materials / FULL).astype(np.int64) - 1

    def builders_of(self, runs: Int64s) -> list[Int64s]:
        """Return, for each builder's number, its places (k,) among all builders, in the named runs (k,)."""
        if self.builders == 1:
            return [runs]
        return [runs * self.builders + number for number in range(self.builders)]

    def low_level_rows(self, places: Int64s, materials: Int64s) -> Int64s:
        """Return the ``low_level`` rows that act for the builders at these places (k,), by all runs' materials."""
        acting = places if self._share_a_row == 1 else places // self._share_a_row
        return acting if self._low_levels == 1 else acting * self._low_levels + materials[places]

    def act(self, states: NDArray[Any], materials: Int64s, epsilon: Float64s, uniforms: Float64s) -> Int64s:
        """Return the low-level agents' ε-greedy actions for every builder, (runs * builders,); ε is (runs,)."""
        is_a_row_each = self._low_levels == self._share_a_row == 1
        rows = None if is_a_row_each else self.low_level_rows(np.arange(len(states)), materials)
        if self.builders > 1:
            epsilon, uniforms = self._of_builders(epsilon), uniforms.reshape(-1, CHOICE_NUMBERS)
        return self.low_level.act(states, epsilon, uniforms, rows)

    def foretold(self, states: NDArray[Any], materials: Int64s, epsilon: Float64s, uniforms: Float64s) -> Int64s:
        """Return what ``act`` will, before the step that leads there is done; NO_ACTION where that isn't known."""
        return self.act(states, materials, epsilon, uniforms)

    def begin_episodes(self, runs: Int64s) -> Int64s:
        """Return the materials with which the named runs' episodes begin, (k,), where no main agent's learner chooses.

        The single agent chooses by its actions: it doesn't matter which.
        """
        return np.zeros(len(runs), dtype=np.int64)

    @property
    def forms(self) -> dict[str, NetworkForm]:
        """What the networks are, by role."""
        return {role: learner.engine.form for role, learner in self._learners().items()}

    @property
    def updates(self) -> int:
        """Updates done, over all runs and agents."""
        return sum(int(learner.engine.updates.sum()) for learner in self._learners().values())

    @property
    def updates_by_run(self) -> Int64s:
        """Updates of all of a run's networks, (runs,)."""
        return self._by_run(lambda learner: learner.engine.updates)

    @property
    def replay_bytes(self) -> Int64s:
        """Bytes of what each run's replays hold, all its agents' together, (runs,)."""
        return self._by_run(lambda learner: learner.replay.bytes_held())

    def last_figures(self) -> Arrays:
        """Return loss and mean Q of each run's last updates, (runs,), by name; nan before an agent's first update.

        If a run has several low-level agents, the mean over those that have been updated.
        """
        figures = {}
        for role, learner in self._learners().items():
            for name, values in (("loss", learner.engine.last.loss()), ("q", learner.engine.last.q())):
                of_run = values.reshape(len(self.runs), -1)
                known = np.isfinite(of_run)
                total = np.where(known, of_run, 0.0).sum(axis=1)
                figures[f"{name}/{role}"] = np.where(
                    known.any(axis=1), total / np.maximum(known.sum(axis=1), 1), np.nan
                )
        return figures

    def state(self) -> Arrays:
        """Return what later choices and updates depend on, by name; without the transitions."""
        return self._named(lambda _, learner: learner.state())

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if the shape differs."""
        for role, learner in self._learners().items():
            learner.load(part_of(state, role))

    def online(self) -> Arrays:
        """Return the online networks' parameters, by role: what acting needs."""
        return {role: learner.engine.online for role, learner in self._learners().items()}

    def load_online(self, online: Mapping[str, NDArray[Any]]) -> None:
        """Load the online networks of every run, by role, or one run's into each; ValueError if their shape differs."""
        for role, learner in self._learners().items():
            times = len(learner.engine.online) // max(len(online[role]), 1)
            learner.engine.load_online(np.tile(online[role], (times, 1)))

    def rows_of(self, run: int) -> dict[str, slice]:
        """Return a run's rows, by role."""
        return {"main": slice(run, run + 1), "low": slice(run * self._rows_a_run, (run + 1) * self._rows_a_run)}

    def marks(self) -> Arrays:
        """Return where a journal of the transitions ends now, for ``transitions_since``."""
        return self._named(lambda _, learner: learner.replay.marks())

    def transitions_since(self, marks: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """Return what ``store_again`` needs to know since those marks; everything if there are none."""
        return self._named(lambda role, learner: learner.replay.added_since(part_of(marks, role) if marks else None))

    def store_again(self, transitions: Mapping[str, NDArray[Any]]) -> None:
        """Store what ``transitions_since`` returned; KeyError or ValueError if the shape differs."""
        for role, learner in self._learners().items():
            learner.replay.extend(part_of(transitions, role))

    def mark(self) -> dict[str, ReplayMark]:
        """Return the replays now, by role, for ``take_back`` within an episode."""
        return {role: learner.replay.mark(self._longest) for role, learner in self._learners().items()}

    def take_back(self, marks: Mapping[str, ReplayMark]) -> None:
        """Hold exactly the transitions that were held at ``mark``."""
        for role, learner in self._learners().items():
            learner.replay.take_back(marks[role])

    def _by_run(self, of_rows: Callable[[Learner], Int64s]) -> Int64s:
        """Return the sum of what each learner counts of its rows, for each run, (runs,)."""
        total = np.zeros(len(self.runs), np.int64)
        for learner in self._learners().values():
            total += of_rows(learner).reshape(len(self.runs), -1).sum(axis=1)
        return total

    def _named(self, of_learner: Callable[[str, Learner], Arrays]) -> Arrays:
        """Return the arrays that each learner gives, under names that begin with its role."""
        return named_parts({role: of_learner(role, learner) for role, learner in self._learners().items()})

    def _learners(self) -> dict[str, Learner]:
        return {"main": self.main, "low": self.low_level} if self.main else {"low": self.low_level}

    def _numbers(self, scenarios: Sequence[Scenario], encoding: str) -> tuple[States, States]:
        """Return the main agent's states, and the low-level agents', as numbers."""
        spec, materials = self.spec, self._materials
        observed = np.stack([highest_observation(scenario) for scenario in scenarios])
        number = [self.builders - 1] * self._numbered
        # The single agent's m is 0 before the choice: it has one more value than there are materials.
        material = [materials - 1] * spec.appends_material + [materials] * spec.sees_choice
        highest = np.hstack((observed, np.tile(np.array([*number, *material], dtype=np.int64), (len(scenarios), 1))))
        builds = StateSpace(np.repeat(highest, self._rows_a_run, axis=0), self._low_level_actions, encoding)
        return StateSpace(observed, materials, encoding), builds

    def _planes(self, runs: int, shape: tuple[int, ...]) -> tuple[States, States]:
        """Return the main agent's states, and the low-level agents', as planes of that shape.

        The low-level agents' planes have the material, too.
        """
        more = self.spec.appends_material or self.spec.sees_choice
        builds = PlaneStates(runs * self._rows_a_run, self._low_level_actions, (shape[0] + more, *shape[1:]))
        return PlaneStates(runs, self._materials, shape), builds

    def _objectives(self, runs: int, side: int) -> tuple[States, States]:
        """Return the main agent's states, whose actions are cells, and the nested agent's: bits of frames."""
        order, reach = ((planes, side, side) for planes in (ORDER_PLANES, REACH_PLANES))
        builds = PlaneStates(runs, self._low_level_actions, reach, are_bits=True)
        return PlaneStates(runs, side * side, order, are_bits=True), builds
