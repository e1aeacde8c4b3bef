"""ArenaEnv: a gymnasium.Env over any Game; every backend shares it.

Actions 0 to 7 (action.Action) go in; raw (x, y, b) comes out, b being the blocks left. Encoding belongs to learn/.
In a scenario with parts, the index of the material to take in hand goes in beside the action.
"""

from collections.abc import Collection, Mapping
from copy import deepcopy
from typing import Any, TypedDict

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Box, Discrete, MultiDiscrete, Space
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.drawing import draw_picture, draw_text
from mc_nested.arena.game import Following, Game, Resumable
from mc_nested.arena.rules import cells_of, end_of_episode, grid_of, landing, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.tally import THE_ARENA, tally_of
from mc_nested.arrays import Arrays, Int64s

Observation = Int64s
"""(3,): x, y and b, the blocks left."""

X, Y, BLOCKS_LEFT = range(3)
"""Columns of an observation."""

RENDERING: dict[str, Any] = {"render_modes": ["rgb_array", "ansi"], "render_fps": 4}
"""What Gymnasium's wrappers ask of an Env: how it can be drawn, and how many steps a second a film of it shows."""


class Info(TypedDict, total=False):
    """What a step returns beside the reward."""

    material: str
    """The name of the episode's material; with parts, of the one in hand."""

    placed: Cell
    """Where a block landed; not there if none did."""

    instead: int
    """The action that a person who has taken over did in place of the one asked for; not there if nobody did."""

    score: float
    """The episode's score, the main agent's r_M; there on the last step alone."""

    earned: float
    """With parts: r_M so far; on the last step, the score."""

    chooses: bool
    """With parts: whether the main agent has to choose a material before the next step."""


def highest_observation(scenario: Scenario) -> Observation:
    """Return the highest value of each part of an observation; the lowest is 0."""
    return np.array([scenario.size - 1, scenario.size - 1, scenario.blocks])


def space_up_to(highest: Int64s) -> Space[Any]:
    """Return the space of observations from 0 to the highest, as int64."""
    space: Space[Any] = Box(low=np.zeros_like(highest), high=highest, dtype=np.int64)
    return space


def action_space_of(scenario: Scenario) -> Space[Any]:
    """Return the eight actions; with parts, each beside the index of a material."""
    space: Space[Any] = Discrete(len(Action))
    return MultiDiscrete([len(Action), len(scenario.materials)]) if scenario.parts else space


def step_in(scenario: Scenario, action: int, material: int) -> int | tuple[int, int]:
    """Return what ``step`` takes to do an action with a material in hand."""
    return (action, material) if scenario.parts else action


def rendered(mode: str | None, scenario: Scenario, cell: Cell, placed: Collection[Cell]) -> Any:
    """Return the arena from above as a render mode wants it; None without one."""
    if mode == "rgb_array":
        return draw_picture(scenario, cell, placed)
    if mode == "ansi":
        return draw_text(scenario, cell, placed)
    return None


def blank_observations(space: Space[Any], runs: int) -> NDArray[Any]:
    """Return zeros for one observation of that space per run."""
    return np.zeros((runs, *(space.shape or ())), dtype=space.dtype)


