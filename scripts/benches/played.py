"""Random actions in a live game, each held against its world and against the rules."""

import dataclasses
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Following, Game, Outcome, PlayLog
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import LiveError
from mc_nested.live.action_log import percentile
from mc_nested.live.live_game import LiveGame
from mc_nested.live.model.coordinates import cell_at
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.arena import Arena
from scripts.rehearsal_window import standing_in
from sim.client.client import VirtualClient

GIVES_UP = 3
"""Resets in a row that may fail: a game that can't be reset would go on for ever."""

Step = tuple[int, tuple[float, float, float]]
"""A tick's number, and where the feet were after it."""

Transition = tuple[int, ...]
"""(x, y, b), the action, and (x, y, b) after it."""


@dataclasses.dataclass
class PlayCounts:
    """What was played, what went wrong, and how long it took."""

    actions: int = 0
    mishaps: int = 0
    wrong_cells: int = 0
    wrong_blocks: int = 0
    unnoticed: int = 0
    failed_actions: int = 0
    resets: int = 0
    gave_up: int = 0
    left_down: int = 0
    strays: int = 0
    into_screens: int = 0
    too_late: int = 0
    corrections: int = 0
    second_clicks: int = 0
    recoveries: int = 0
    played_s: float = 0.0
    cpu_s: float = 0.0
    moves_s: list[float] = dataclasses.field(default_factory=list)
    placings_s: list[float] = dataclasses.field(default_factory=list)

    @property
    def is_right(self) -> bool:
        """Whether nothing was wrong."""
        wrong = (self.wrong_cells, self.wrong_blocks, self.unnoticed, self.gave_up, self.left_down)
        return not any((*wrong, self.strays, self.into_screens))


class WorldTruth:
    """What the game's world really holds, known without its screen. What was built elsewhere before must stay.

    Args:
        arena: where blocks are placed.
        way: says where the player's feet were after each of the last ticks, by the tick's number; the last is now.
        built: gives every block that differs from the bare floor.
    """

    def __init__(self, arena: Arena, way: Callable[[], Sequence[Step]], built: Callable[[], dict[Block, str]]) -> None:
        self._arena, self._way, self._built = arena, way, built
        self._since = 0
        standing = standing_in(arena, built())
        self._before = {at: name for at, name in built().items() if at not in standing}

    def cell(self) -> Cell:
        """Return the cell that the player stands on."""
        return self._cell_at(self._way()[-1])

    def passed(self, cell: Cell) -> bool:
        """Return whether the player is in that cell, or was in it at a tick since the cell that was asked for last."""
        there = [step[0] for step in self._way() if step[0] >= self._since and self._cell_at(step) == cell]
        self._since = there[0] if there else self._since
        return bool(there)

    def _cell_at(self, step: Step) -> Cell:
        return cell_at(self._arena.position_of(step[1]))

    def is_built(self, placed: set[Cell]) -> bool:
        """Return whether these cells hold a block, and everything else is as before."""
        cells, built = {self._arena.block_of(cell) for cell in placed}, self._built()
        return cells <= built.keys() and {at: name for at, name in built.items() if at not in cells} == self._before


class ClientTruth(WorldTruth):
    """What a virtual client's world really holds."""

    def __init__(self, client: VirtualClient, arena: Arena) -> None:
        super().__init__(arena, lambda: client.way, lambda: client.built)


class CheckedGame:
    """A game whose every outcome is held against its world and the rules.

    An outcome that differs from the world is a wrong cell or a wrong block. One that matches the world but not the
    rules is unnoticed: the action did not happen. ``episodes`` are those that nothing spoiled so far, the running one
    last; ``now`` gives the seconds by which actions are timed.
    """

    resumable = None

    def __init__(self, game: Game, truth: WorldTruth, scenario: Scenario, now: Callable[[], float]) -> None:
        self.scenario, self.counts = scenario, PlayCounts()
        self.cell, self.placed = scenario.start, set[Cell]()
        self.episodes: list[list[Transition]] = []
        self.before_reset: Callable[[], None] = lambda: None
        self.before_act: Callable[[int], None] = lambda _action: None
        self._game, self._truth, self._now = game, truth, now

    @property
    def log(self) -> PlayLog | None:
        """The game's."""
        return self._game.log

    def reset(self, material: int) -> Cell:
        """Begin an episode."""
        self.before_reset()
        self.cell, self.placed = self._game.reset(material), set()
        self.counts.resets += 1
        self._check()
        self.episodes.append([])
        return self.cell

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        """Act in the game, after what happens before that action.

        Where another action follows, its walk may have begun: the cell of this one must have been passed.
        """
        counts, size = self.counts, self.scenario.size
        self.before_act(counts.actions)
        counts.actions += 1
        began = self._now()
        try:
            outcome = self._game.act(action, material, following)
        except LiveError:
            counts.failed_actions += 1
            self.episodes.pop()
            raise
        (counts.placings_s if action in rules.PLACES else counts.moves_s).append(self._now() - began)
        before, left = self.cell, self.scenario.blocks - len(self.placed)
        cell = rules.moved(before, action, self.placed, size)
        block = rules.landing(cell, action, self.placed, size)
        counts.unnoticed += (outcome.cell, outcome.placed) != (cell, block)
        self.cell = outcome.cell
        self.placed |= {outcome.placed} if outcome.placed else set()
        self._check(has_gone_on=following is not None)
        after = self.scenario.blocks - len(self.placed)
        self.episodes[-1].append((*before, left, int(action), *self.cell, after))
        return outcome

    def _check(self, *, has_gone_on: bool = False) -> None:
        was_there = self._truth.passed(self.cell)
        self.counts.wrong_cells += not was_there or not (has_gone_on or self._truth.cell() == self.cell)
        self.counts.wrong_blocks += not self._truth.is_built(self.placed)


