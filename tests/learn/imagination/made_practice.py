"""Practice of a small design, with everything known of its game."""

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.imagination.arena_step import ImaginedArena, imagined_arena
from mc_nested.learn.imagination.beliefs import Belief, Beliefs
from mc_nested.learn.imagination.learnt_rules import LearntRules
from mc_nested.learn.imagination.practice_session import Goal, RealTransitions
from mc_nested.learn.learner import Learner
from tests.learn.imagination.made_games import BENT, SMALL, TRUE_MOVES, TRUE_PLACES

GOAL = Goal(BENT.start, BENT.blocks, BENT.step_limit, float(BENT.blocks), 20_000, 20_000)
MATERIAL = np.array([1])


def arena_of(scenario: Scenario = BENT) -> ImaginedArena:
    """Return the true game of a design, as if it had been learnt completely."""
    pay = np.zeros((scenario.size, scenario.size), np.float32)
    for cell in scenario.design:
        pay[cell] = 1.0
    walls = np.zeros((scenario.size, scenario.size), np.bool_)
    rules = LearntRules(
        np.array(TRUE_MOVES),
        np.ones(len(Action), np.bool_),
        np.array(TRUE_PLACES),
        (0, 1),
        walls,
        np.zeros(0, np.int64),
    )
    cells = np.where(pay > 0, Belief.PAYS, Belief.PAYS_NOT).astype(np.int8)
    return imagined_arena(rules, Beliefs(cells, pay, False, float(scenario.blocks)))


def learner_of(rows: int = 1, seed: int = 0) -> Learner:
    """Return a nested agent for the small design, untaught."""
    return Agent(AGENT_SPECS["nested"], [BENT] * rows, SMALL, seed).low_level


def real_of(learner: Learner, *steps: tuple[list[int], int, list[int], int]) -> RealTransitions:
    """Make transitions of the state before, the action, the state after, and the arena's cell where a block landed."""
    before, actions, after, landed = (np.array([step[part] for step in steps], dtype=np.int64) for part in range(4))
    index = learner.states.encoded
    states, next_states = (index(each.reshape(-1, 4)) for each in (before, after))
    return RealTransitions(states, next_states, actions, landed, after.reshape(-1, 4)[:, 2] == 0)
