"""The headless simulator: the rules alone, as one Game, and as R arenas in arrays."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.env import action_space_of, highest_observation, rendered, space_up_to
from mc_nested.arena.game import Following, Outcome, PlayLog, Resumable
from mc_nested.arena.rules import STEP, cells_of, grid_of, landing, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.tally import Tally, tally_of
from mc_nested.arena.vector import METADATA, NO_ACTION, reset_options, seeds_of, taken_apart
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from sim.grid_step import Episodes, Layout, Stepped, all_exist, observe_all, step_all


class GridGame:
    """A Game that follows the rules and nothing else."""

    def __init__(self, scenario: Scenario) -> None:
        self._start, self._size = scenario.start, scenario.size
        self._cell = scenario.start
        self._placed: set[Cell] = set()

    @property
    def resumable(self) -> Resumable | None:
        """This game: its episode is nothing but a cell and the blocks."""
        return self

    @property
    def log(self) -> PlayLog | None:
        """None: simulated actions take no time."""
        return None

    def reset(self, material: int) -> Cell:  # noqa: ARG002 - the rules are the same for every material
        self._cell = self._start
        self._placed = set()
        return self._cell

    def act(
        self,
        action: Action,
        material: int | None = None,  # noqa: ARG002 - and so are these
        following: Following | None = None,  # noqa: ARG002 - nothing overlaps here
    ) -> Outcome:
        self._cell = moved(self._cell, action, self._placed, self._size)
        block = landing(self._cell, action, self._placed, self._size)
        if block is not None:
            self._placed.add(block)
        return Outcome(self._cell, block)

    def snapshot(self) -> Arrays:
        """Return the cell and the blocks, for ``restore``."""
        return {"game_cell": np.array(self._cell), "game_placed": grid_of(self._placed, self._size)}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the agent and the blocks back as they stood at ``snapshot``."""
        x, y = snapshot["game_cell"].tolist()
        self._cell = x, y
        self._placed = set(cells_of(snapshot["game_placed"]))


