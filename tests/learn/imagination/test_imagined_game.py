"""The learnt game is a Game: taught by transitions of the real rules, it passes what every Game has to."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.game import Game
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.imagination.arena_step import imagined_arena
from mc_nested.learn.imagination.beliefs import believe
from mc_nested.learn.imagination.imagined_game import ImaginedGame
from mc_nested.learn.imagination.learnt_rules import learn_rules
from sim.grid import GridGame
from tests.arena.game_contract import BUMPS, check_game
from tests.learn.imagination.made_games import BENT, TRUE_MOVES, TRUE_PLACES, MadeUpGame, Slipping, seen_at_random

LINE = load_scenario("line")


def imagined(game: Game, scenario: Scenario, episodes: int) -> ImaginedGame:
    """The game that random actions in another one teach."""
    seen = seen_at_random(game, scenario, episodes)
    rules = learn_rules(seen.steps, seen.first_of_episode, len(Action), scenario.size)
    beliefs = believe(seen.steps, rules.lands, scenario.size, scenario.blocks)
    return ImaginedGame(imagined_arena(rules, beliefs), scenario.start)


TAUGHT = imagined(GridGame(LINE), LINE, 20)


def test_taught_by_the_real_rules_it_passes_what_every_game_does() -> None:
    check_game(TAUGHT, LINE, BUMPS)
    check_game(TAUGHT, LINE, build(LINE))


@given(st.lists(st.sampled_from(Action), max_size=80))
def test_it_passes_over_any_actions(actions: list[Action]) -> None:
    check_game(TAUGHT, LINE, actions)


def test_taught_by_a_game_where_actions_slip_it_passes_too() -> None:
    check_game(imagined(Slipping(GridGame(LINE), 0.05, np.random.default_rng(1)), LINE, 30), LINE, BUMPS)


def test_taught_too_little_it_does_not_pass() -> None:
    with pytest.raises(AssertionError):
        check_game(imagined(GridGame(LINE), LINE, 0), LINE, BUMPS)


@given(st.lists(st.sampled_from(Action), max_size=40))
def test_taught_by_other_rules_it_does_what_those_say(actions: list[Action]) -> None:
    def other() -> MadeUpGame:
        return MadeUpGame(TRUE_MOVES[::-1], TRUE_PLACES[::-1], (1, 0), BENT)

    real, learnt = other(), TAUGHT_OTHERWISE
    assert learnt.reset(1) == real.reset(1) == BENT.start
    assert [learnt.act(action) for action in actions] == [real.act(action) for action in actions]


TAUGHT_OTHERWISE = imagined(MadeUpGame(TRUE_MOVES[::-1], TRUE_PLACES[::-1], (1, 0), BENT), BENT, 30)


def test_it_takes_no_time_and_can_be_saved() -> None:
    assert TAUGHT.log is None
    assert TAUGHT.resumable is TAUGHT


def test_what_was_saved_is_no_view_of_the_game_that_goes_on() -> None:
    TAUGHT.reset(0)
    kept = TAUGHT.snapshot()
    said = [TAUGHT.act(action) for action in BUMPS]
    TAUGHT.restore(kept)
    assert [TAUGHT.act(action) for action in BUMPS] == said
    TAUGHT.restore(kept)
    assert [TAUGHT.act(action) for action in BUMPS] == said, "restoring leaves what was saved as it was"
