"""What the agent with objectives does next: its plan, and what the shipped networks build."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.design import random_scenario
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from mc_nested.arrays import Bools, Float32s
from mc_nested.learn.dqn.states import NONE, WANTED, Sees
from mc_nested.learn.evaluation import steps_of, take_steps
from mc_nested.learn.objectives.arenas import framed
from mc_nested.learn.objectives.decide import PATIENCE, Decision, ObjectiveAgent, Plan, built_by_the_rules
from mc_nested.learn.objectives.weights import agent_of, shipped_weights
from sim.grid import GridGame
from tests.learn.objectives.made_objectives import both_by_chance, by_chance, small, training_of

WEIGHTS = shipped_weights()
LINE = load_scenario("line")


@pytest.mark.parametrize("name", shipped_scenarios())
def test_every_shipped_design_is_built_whole_at_the_first_try(name: str) -> None:
    scenario = load_scenario(name)
    placed, steps, score = built_by_the_rules(agent_of(WEIGHTS, scenario), scenario)
    assert placed == scenario.design
    assert steps <= scenario.step_limit
    assert score == scenario.optimum


def test_random_designs_are_built_whole_in_about_the_scripted_builders_steps() -> None:
    scenarios = [random_scenario(7, number, LINE) for number in range(30)]
    built = [built_by_the_rules(agent_of(WEIGHTS, scenario), scenario) for scenario in scenarios]
    whole = [episode.placed == scenario.design for episode, scenario in zip(built, scenarios, strict=True)]
    assert sum(whole) >= 29
    shares = [episode.steps / len(build(scenario)) for episode, scenario in zip(built, scenarios, strict=True)]
    assert np.median(shares) <= 1.15


@pytest.mark.parametrize("size", [5, 11, 32])
def test_a_design_is_built_in_an_arena_of_any_size(size: int) -> None:
    design = frozenset((x, y) for x in (1, 2, size - 2) for y in (1, 3))
    scenario = replace(LINE, name="six", design=design, size=size, start=(size // 2, size - 1), step_limit=200)
    assert built_by_the_rules(agent_of(WEIGHTS, scenario), scenario).placed == design


def test_an_objective_is_kept_until_a_block_has_landed() -> None:
    agent = agent_of(WEIGHTS, LINE)
    plan, cell, placed = Plan(), (0, 0), frozenset[Cell]()
    objectives = []
    while not placed:
        (action, _), plan = agent.decide(plan, cell, placed)
        objectives.append(plan.objective)
        cell, placed = agent.expected(cell, placed, action)
    assert len(objectives) > 5
    assert len(set(objectives)) == 1
    assert placed == set(objectives)
    _, plan = agent.decide(plan, cell, placed)
    assert plan.objective in LINE.design - placed


def test_the_same_is_never_done_twice_in_one_cell_for_one_objective() -> None:
    agent = ObjectiveAgent(WEIGHTS.main, by_chance(len(WEIGHTS.nested), 3), LINE)
    plan, done = Plan(), set()
    for _ in Action:
        (action, _), plan = agent.decide(plan, (3, 3), frozenset())  # nothing ever happens
        done.add(action)
    assert done == set(Action)


def test_an_objective_that_isnt_reached_is_given_up_and_all_of_them_are_tried_again() -> None:
    scenario = replace(LINE, design=frozenset({(2, 3), (4, 3)}), size=5, start=(2, 2))
    agent = agent_of(WEIGHTS, scenario)
    patience = PATIENCE * 7
    plan, objectives = Plan(), []
    for number in range(3 * patience):
        assert agent.is_stuck(plan, frozenset()) == (number > 2 * patience)
        _, plan = agent.decide(plan, (0, 0), frozenset())  # it stands still
        objectives.append(plan.objective)
    first, second, third = (set(objectives[part * patience : (part + 1) * patience]) for part in range(3))
    assert len(first) == len(second) == len(third) == 1
    assert first | second == scenario.design
    assert third <= scenario.design


def test_an_episode_ends_once_every_cell_was_given_up_by_the_rules_as_in_an_arena(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scenario = replace(LINE, design=frozenset({(2, 3), (4, 3)}), size=5, start=(2, 2), step_limit=1000)
    online = training_of(scenario, small()).agent.online()
    agent = ObjectiveAgent(online["main"][0], online["low"][0], scenario)
    decide = agent.decide
    monkeypatch.setattr(agent, "decide", lambda *seen: (Decision(Action.B, 0), decide(*seen)[1]))
    assert built_by_the_rules(agent, scenario) == (frozenset(), 2 * PATIENCE * 7 + 1, scenario.materials[0].p)
    env = ArenaEnv(GridGame(scenario), scenario)
    assert len(take_steps(env, steps_of(agent, env)).actions) == 2 * PATIENCE * 7 + 1


def test_with_parts_only_the_cells_of_the_part_are_objectives_each_of_the_material_worth_most() -> None:
    flag = load_scenario("flag")
    agent, plan, cell, placed = agent_of(WEIGHTS, flag), Plan(), flag.start, frozenset[Cell]()
    while len(placed) < flag.blocks:
        part = flag.in_order[flag.part_at(flag.blocks - len(placed))]
        (action, material), plan = agent.decide(plan, cell, placed)
        assert plan.objective in part.cells
        assert material == part.best_material
        cell, placed = agent.expected(cell, placed, action)


PLACED = frozenset({(1, 1), (3, 2)})


def first_actions(objective: Cell, placed: frozenset[Cell], sees: Sees) -> list[Action]:
    """Return what a nested agent that learnt nothing does first for that objective, in each cell that stays free."""
    scenario = replace(LINE, design=frozenset({objective}), size=5, start=(0, 0))
    agent = ObjectiveAgent(*both_by_chance(1), scenario, sees)
    free = sorted(set(product(range(5), range(5))) - PLACED)
    return [agent.decide(Plan(), cell, placed)[0].action for cell in free]


@pytest.mark.parametrize("sees", ["everything", "objective", "surroundings"])
def test_what_the_nested_agent_isnt_shown_changes_nothing_that_it_does(sees: Sees) -> None:
    there = first_actions((2, 4), PLACED, sees)
    assert (first_actions((2, 4), frozenset(), sees) == there) == (sees == "objective")
    assert (first_actions((4, 1), PLACED, sees) == there) == (sees == "surroundings")


def test_something_else_than_the_main_agents_network_can_choose_the_next_cell() -> None:
    agent = ObjectiveAgent(*both_by_chance(1), LINE)
    farthest = max(LINE.design)

    def prefers(planes: Bools) -> Float32s:
        worth: Float32s = np.where(planes[:, WANTED], np.float32(0), NONE)
        worth[:, framed(farthest)[0], framed(farthest)[1]] = 1
        return worth

    agent.order = prefers
    assert agent.decide(Plan(), LINE.start, frozenset())[1].objective == farthest


def test_the_same_plan_decides_the_same() -> None:
    one, other = agent_of(WEIGHTS, LINE), agent_of(WEIGHTS, LINE)
    assert one.decide(Plan(), LINE.start, frozenset()) == other.decide(Plan(), LINE.start, frozenset())


def test_nothing_is_decided_once_everything_stands() -> None:
    with pytest.raises(ValueError, match="nothing is left"):
        agent_of(WEIGHTS, LINE).decide(Plan(), (0, 0), LINE.design)


@pytest.mark.parametrize(
    ("left", "chosen"),
    [
        ({(0, 4), (0, 2)}, (0, 4)),  # with a block on (0, 2), nobody gets to (0, 3)
        ({(0, 2)}, (0, 2)),
        ({(0, 4), (0, 2), (2, 1)}, (2, 1)),  # what is worth most of the others
    ],
)
def test_a_cell_that_loses_another_one_is_chosen_only_where_there_is_no_other(left: set[Cell], chosen: Cell) -> None:
    stands = frozenset({(1, 3), (1, 4)})
    agent = ObjectiveAgent(*both_by_chance(1), replace(LINE, size=5, start=(2, 3), design=stands | left))
    agent.order = lambda planes: np.where(planes[:, WANTED], -np.arange(49.0).reshape(7, 7).T, NONE).astype(np.float32)
    _, plan = agent.decide(Plan(blocks=2), (2, 3), stands)
    assert plan.objective == chosen
