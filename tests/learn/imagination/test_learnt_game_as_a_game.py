"""The learnt game, taught by transitions of the real rules, keeps the contract of every Game."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.game import Following, Game, Outcome
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.imagination.arena_step import NOWHERE, ImaginedArena, cell_at, imagined_arena, index_of, step
from mc_nested.learn.imagination.beliefs import believe, evidence_of
from mc_nested.learn.imagination.learnt_rules import learn_rules
from sim.grid import GridGame
from tests.arena.game_contract import BUMPS, check_following, check_game
from tests.learn.imagination import made_games
from tests.learn.imagination.made_games import BENT, TRUE_MOVES, TRUE_PLACES, MadeUpGame, Slipping, seen_at_random

LINE = load_scenario("line")


class ImaginedGame(made_games.Plain):
    """A Game that plays by the learnt rules."""

    def __init__(self, arena: ImaginedArena, start: Cell) -> None:
        self._arena = arena
        self._start = index_of(start, arena)
        self._position = self._start
        self._solid = arena.empty.copy()

    def reset(self, material: int) -> Cell:  # noqa: ARG002 - what was learnt is the same for every material
        self._position = self._start
        self._solid = self._arena.empty.copy()
        return cell_at(self._position, self._arena)

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:  # noqa: ARG002 - and so are these
        self._position, block = step(self._arena, self._position, int(action), self._solid)
        placed = None if block == NOWHERE else cell_at(block, self._arena)
        return Outcome(cell_at(self._position, self._arena), placed)


def imagined(game: Game, scenario: Scenario, episodes: int) -> ImaginedGame:
    """Return the game that is learnt from random actions in another one."""
    seen = seen_at_random(game, scenario, episodes)
    rules = learn_rules(seen.steps, seen.first_of_episode, len(Action), scenario.size)
    beliefs = believe(evidence_of(seen.steps, rules.lands, scenario.size), rules.lands, scenario.blocks)
    return ImaginedGame(imagined_arena(rules, beliefs), scenario.start)


TAUGHT = imagined(GridGame(LINE), LINE, 20)


def test_a_learnt_game_of_the_real_rules_passes_the_game_contract() -> None:
    check_game(TAUGHT, LINE, BUMPS)
    check_game(TAUGHT, LINE, build(LINE))
    check_following(TAUGHT, LINE, build(LINE))


@given(st.lists(st.sampled_from(Action), max_size=80))
def test_a_learnt_game_passes_the_contract_over_any_actions(actions: list[Action]) -> None:
    check_game(TAUGHT, LINE, actions)


def test_a_game_learnt_from_slipping_actions_passes_the_contract() -> None:
    check_game(imagined(Slipping(GridGame(LINE), 0.05, np.random.default_rng(1)), LINE, 30), LINE, BUMPS)


def test_a_game_learnt_from_too_little_fails_the_contract() -> None:
    with pytest.raises(AssertionError):
        check_game(imagined(GridGame(LINE), LINE, 0), LINE, BUMPS)


@given(st.lists(st.sampled_from(Action), max_size=40))
def test_a_game_learnt_from_other_rules_follows_those_rules(actions: list[Action]) -> None:
    def other() -> MadeUpGame:
        return MadeUpGame(TRUE_MOVES[::-1], TRUE_PLACES[::-1], (1, 0), BENT)

    real, learnt = other(), TAUGHT_OTHERWISE
    assert learnt.reset(1) == real.reset(1) == BENT.start
    assert [learnt.act(action) for action in actions] == [real.act(action) for action in actions]


TAUGHT_OTHERWISE = imagined(MadeUpGame(TRUE_MOVES[::-1], TRUE_PLACES[::-1], (1, 0), BENT), BENT, 30)