class GridVectorEnv(VectorEnv[Int64s, Int64s, Any]):
    """R arenas in NumPy arrays, each with its own scenario and size; as ArenaVectorEnv over GridGames, faster.

    A border of solid cells stops every move and every block at each arena's edge. The arenas are one flat array
    (grid_step.py). All have the room of the largest; in a smaller one everything beyond its edge is solid.
    """

    metadata = METADATA

    def __init__(self, scenarios: Sequence[Scenario], render_mode: str | None = None) -> None:
        self.scenarios = tuple(scenarios)
        self.render_mode = render_mode
        runs = self.num_envs = len(self.scenarios)
        highest = np.max([highest_observation(scenario) for scenario in self.scenarios], axis=0)
        self.single_observation_space = space_up_to(highest)
        in_parts = next((scenario for scenario in self.scenarios if scenario.parts), self.scenarios[0])
        self.single_action_space = action_space_of(in_parts)
        self._tally = tally_of(self.scenarios)
        self.observation_space = batch_space(self.single_observation_space, runs)
        self.action_space = batch_space(self.single_action_space, runs)

        self._side = max(scenario.size for scenario in self.scenarios) + 2
        area = self._side * self._side
        move = np.array([STEP[action][0] * self._side + STEP[action][1] for action in Action])
        self._base = np.arange(runs) * area
        self._start = self._base + [self._index(scenario.start) for scenario in self.scenarios]
        self._blocks = np.array([scenario.blocks for scenario in self.scenarios])
        step_limit = np.array([scenario.step_limit for scenario in self.scenarios])
        self._layout = Layout(move, self._base, step_limit, self._side)
        self._design = np.zeros(runs * area, dtype=np.bool_)
        for run, scenario in enumerate(self.scenarios):
            self._design[self._base[run] + [self._index(cell) for cell in scenario.design]] = True
        self._border = np.ones((runs, area), dtype=np.bool_)
        for run in range(runs):
            self._cells(self._border, run)[:] = False
        choices = max(len(scenario.materials) for scenario in self.scenarios)
        self._worth = np.zeros((runs, choices))
        for run, scenario in enumerate(self.scenarios):
            self._worth[run, : len(scenario.materials)] = [material.p for material in scenario.materials]

        self._solid = self._border.flatten()
        self._position = self._start.copy()
        self._blocks_left = self._blocks.copy()
        self._steps = np.zeros(runs, dtype=np.int64)
        self._score = np.zeros(runs)
        self._terminated = np.zeros(runs, dtype=np.bool_)
        self._truncated = np.zeros(runs, dtype=np.bool_)
        self._episodes = Episodes(
            self._solid, self._position, self._blocks_left, self._steps, self._terminated, self._truncated
        )

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode in the masked arenas (all, without a mask), each with its material (the best, without)."""
        super().reset(seed=seeds_of(seed, self.num_envs)[0])
        mask, materials = reset_options(options, self.scenarios)
        self._solid.reshape(self._border.shape)[mask] = self._border[mask]
        self._position[mask] = self._start[mask]
        self._blocks_left[mask] = self._blocks[mask]
        self._steps[mask] = 0
        self._score[mask] = self._worth[mask, materials[mask]]
        self._terminated[mask] = self._truncated[mask] = False
        if self._tally:
            self._tally.begin(mask, materials)
        return self._observations(), {}

    def step(self, actions: Int64s) -> tuple[Int64s, Float64s, Bools, Bools, dict[str, Any]]:
        """Take one action, or NO_ACTION, in every arena whose episode runs; ``info["score"]`` is r_M if ``_score``.

        With parts, the actions may be (R, 2): each beside the material to take in hand, and ``info`` says more (Info).
        """
        actions, materials = taken_apart(actions, self.num_envs)
        running = ~(self._terminated | self._truncated) & (actions != NO_ACTION)
        if not all_exist(actions, running, len(self._layout.move)):
            raise ValueError("actions: a number that is no action")
        if self._tally and materials is not None:
            self._tally.take(running, materials)
        stepped = Stepped(np.empty_like(actions), np.empty_like(running), np.empty_like(running))
        step_all(actions, running, tuple(self._layout), tuple(self._episodes), tuple(stepped))
        front, lands, ended = stepped
        pays = self._laid(self._tally, lands, front) if self._tally else lands & self._design[front]
        rewards = pays.astype(np.float64)
        self._score += rewards
        info = {"score": np.where(ended, self._score, 0.0), "_score": ended}
        if self._tally:
            info = self._tally.info(running, lands, ended)
        return self._observations(), rewards, self._terminated.copy(), self._truncated.copy(), info

    def render(self) -> tuple[Any, ...] | None:
        """Return every arena from above, as ArenaEnv renders it; None without a render mode."""
        if self.render_mode is None:
            return None
        cells = self._observations()[:, :2].tolist()
        return tuple(
            rendered(self.render_mode, scenario, (x, y), self.placed(run))
            for run, (scenario, (x, y)) in enumerate(zip(self.scenarios, cells, strict=True))
        )

    def cell(self, run: int) -> Cell:
        """Return where the agent stands in that arena."""
        x, y = divmod(int(self._position[run] - self._base[run]), self._side)
        return x - 1, y - 1

    def placed(self, run: int) -> frozenset[Cell]:
        """Return the cells where a block landed in that arena since its last reset."""
        return cells_of(self._cells(self._solid, run))

    def occupied(self) -> Bools:
        """Return the cells where a block landed since each arena's last reset, (runs, size, size).

        All arenas must be of one size.
        """
        return np.stack([self._cells(self._solid, run) for run in range(self.num_envs)])

    @property
    def resumable(self) -> Resumable | None:
        """These arenas: their episodes can be saved half-way."""
        return self

    def snapshot(self) -> Arrays:
        """Return every arena as it stands, for ``restore``."""
        own = {name: getattr(self, name).copy() for name in self._STATE}
        return own | (self._tally.snapshot() if self._tally else {})

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put every arena back as it stood at ``snapshot``."""
        for name in self._STATE:
            getattr(self, name)[:] = snapshot[name]
        if self._tally:
            self._tally.restore(snapshot)

    _STATE = ("_solid", "_position", "_blocks_left", "_steps", "_score", "_terminated", "_truncated")

    def _index(self, cell: Cell) -> int:
        """Return a cell's index in its run's part of the flat array."""
        return (cell[0] + 1) * self._side + cell[1] + 1

    def _cells(self, solid: Bools, run: int) -> Bools:
        """Return a view of the run's cells in the flat array, (x, y), without the border."""
        size = self.scenarios[run].size
        return solid.reshape(-1, self._side, self._side)[run, 1 : size + 1, 1 : size + 1]

    def _laid(self, tally: Tally, lands: Bools, front: Int64s) -> Bools:
        """Count the blocks that landed there, and return which of them pay, (R,)."""
        x, y = np.divmod(front - self._base, self._side)
        return tally.lay(lands, x - 1, y - 1)

    def _observations(self) -> Int64s:
        seen = np.empty((self.num_envs, 3), dtype=np.int64)
        observe_all(tuple(self._layout), tuple(self._episodes), seen)
        return seen
