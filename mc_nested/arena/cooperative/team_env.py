"""TeamVectorEnv: the episodes of teams over any TeamGames, as arenas with a row for each builder.

Builder j of run i has row i * k + j. To a trainer each row is an arena as one of ArenaVectorEnv, in which others build
as well: the blocks left are the team's, and so are the flags and the score. Autoreset is disabled. The arena is drawn
from above, the far edge on top, each builder in a colour of its own.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Discrete
from gymnasium.vector import VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.cooperative.team import Team, TeamGame
from mc_nested.arena.drawing import AGENT_BODY, CELL_PX, Colour, Picture, draw_agent, draw_picture, kind_of
from mc_nested.arena.env import highest_observation, space_up_to
from mc_nested.arena.game import Resumable
from mc_nested.arena.rules import cells_of, end_of_episode, grid_of
from mc_nested.arena.vector import METADATA, NO_ACTION, reset_options, taken_apart
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s


class TeamVectorEnv(VectorEnv[Int64s, Int64s, Any]):
    """R arenas with k builders each.

    A builder observes (x, y, b): its own cell, and the blocks that the team has left. It earns r_N for its own block
    alone: 1 if that is on the design. ``info["score"]`` is the main agent's r_M, of all blocks. An episode is
    terminated when no block is left, and truncated at the scenario's step limit, which counts ticks.

    Args:
        games: of each run.
        team: who builds what in each of them.
    """

    metadata = METADATA

    def __init__(self, games: Sequence[TeamGame], team: Team) -> None:
        self.games = tuple(games)
        self.team = team
        self.num_envs = len(self.games) * team.builders
        self.single_observation_space = space_up_to(highest_observation(team.scenario))
        self.single_action_space = Discrete(len(Action))
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        runs = len(self.games)
        self._cells = np.tile(np.array(team.starts, dtype=np.int64), (runs, 1))
        self._placed: list[frozenset[Cell]] = [frozenset()] * runs
        self._materials = np.full(runs, team.scenario.best_material)
        self._ticks = np.zeros(runs, dtype=np.int64)
        self._has_begun = np.zeros(runs, dtype=np.bool_)
        self._terminated = np.zeros(runs, dtype=np.bool_)
        self._truncated = np.zeros(runs, dtype=np.bool_)

    def cell(self, row: int) -> Cell:
        """Return where that row's builder stands."""
        x, y = self._cells[row].tolist()
        return x, y

    def placed(self, row: int) -> frozenset[Cell]:
        """Return the cells where a block landed in that row's arena since its last reset."""
        return self._placed[row // self.team.builders]

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,  # noqa: ARG002 - no chance
        options: dict[str, Any] | None = None,
    ) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode in the arenas whose rows are masked (all, without a mask), each with its material."""
        mask, materials = reset_options(options, [self.team.scenario] * self.num_envs)
        every = self.team.builders
        for run in np.flatnonzero(mask[::every]).tolist():
            self._has_begun[run] = False
            material = int(materials[run * every])
            self._cells[self._rows(run)] = self.games[run].reset(material)
            self._placed[run], self._materials[run], self._ticks[run] = frozenset(), material, 0
            self._terminated[run] = self._truncated[run] = False
            self._has_begun[run] = True
        return self._observations(), {}

    def step(self, actions: Int64s) -> tuple[Int64s, Float64s, Bools, Bools, dict[str, Any]]:
        """Do one tick, an action or NO_ACTION of each builder, in every arena whose episode runs.

        ResetNeeded before the first reset. In an arena where nobody acts nothing happens. A game that fails leaves its
        arena without an episode.
        """
        wanted, _ = taken_apart(actions, self.num_envs)
        rewards, scores = np.zeros(self.num_envs), np.zeros(len(self.games))
        running = ~(self._terminated | self._truncated)
        for run in np.flatnonzero(running).tolist():
            own = wanted[self._rows(run)]
            if (own == NO_ACTION).all():
                continue
            if not self._has_begun[run]:
                raise ResetNeeded("no episode has begun: call reset() first")
            rewards[self._rows(run)], scores[run] = self._tick(run, own.tolist())
        ended = running & (self._terminated | self._truncated)
        info = {"score": self._of_rows(scores), "_score": self._of_rows(ended)}
        flags = self._of_rows(self._terminated), self._of_rows(self._truncated)
        return self._observations(), rewards, *flags, info

    @property
    def resumable(self) -> Resumable | None:
        """These arenas, if every game can be resumed."""
        return self if all(game.resumable for game in self.games) else None

    def snapshot(self) -> Arrays:
        """Return every arena as it stands, the games' part included, for ``restore``."""
        games = [game.resumable.snapshot() for game in self.games if game.resumable]
        size = self.team.scenario.size
        return {
            **{name: np.stack([game[name] for game in games]) for name in games[0]},
            **{f"team{name}": getattr(self, name).copy() for name in self._STATE},
            "team_placed": np.stack([grid_of(placed, size) for placed in self._placed]),
        }

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put every arena back as it stood at ``snapshot``."""
        for name in self._STATE:
            getattr(self, name)[:] = snapshot[f"team{name}"]
        self._placed = [cells_of(grid) for grid in snapshot["team_placed"]]
        for run, game in enumerate(self.games):
            if game.resumable:
                game.resumable.restore({name: kept[run] for name, kept in snapshot.items()})

    _STATE = ("_cells", "_materials", "_ticks", "_has_begun", "_terminated", "_truncated")

    def _tick(self, run: int, actions: list[int]) -> tuple[Float64s, float]:
        """Return what each builder of that run has earned, (k,), and r_M if the episode is over."""
        scenario = self.team.scenario
        self._has_begun[run] = False
        outcomes = self.games[run].act([None if action == NO_ACTION else Action(action) for action in actions])
        self._has_begun[run] = True
        self._cells[self._rows(run)] = [outcome.cell for outcome in outcomes]
        self._placed[run] |= {outcome.placed for outcome in outcomes if outcome.placed is not None}
        self._ticks[run] += 1
        left = scenario.blocks - len(self._placed[run])
        terminated, truncated = end_of_episode(left, int(self._ticks[run]), scenario.step_limit)
        self._terminated[run], self._truncated[run] = terminated, truncated
        rewards = np.array([1.0 if outcome.placed in scenario.design else 0.0 for outcome in outcomes])
        is_over = terminated or truncated
        return rewards, scenario.score(self._placed[run], int(self._materials[run])) if is_over else 0.0

    def _rows(self, run: int) -> slice:
        return slice(run * self.team.builders, (run + 1) * self.team.builders)

    def _of_rows(self, of_runs: NDArray[Any]) -> NDArray[Any]:
        return np.repeat(of_runs, self.team.builders)

    def _observations(self) -> Int64s:
        left = [self.team.scenario.blocks - len(placed) for placed in self._placed]
        return np.column_stack((self._cells, self._of_rows(np.array(left, dtype=np.int64))))


BODIES: tuple[Colour, ...] = (AGENT_BODY, (34, 122, 74), (122, 66, 160), (24, 118, 150))
"""The builders' colours, by number: red, green, violet, blue."""