class ArenaEnv(gymnasium.Env[Observation, Any]):
    """One arena. The reward is the nested agent's r_N; the last step's ``info["score"]`` is the main agent's r_M.

    ``reset(options={"material": name})`` takes the main agent's choice; without it, the material with the best p.
    With parts, ``step`` takes an action and a material to take in hand before it; with an action alone, the one in hand
    stays there. ``info["chooses"]`` says when the main agent has to choose, and ``info["earned"]`` is r_M so far.
    Terminated when no block is left, truncated at the scenario's step limit (docs/explanation/task.md).
    A live game's LiveError passes through; the episode is over then and has to be reset.
    """

    metadata = RENDERING

    def __init__(self, game: Game, scenario: Scenario, render_mode: str | None = None) -> None:
        self.game = game
        self.scenario = scenario
        self.render_mode = render_mode
        self.observation_space = space_up_to(highest_observation(scenario))
        self.action_space = action_space_of(scenario)
        self._tally = tally_of([scenario])
        self._material = scenario.best_material
        self._cell = scenario.start
        self._placed: set[Cell] = set()
        self._steps = 0
        self._running = False
        self._following: Following | None = None

    @property
    def cell(self) -> Cell:
        """Where the agent stands."""
        return self._cell

    @property
    def placed(self) -> frozenset[Cell]:
        """The cells where a block landed since the last reset."""
        return frozenset(self._placed)

    @property
    def steps(self) -> int:
        """The steps since the last reset."""
        return self._steps

    @property
    def material(self) -> str:
        """The name of the material in hand."""
        return self.scenario.materials[self._material].name

    @property
    def score(self) -> float:
        """r_M if the episode ended now."""
        if self._tally is None:
            return self.scenario.score(self._placed, self._material)
        return float(self._tally.total(THE_ARENA)[0])

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode; ScenarioError if ``options["material"]`` names no material of the scenario."""
        super().reset(seed=seed)
        name = (options or {}).get("material")
        self._material = self.scenario.best_material if name is None else self.scenario.material_index(name)
        self._running, self._following = False, None
        self._cell = self.game.reset(self._material)
        self._placed = set()
        self._steps = 0
        if self._tally:
            self._tally.begin(THE_ARENA, np.array([self._material]))
        self._running = True
        return self._observation(), dict(self._info())

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Do one action and earn r_N: 1 if the block just placed is on the design, else 0 (paper, section 5.1.3).

        With parts, 1 if it is on the part that is built now, and with regions in the chosen one. ValueError if the
        scenario doesn't have that material.
        """
        if not self._running:
            raise ResetNeeded("the episode has ended, or none has begun: call reset() first")
        wanted, following = self._taken_in_hand(action), self._following
        self._running, self._following = False, None
        outcome = self.game.act(*wanted, following) if following else self.game.act(*wanted)
        self._cell = outcome.cell
        self._steps += 1
        if outcome.placed is not None:
            self._placed.add(outcome.placed)
        reward = 1.0 if self._lay(outcome.placed) else 0.0
        terminated, truncated = end_of_episode(self._blocks_left, self._steps, self.scenario.step_limit)
        self._running = not (terminated or truncated)
        info = self._info()
        if outcome.placed is not None:
            info["placed"] = outcome.placed
        if outcome.instead is not None:
            info["instead"] = int(outcome.instead)
        self._count(info, outcome.placed)
        return self._observation(), reward, terminated, truncated, dict(info)

    def expected(self, action: Any) -> tuple[Observation, bool, bool]:
        """Return what a step shows by the rules, whether it goes on then, and whether a material is to be chosen."""
        done, size = self._asked(action)[0], self.scenario.size
        cell = moved(self._cell, done, self._placed, size)
        landed = np.array([landing(cell, done, self._placed, size) is not None])
        left = self._blocks_left - int(landed[0])
        goes_on, chooses = not any(end_of_episode(left, self._steps + 1, self.scenario.step_limit)), False
        if tally := deepcopy(self._tally):
            tally.lay(landed, *np.zeros((2, 1), dtype=np.int64))
            chooses = goes_on and bool(tally.chooses(THE_ARENA, landed)[0])
        return np.array([*cell, left], dtype=np.int64), goes_on, chooses

    def announce(self, following: Any | None) -> None:
        """Say what the step after the next one will be, where that goes as the rules say: its game is told."""
        self._following = None if following is None else self._asked(following)

    def render(self) -> Any:
        """Return the arena from above: (H, W, 3) RGB for "rgb_array", lines of text for "ansi"."""
        return rendered(self.render_mode, self.scenario, self._cell, self._placed)

    @property
    def resumable(self) -> Resumable | None:
        """This Env, if its game can be resumed."""
        return self if self.game.resumable else None

    def snapshot(self) -> Arrays:
        """Return the current episode, the game's part included, for ``restore``. The game must be resumable."""
        stands_at = np.array([self._material, *self._cell, self._steps, self._running])
        game = self.game.resumable.snapshot() if self.game.resumable else {}
        game |= self._tally.snapshot() if self._tally else {}
        return {**game, "env_stands_at": stands_at, "env_placed": grid_of(self._placed, self.scenario.size)}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the episode back as it stood at ``snapshot``."""
        self._material, x, y, self._steps, running = (int(value) for value in snapshot["env_stands_at"])
        self._cell, self._running = (x, y), bool(running)
        self._placed = set(cells_of(snapshot["env_placed"]))
        if self._tally:
            self._tally.restore(snapshot)
        if self.game.resumable:
            self.game.resumable.restore(snapshot)

    def _asked(self, action: Any) -> Following:
        """Return what ``step`` asks the game for."""
        if self._tally is None or np.ndim(action) == 0:
            return Action(int(action)), None
        return Action(int(action[0])), int(action[1])

    def _taken_in_hand(self, action: Any) -> Following:
        """Return what the game is asked to do; the material is in hand from now on."""
        done, material = self._asked(action)
        if self._tally and material is not None:
            self._tally.take(THE_ARENA, np.array([material]))
            self._material = material
        return done, material

    def _lay(self, placed: Cell | None) -> bool:
        """Count the block that landed there, and return whether it pays."""
        if self._tally is None or placed is None:
            return placed in self.scenario.design
        return bool(self._tally.lay(THE_ARENA, np.array([placed[0]]), np.array([placed[1]]))[0])

    def _count(self, info: Info, placed: Cell | None) -> None:
        """Count the step that was done, and say in ``info`` what it brought the main agent."""
        is_over = not self._running
        if self._tally is None:
            if is_over:
                info["score"] = self.score
            return
        info["chooses"] = bool(self._tally.chooses(THE_ARENA, np.array([placed is not None]))[0]) and not is_over
        info["earned"] = float(self._tally.total(np.array([is_over]))[0])
        if is_over:
            info["score"] = info["earned"]

    @property
    def _blocks_left(self) -> int:
        return self.scenario.blocks - len(self._placed)

    def _observation(self) -> Observation:
        return np.array([*self._cell, self._blocks_left], dtype=np.int64)

    def _info(self) -> Info:
        return {"material": self.material}
