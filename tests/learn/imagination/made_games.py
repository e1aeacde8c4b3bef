"""Games to learn from, small designs to learn on, and what an agent saw in them."""

from collections.abc import Callable, Sequence

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Following, Game, Outcome, PlayLog, Resumable
from mc_nested.arena.rules import PLACES, STEP
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.learnt_rules import LearntRules
from mc_nested.learn.preset import ImaginationRule, Preset, load_preset
from tests.learn.made_experiments import MATERIALS

BENT = Scenario("bent", frozenset({(2, 3), (3, 3), (3, 4)}), (2, 1), 14, MATERIALS, size=5)
"""Three blocks around a corner."""

TWO = Scenario("two", frozenset({(1, 3), (2, 3)}), (2, 1), 8, MATERIALS, size=5)
"""Two blocks side by side."""

LIVE = load_preset("model-based")
RULE = ImaginationRule(
    highest_epsilon=1.0,
    lowest_epsilon=0.05,
    enough=0.9,
    updates_exploring=4_000,
    updates_building=20_000,
    table_steps_exploring=20_000,
    table_steps_building=20_000,
    n_steps=4,
)
SMALL = LIVE.model_copy(
    update={
        "episodes": 12,
        "hidden": [24, 16],
        "update": LIVE.update.model_copy(
            update={"batch": 16, "learning_starts": 100, "learning_rate": 3e-3, "target_period": 50, "gamma": 0.9}
        ),
        "imagination": RULE,
    }
)
"""The preset model-based for designs of a few blocks."""


def with_update(preset: Preset, **changes: float) -> Preset:
    """Return that preset with other hyper-parameters in its table [update]."""
    return preset.model_copy(update={"update": preset.update.model_copy(update=changes)})


class Plain:
    """A game that can't be saved half-way and notes nothing."""

    @property
    def resumable(self) -> Resumable | None:
        return None

    @property
    def log(self) -> PlayLog | None:
        return None


class MadeUpGame(Plain):
    """A game with its own rules: where each action leads, which place a block, and where that lands."""

    def __init__(self, moves: Sequence[Cell], places: Sequence[bool], lands: Cell, scenario: Scenario) -> None:
        self._moves, self._places, self._lands = moves, places, lands
        self._start, self._size = scenario.start, scenario.size
        self._cell, self._blocks = scenario.start, set[Cell]()

    def reset(self, material: int) -> Cell:  # noqa: ARG002 - the rules are the same for every material
        self._cell, self._blocks = self._start, set()
        return self._cell

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:  # noqa: ARG002 - and so are these
        ahead = (self._cell[0] + self._moves[action][0], self._cell[1] + self._moves[action][1])
        if self._is_free(ahead):
            self._cell = ahead
        block = (self._cell[0] + self._lands[0], self._cell[1] + self._lands[1])
        if not self._places[action] or not self._is_free(block):
            return Outcome(self._cell, None)
        self._blocks.add(block)
        return Outcome(self._cell, block)

    def _is_free(self, cell: Cell) -> bool:
        return all(0 <= part < self._size for part in cell) and cell not in self._blocks


TRUE_MOVES = [STEP[action] for action in Action]
TRUE_PLACES = [action in PLACES for action in Action]


def play(game: Game, scenario: Scenario, actions: Sequence[int], seen: Experience, material: int = 0) -> int:
    """Play one episode of these actions; return how many were done. A slip is recorded as what was meant."""
    return play_by(game, scenario, lambda step: actions[step], len(actions), seen, material)


def play_by(
    game: Game, scenario: Scenario, choose: Callable[[int], int], steps: int, seen: Experience, material: int = 0
) -> int:
    """Play one episode of at most that many steps; ``choose`` gives the action of each step."""
    seen.begin()
    x, y = game.reset(material)
    left, score = scenario.blocks, scenario.materials[material].p
    for step in range(steps):
        action = choose(step)
        outcome = game.act(Action(action))
        paid, used = int(outcome.placed in scenario.design), outcome.placed is not None
        seen.add(RealStep(x, y, left, action, *outcome.cell, left - used, paid, material))
        (x, y), left, score = outcome.cell, left - used, score + paid
        if left == 0:
            break
    seen.end(material, score)
    return step + 1


class Slipping(Plain):
    """A game in which some of the actions are done as another."""

    def __init__(self, game: Game, share: float, random: np.random.Generator) -> None:
        self._game, self._share, self._random = game, share, random

    def reset(self, material: int) -> Cell:
        return self._game.reset(material)

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        if self._random.random() < self._share:
            action = Action(int(self._random.integers(0, len(Action))))
        return self._game.act(action, material, following)


def seen_at_random(game: Game, scenario: Scenario, episodes: int, seed: int = 0) -> Experience:
    """Return what random actions show of a game."""
    random, seen = np.random.default_rng(seed), Experience()
    for _ in range(episodes):
        play(game, scenario, random.integers(0, len(Action), scenario.step_limit).tolist(), seen)
    return seen


def assert_rules(rules: LearntRules, moves: Sequence[Cell], places: Sequence[bool], lands: Cell) -> None:
    """Raise AssertionError unless the learnt rules are these."""
    assert list(map(tuple, rules.moves.tolist())) == list(moves)
    assert rules.known.all()
    assert rules.places.tolist() == list(places)
    assert rules.lands == lands