def draw_team_text(team: Team, cells: Sequence[Cell], placed: Collection[Cell]) -> str:
    """Return the arena as a line of text a row, two characters a cell; a builder is its number."""
    across = range(team.scenario.size)
    number_at = {cell: str(number) for number, cell in enumerate(cells)}
    rows = (
        " ".join(number_at.get((x, y)) or kind_of(team.scenario, None, placed, (x, y)) for x in across)
        for y in reversed(across)
    )
    return "\n".join(rows)


def draw_team_picture(team: Team, cells: Sequence[Cell], placed: Collection[Cell], cell_px: int = CELL_PX) -> Picture:
    """Return the arena as ``draw_picture`` draws it, (size * cell_px, size * cell_px, 3), with every builder."""
    picture = draw_picture(team.scenario, None, placed, cell_px)
    for cell, body in zip(cells, BODIES, strict=False):
        draw_agent(picture, team.scenario.size, cell, cell_px, body)
    return picture


def rendered_team(mode: str | None, team: Team, cells: Sequence[Cell], placed: Collection[Cell]) -> Any:
    """Return the arena from above as a render mode wants it; None without one."""
    if mode == "rgb_array":
        return draw_team_picture(team, cells, placed)
    if mode == "ansi":
        return draw_team_text(team, cells, placed)
    return None