def play(game: CheckedGame, steps: Iterable[object], rng: np.random.Generator, *, is_told: bool = False) -> PlayCounts:
    """Play as many random actions as there are steps; LiveError where GIVES_UP resets in a row fail.

    Where ``is_told``, the game is told the next action, drawn for where the rules say that this one leads; it is drawn
    anew where this one led elsewhere.
    """
    in_episode, drawn = None, None
    for _ in steps:
        if in_episode is None:
            in_episode, drawn = _begin(game, rng), None
        action = drawn_action(rng, game.cell, game.placed, game.scenario.size) if drawn is None else drawn
        cell, placed = _expected(game, action)
        drawn = None
        if is_told and not is_over(cell, placed, in_episode + 1, game.scenario):
            drawn = drawn_action(rng, cell, placed, game.scenario.size)
        try:
            game.act(action, None, (drawn, None) if drawn is not None else None)
        except LiveError:
            in_episode = None
            continue
        in_episode += 1
        if (game.cell, game.placed) != (cell, placed):
            drawn = None
        if is_over(game.cell, game.placed, in_episode, game.scenario):
            in_episode = None
    return game.counts


def _expected(game: CheckedGame, action: Action) -> tuple[Cell, set[Cell]]:
    """Return the cell and the blocks that the rules say an action leads to."""
    cell = rules.moved(game.cell, action, game.placed, game.scenario.size)
    block = rules.landing(cell, action, game.placed, game.scenario.size)
    return cell, game.placed | ({block} if block else set())


def _begin(game: CheckedGame, rng: np.random.Generator) -> int:
    """Begin an episode with a random material, in which no step was taken yet."""
    for _try in range(GIVES_UP):
        with suppress(LiveError):
            game.reset(int(rng.integers(len(game.scenario.materials))))
            return 0
        game.counts.gave_up += 1
    raise LiveError(f"{GIVES_UP} resets in a row failed")


def play_in(
    game: LiveGame,
    truth: WorldTruth,
    scenario: Scenario,
    steps: Iterable[object],
    rng: np.random.Generator,
    before_act: Callable[[int], None] = lambda _action: None,
    now: Callable[[], float] = time.perf_counter,
    *,
    is_told: bool = False,
) -> PlayCounts:
    """Play random actions in a live game that is open; returns what was counted, and what the game logged."""
    checked = CheckedGame(game, truth, scenario, now)
    checked.before_act = before_act
    counts = play(checked, steps, rng, is_told=is_told)
    effort = game.log.effort
    counts.corrections, counts.second_clicks = effort.corrections, effort.second_clicks
    counts.recoveries = game.log.recoveries
    return counts


def is_over(cell: Cell, placed: set[Cell], steps: int, scenario: Scenario) -> bool:
    """Return whether an episode ends here: no block is left, or no step, or the agent has walled itself in."""
    is_out = len(placed) == scenario.blocks or steps == scenario.step_limit
    return is_out or next(_possible(cell, placed, scenario.size), None) is None


def drawn_action(rng: np.random.Generator, cell: Cell, placed: set[Cell], size: int) -> Action:
    """Return a random action among those that the rules don't void."""
    return Action(int(rng.choice([int(action) for action in _possible(cell, placed, size)])))


def _possible(cell: Cell, placed: set[Cell], size: int) -> Iterator[Action]:
    for action in Action:
        target = rules.moved(cell, action, placed, size)
        if target != cell or rules.landing(target, action, placed, size) is not None:
            yield action


def figures_of(played: PlayCounts) -> dict[str, Any]:
    """Return the counts and times of playing without mishaps, as JSON holds them."""
    every = sorted([*played.moves_s, *played.placings_s])
    counts = ("actions", "wrong_cells", "wrong_blocks", "failed_actions", "corrections", "second_clicks")
    return {
        **{name: getattr(played, name) for name in counts},
        "median_action_s": percentile(every, 50),
        "p95_action_s": percentile(every, 95),
        "moves": {"median_s": percentile(played.moves_s, 50), "p95_s": percentile(played.moves_s, 95)},
        "placings": {"median_s": percentile(played.placings_s, 50), "p95_s": percentile(played.placings_s, 95)},
    }
