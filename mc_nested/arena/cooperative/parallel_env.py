"""CooperativeEnv: a team's arena as a PettingZoo ParallelEnv, for learners of other projects.

Needs pettingzoo, an extra of this project: where it is missing, importing this module raises a UserError of one line.
"""

from typing import Any, ClassVar

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Discrete, Space

from mc_nested.arena.action import Action
from mc_nested.arena.cooperative.team import Team, TeamGame
from mc_nested.arena.cooperative.team_env import TeamVectorEnv, rendered_team
from mc_nested.arena.env import RENDERING, highest_observation, space_up_to
from mc_nested.arrays import Int64s
from mc_nested.errors import UserError, with_extra

try:
    from pettingzoo import ParallelEnv
except ImportError:
    raise UserError(
        f"several builders as a PettingZoo environment need pettingzoo: {with_extra('pettingzoo')}"
    ) from None

Of = dict[str, Any]
"""Something of each agent, by its name."""


class CooperativeEnv(ParallelEnv):  # type: ignore[misc]  # pettingzoo comes without types
    """k builders in one arena, each an agent: "builder_0", "builder_1" and so on.

    An agent observes (x, y, b, its number), b being the blocks that the team has left; its actions are 0 to 7
    (action.Action); its reward is r_N of its own block. On the last tick every agent's ``info["score"]`` is the team's
    r_M. All agents end at the same tick. ``reset(options={"material": name})`` takes the main agent's choice; without
    it, the material with the best p. Where the others stand isn't observed (docs/how-to/several-builders.md).
    """

    metadata: ClassVar[Of] = {"name": "mc_nested_cooperative_v0", "is_parallelizable": True, **RENDERING}

    def __init__(self, game: TeamGame, team: Team, render_mode: str | None = None) -> None:
        self.team = team
        self.render_mode = render_mode
        self.possible_agents = [f"builder_{number}" for number in range(team.builders)]
        self.agents: list[str] = []
        self._arena = TeamVectorEnv([game], team)
        self._material = team.scenario.best_material
        highest = np.append(highest_observation(team.scenario), team.builders - 1)
        self._observation_spaces: Of = {agent: space_up_to(highest) for agent in self.possible_agents}
        self._action_spaces: Of = {agent: Discrete(len(Action)) for agent in self.possible_agents}

    def observation_space(self, agent: str) -> Space[Any]:
        space: Space[Any] = self._observation_spaces[agent]
        return space

    def action_space(self, agent: str) -> Space[Any]:
        space: Space[Any] = self._action_spaces[agent]
        return space

    def reset(self, seed: int | None = None, options: Of | None = None) -> tuple[Of, Of]:  # noqa: ARG002 - no chance
        """Begin an episode; ScenarioError if ``options["material"]`` names no material of the scenario."""
        name = (options or {}).get("material")
        scenario = self.team.scenario
        self._material = scenario.best_material if name is None else scenario.material_index(name)
        self.agents = []
        materials = np.full(self.team.builders, self._material)
        observations, _ = self._arena.reset(options={"material": materials})
        self.agents = list(self.possible_agents)
        return self._of_each(observations), self._infos()

    def step(self, actions: Of) -> tuple[Of, Of, Of, Of, Of]:
        """Do one tick: an action of every agent; ResetNeeded if no episode runs."""
        if not self.agents:
            raise ResetNeeded("the episode has ended, or none has begun: call reset() first")
        acting, self.agents = self.agents, []
        observations, earned, terminated, truncated, told = self._arena.step(
            np.array([int(actions[agent]) for agent in acting])
        )
        rewards = dict(zip(acting, earned.tolist(), strict=True))
        is_terminated, is_truncated = bool(terminated[0]), bool(truncated[0])
        infos = self._infos()
        if is_terminated or is_truncated:
            for info in infos.values():
                info["score"] = float(told["score"][0])
        else:
            self.agents = acting
        flags = dict.fromkeys(acting, is_terminated), dict.fromkeys(acting, is_truncated)
        return self._of_each(observations), rewards, *flags, infos

    def render(self) -> Any:
        """Return the arena from above: (H, W, 3) RGB for "rgb_array", lines of text for "ansi", None without a mode."""
        cells = [self._arena.cell(builder) for builder in range(self.team.builders)]
        return rendered_team(self.render_mode, self.team, cells, self._arena.placed(0))

    def _of_each(self, observations: Int64s) -> Of:
        return {
            agent: np.append(observed, number)
            for number, (agent, observed) in enumerate(zip(self.possible_agents, observations, strict=True))
        }

    def _infos(self) -> Of:
        material = self.team.scenario.materials[self._material].name
        return {agent: {"material": material} for agent in self.possible_agents}
