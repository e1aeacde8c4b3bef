"""Games that aren't what a learnt game takes for granted: walls, a torus, blocks elsewhere, scores of another form."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena import search
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Following, Outcome, PlayLog, Resumable
from mc_nested.arena.rules import PLACES, STEP, cells_of, grid_of
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.arrays import Arrays
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import Preset
from mc_nested.learn.trainer import Trainer
from tests.learn.imagination.made_games import LIVE

ROW = frozenset((x, 13) for x in range(5, 10))
"""Walls one step ahead of the start of the paper's designs, (7, 14)."""


@dataclass(frozen=True)
class World:
    """How a game differs from the paper's.

    ``walls`` stop moves and blocks; blocks land ``ahead`` so many cells; on a ``torus`` what leaves an edge comes in at
    the opposite one; ``block_first``: a block is placed before the move. ``score`` (blocks paid, material) is r_M, the
    scenario's where there is none, and ``best`` the highest. ``pays`` are cells that pay with a material, in the place
    of the design.
    """

    walls: frozenset[Cell] = frozenset()
    ahead: int = 1
    torus: bool = False
    block_first: bool = False
    score: Callable[[int, int], float] | None = None
    best: float | None = None
    pays: dict[int, frozenset[Cell]] = field(default_factory=dict)


class WorldGame:
    """A game in such a world."""

    log: PlayLog | None = None

    def __init__(self, world: World, scenario: Scenario) -> None:
        self._world, self._start, self._size = world, scenario.start, scenario.size
        self._cell, self._blocks = scenario.start, set[Cell]()

    @property
    def resumable(self) -> Resumable:
        return self

    def snapshot(self) -> Arrays:
        return {"cell": np.array(self._cell), "blocks": grid_of(self._blocks, self._size)}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        x, y = snapshot["cell"].tolist()
        self._cell, self._blocks = (x, y), set(cells_of(snapshot["blocks"]))

    def reset(self, material: int) -> Cell:  # noqa: ARG002 - the game is the same for every material
        self._cell, self._blocks = self._start, set()
        return self._cell

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:  # noqa: ARG002 - here too
        placed = self._place(action) if self._world.block_first else None
        target = self._on_torus((self._cell[0] + STEP[action][0], self._cell[1] + STEP[action][1]))
        if self._is_free(target):
            self._cell = target
        if not self._world.block_first:
            placed = self._place(action)
        return Outcome(self._cell, placed)

    def _place(self, action: Action) -> Cell | None:
        block = self._on_torus((self._cell[0], self._cell[1] + self._world.ahead))
        if action not in PLACES or not self._is_free(block):
            return None
        self._blocks.add(block)
        return block

    def _on_torus(self, cell: Cell) -> Cell:
        return (cell[0] % self._size, cell[1] % self._size) if self._world.torus else cell

    def _is_free(self, cell: Cell) -> bool:
        inside = all(0 <= part < self._size for part in cell)
        return inside and cell not in self._blocks and cell not in self._world.walls


class WorldEnv(ArenaEnv):
    """An arena in such a world."""

    def __init__(self, world: World, scenario: Scenario) -> None:
        super().__init__(WorldGame(world, scenario), scenario)
        self._world = world

    def step(self, action: Any) -> Any:
        observation, reward, terminated, truncated, info = super().step(action)
        if "score" in info and self._world.score:
            info["score"] = self._world.score(len(self._placed & self.scenario.design), self._material)
        return observation, reward, terminated, truncated, info

    def _pays(self, placed: Cell | None) -> bool:
        return placed in self._world.pays.get(self._material, self.scenario.design)


def trained_in(world: World, scenario: Scenario, seed: int, preset: Preset = LIVE) -> Trainer:
    """Return a trainer in that world, which stops at its best score."""
    agent = Agent(AGENT_SPECS["nested"], [scenario], preset, seed)
    trainer = Trainer(ArenaVectorEnv([WorldEnv(world, scenario)]), [scenario], agent, preset, seed, True)
    if world.best is not None:
        trainer._optimum[:] = world.best
    return trainer


def fewest_steps_among(walls: Collection[Cell], scenario: Scenario) -> int | None:
    """Return the fewest steps that build the whole design among these walls; None if they are too many."""
    blocks = sorted(scenario.design)
    free = search._free_cells(blocks, scenario.size)
    for x, y in walls:
        free[:, y] &= ~free.dtype.type(1 << x)
    reached = np.zeros_like(free)
    reached[0, scenario.start[1]] = 1 << scenario.start[0]
    for steps in range(scenario.step_limit):
        if reached[-1].any():
            return steps
        moved = search._after_one_move(reached, free)
        reached |= moved
        for index, (x, y) in enumerate(blocks):
            search._place(moved, reached, index, x, y - 1)
    return scenario.step_limit if reached[-1].any() else None


def one_wall(scenario: Scenario, seed: int) -> frozenset[Cell]:
    """Draw a wall cell off the design that leaves the optimum possible."""
    random = np.random.default_rng(seed)
    while True:
        x, y = random.integers(0, scenario.size, 2).tolist()
        if (x, y) not in scenario.design | {scenario.start} and fewest_steps_among([(x, y)], scenario) is not None:
            return frozenset({(x, y)})
