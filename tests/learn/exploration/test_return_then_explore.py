"""Return, then explore, by hand: which steps are repeated, avoided and left, and which episode is the best.

Of many runs, each has its own episodes, and the best are handed to the right learner's row.
"""

import dataclasses
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Float64s, Int64s
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.exploration.return_then_explore import (
    EpisodeStep,
    Excursions,
    ReturnThenExplore,
    blocks_in,
    without_loops,
)
from mc_nested.learn.practice import Step
from mc_nested.learn.preset import ExcursionRule, Imitation
from tests.arena.made_parts import STRIPES
from tests.learn.made_experiments import DOT, small_preset

RULE = ExcursionRule(at_end=0.1, wander=3, rejoin=0.5, repeat=0.8)
ALWAYS, NEVER = 0.0, 0.999


def step(x: int, y: int, action: int, used: bool = False, reward: float = 0.0, state: int | None = None) -> EpisodeStep:
    """Return a step whose state, unless given, is its cell's number."""
    number = 15 * x + y if state is None else state
    return EpisodeStep(x, y, number, action, reward, number + 1, False, used)


def numbers(*values: float) -> np.ndarray:
    return np.array(values)


WALK = [step(7, 14, 1), step(7, 13, 5, used=True, reward=1.0, state=500), step(7, 12, 6, True, 1.0, state=600)]


def after(walk: list[EpisodeStep], rule: ExcursionRule = RULE, row: int = 0) -> ReturnThenExplore:
    """Return a ReturnThenExplore whose one episode so far was that walk."""
    excursions = ReturnThenExplore(rule, actions=8)
    excursions.begin(numbers(0, 0, 0))
    for each in walk:
        excursions.observe(each._replace(row=row))
    excursions.end()
    return excursions


def test_the_first_excursion_wanders_at_random() -> None:
    excursions = ReturnThenExplore(RULE, actions=8)
    excursions.begin(numbers(0.5, 0.5, 0.5))
    assert [excursions.next_action(7, 14, numbers(NEVER, NEVER, which)) for which in (0.0, 0.5, 0.99)] == [0, 4, 7]


def test_an_excursion_repeats_the_best_episode_up_to_its_leaving_step() -> None:
    excursions = after(WALK)
    # 0.6 of the 4 ways to leave a walk of 3 steps is behind its second step.
    excursions.begin(numbers(NEVER, 0.6, 0.0))
    for each in WALK[:2]:
        assert excursions.next_action(each.x, each.y, numbers(NEVER, NEVER, 0.0)) == each.action
        excursions.observe(each)
    assert excursions.next_action(7, 12, numbers(NEVER, NEVER, 0.0)) == 0


def test_a_number_below_at_end_makes_an_excursion_repeat_the_whole_best_episode() -> None:
    excursions = after(WALK)
    excursions.begin(numbers(0.09, 0.0, 0.0))
    actions = []
    for each in WALK:
        actions.append(excursions.next_action(each.x, each.y, numbers(NEVER, NEVER, 0.0)))
        excursions.observe(each)
    assert actions == [each.action for each in WALK]


def test_a_slip_makes_an_excursion_leave_the_best_episode_and_explore() -> None:
    excursions = after(WALK)
    excursions.begin(numbers(0.0, 0.0, 0.4))  # follow it to its end, then wander 1 + int(0.4 · 3) = 2 steps
    assert excursions.next_action(7, 14, numbers(NEVER, NEVER, 0.0)) == 1
    excursions.observe(step(7, 14, 1))
    assert excursions.next_action(6, 14, numbers(ALWAYS, NEVER, 0.0)) == 0, "it is in another cell: not action 5"
    excursions.observe(step(6, 14, 0))
    assert excursions.next_action(7, 12, numbers(ALWAYS, NEVER, 0.0)) == 6, "it may rejoin after a step of its own"


def test_a_missed_placement_counts_as_a_slip() -> None:
    excursions = after(WALK)
    excursions.begin(numbers(0.0, 0.0, 0.0))
    for each in (WALK[0], WALK[1]._replace(used_block=False, reward=0.0)):
        assert excursions.next_action(each.x, each.y, numbers(NEVER, NEVER, 0.0)) == each.action
        excursions.observe(each)
    assert excursions.next_action(7, 12, numbers(NEVER, NEVER, 0.0)) == 0, "x and y agree, b doesn't: not action 6"


def test_an_action_that_wasted_a_block_in_a_cell_is_not_repeated_there() -> None:
    excursions = after([step(7, 14, 4, used=True, reward=0.0), step(7, 14, 6, used=True, reward=0.0)])
    excursions.begin(numbers(NEVER, 0.0, 0.0))
    drawn = {excursions.next_action(7, 14, numbers(NEVER, NEVER, which)) for which in np.arange(0, 1, 0.05)}
    assert drawn == {0, 1, 2, 3, 5, 7}
    elsewhere = {excursions.next_action(7, 13, numbers(NEVER, NEVER, which)) for which in np.arange(0, 1, 0.05)}
    assert elsewhere == set(range(8))


def test_any_action_is_allowed_in_a_cell_where_every_action_wasted_a_block() -> None:
    excursions = after([step(7, 14, action, used=True, reward=0.0) for action in range(8)])
    excursions.begin(numbers(NEVER, 0.0, 0.0))
    assert excursions.next_action(7, 14, numbers(NEVER, NEVER, 0.99)) == 7


def test_an_action_known_to_build_on_the_design_is_repeated_with_the_rules_probability() -> None:
    excursions = after([*WALK[:1], WALK[1]])
    excursions.begin(numbers(NEVER, 0.0, 0.0))
    assert excursions.next_action(7, 13, numbers(NEVER, 0.79, 0.3)) == 5
    assert excursions.next_action(7, 13, numbers(NEVER, 0.81, 0.3)) == 2


def test_a_step_that_placed_no_block_does_not_undo_knowledge_of_its_action() -> None:
    excursions = after([WALK[0], WALK[1], step(7, 13, 5, used=False)])
    excursions.begin(numbers(NEVER, 0.0, 0.0))
    assert excursions.next_action(7, 13, numbers(NEVER, 0.0, 0.0)) == 5


def test_a_wandering_excursion_may_rejoin_the_best_episode_within_its_steps() -> None:
    excursions = after(WALK)
    excursions.begin(numbers(NEVER, 0.0, 0.4))  # leave at once, wander 1 + int(0.4 · 3) = 2 steps
    assert excursions.next_action(7, 14, numbers(ALWAYS, NEVER, 0.0)) == 0, "there is no rejoining before a step"
    excursions.observe(step(7, 14, 0))
    assert excursions.next_action(7, 12, numbers(0.51, NEVER, 0.0)) == 0, "not rejoined: a number above the rule's"
    assert excursions.next_action(7, 12, numbers(0.49, NEVER, 0.0)) == 6, "rejoined at its third step"
    excursions.observe(step(7, 12, 6))
    assert excursions.next_action(7, 12, numbers(ALWAYS, NEVER, 0.0)) == 6, "again: two steps were wandered"
    excursions.observe(step(7, 12, 6))
    assert excursions.next_action(7, 12, numbers(ALWAYS, NEVER, 0.0)) == 0, "three steps are more than it may wander"


def test_an_excursion_never_rejoins_the_best_episode_after_a_wasted_block() -> None:
    excursions = after(WALK)
    excursions.begin(numbers(NEVER, 0.0, 0.99))
    excursions.observe(step(7, 13, 7, used=True, reward=0.0))
    assert excursions.next_action(7, 12, numbers(ALWAYS, NEVER, 0.0)) == 0


def test_the_best_episode_is_cut_after_the_last_block_before_the_first_wasted_one() -> None:
    excursions = after([*WALK, step(5, 5, 0), step(5, 6, 4, used=True, reward=0.0), step(5, 7, 5, True, 1.0)])
    assert excursions.best == WALK


def test_an_episode_becomes_the_best_with_more_blocks_or_as_many_in_no_more_steps() -> None:
    excursions = after(WALK, row=3)
    worse, longer = WALK[:2], [step(6, 14, 2), *WALK]
    equal = [step(8, 14, 1, state=900), *WALK[1:]]
    for walk, taken in ((worse, False), (longer, False), (equal, True)):
        excursions.begin(numbers(0, 0, 0))
        for each in walk:
            excursions.observe(each._replace(row=5))
        assert excursions.end() is taken
    assert excursions.best == [each._replace(row=5) for each in equal]


def test_without_loops_cuts_out_loops() -> None:
    a, b, c = step(1, 1, 0), step(1, 2, 1), step(1, 3, 2)
    assert without_loops([a, b, c, b, a, c]) == [a, c]
    assert without_loops([a, a._replace(action=7)]) == [a._replace(action=7)]


@given(st.lists(st.integers(0, 6), max_size=30))
def test_a_walk_without_loops_visits_each_state_once_and_stays_connected(states: list[int]) -> None:
    walk = [
        step(0, 0, 0, state=now)._replace(next_state=then) for now, then in zip(states, [*states[1:], 99], strict=False)
    ]
    kept = without_loops(walk)
    assert len({each.state for each in kept}) == len(kept)
    assert all(now.next_state == then.state for now, then in pairwise(kept))
    if walk:
        assert (kept[0].state, kept[-1]) == (walk[0].state, walk[-1])


def test_blocks_in_counts_the_blocks_of_a_walk() -> None:
    assert blocks_in(WALK) == 2


@pytest.mark.parametrize("steps", [0, 1, 2])
def test_a_loaded_excursion_continues_where_the_saved_one_was(steps: int) -> None:
    one, other = after(WALK, row=1), ReturnThenExplore(RULE, actions=8)
    one.begin(numbers(NEVER, 0.6, 0.9))
    for each in WALK[:steps]:
        one.next_action(each.x, each.y, numbers(NEVER, NEVER, 0.0))
        one.observe(each)
    other.load({name: kept.copy() for name, kept in one.state().items()})
    assert other.best == one.best == [each._replace(row=1) for each in WALK]
    for each in WALK[steps:]:
        chosen = [some.next_action(each.x, each.y, numbers(ALWAYS, NEVER, 0.3)) for some in (one, other)]
        assert chosen[0] == chosen[1]
        one.observe(each)
        other.observe(each)
    one.end()
    other.end()
    assert one.best == other.best


def test_an_excursions_plan_draws_its_leaving_step_and_its_wandering_steps() -> None:
    rule = ExcursionRule(at_end=0.1, wander=12, rejoin=0.4, repeat=0.8)
    explorer = ReturnThenExplore(rule, actions=8)
    explorer.begin(np.array([0.9, 0.0, 0.5]))
    # Nothing to return along: it leaves at step 0 and wanders 12 / 2 steps after the first.
    assert explorer.state()["plan"][1:3].tolist() == [0, 0 + 1 + 6]
    explorer.best = [EpisodeStep(7, 14 - i, i, 1, 0.0, i + 1, False, False) for i in range(3)]
    explorer.begin(np.array([0.9, 0.6, 0.25]))
    assert explorer.state()["plan"][1:3].tolist() == [int(0.6 * 4), 2 + 1 + 3]
    explorer.begin(np.array([0.05, 0.0, 0.0]))
    assert explorer.state()["plan"][1:3].tolist() == [3, 3 + 1]


@pytest.mark.parametrize(("which", "action"), [(0.0, 3), (0.6, 4)])
def test_a_number_picks_the_step_at_which_a_cell_passed_twice_is_rejoined(which: float, action: int) -> None:
    explorer = ReturnThenExplore(ExcursionRule(at_end=0.1, wander=12, rejoin=1.0, repeat=0.0), actions=8)
    steps = [(7, 13, 3), (7, 12, 0), (7, 13, 4), (7, 12, 0)]
    explorer.best = [EpisodeStep(x, y, i, act, 0.0, i + 1, False, False) for i, (x, y, act) in enumerate(steps)]
    explorer.begin(np.array([0.9, 0.0, 0.9]))  # leaves at once
    explorer.observe(step(7, 14, 1))
    assert explorer.next_action(7, 13, np.array([0.5, 0.5, which])) == action


def test_actions_are_known_to_build_or_waste_blocks_separately_for_each_part() -> None:
    excursions = ReturnThenExplore(RULE, actions=8, parts=2)
    excursions.begin(numbers(0, 0, 0))
    excursions.observe(step(7, 13, 5, used=True, reward=1.0))
    excursions.observe(step(7, 13, 5, used=True, reward=0.0)._replace(part=1))
    excursions.begin(numbers(0, 0, 0))
    assert excursions.next_action(7, 13, numbers(NEVER, 0.0, 0.0), part=0) == 5, "a block there is on the first part"
    drawn = {excursions.next_action(7, 13, numbers(NEVER, 0.0, which), part=1) for which in np.arange(0, 1, 0.05)}
    assert drawn == {0, 1, 2, 3, 4, 6, 7}, "and wasted while the second is built"


def test_the_best_episode_is_rejoined_only_at_a_step_of_the_same_part() -> None:
    ends = WALK[-1]._replace(part=1)
    walk = [*WALK[:2], ends]
    for part, action in ((1, ends.action), (0, 0)):
        excursions = ReturnThenExplore(RULE, actions=8, parts=2)
        excursions.best = walk
        excursions.begin(numbers(0.5, 0.0, 0.9))
        excursions.next_action(7, 14, numbers(NEVER, NEVER, 0.0))
        excursions.observe(step(7, 14, 0))
        assert excursions.next_action(ends.x, ends.y, numbers(ALWAYS, NEVER, 0.0), part) == action


def test_saved_steps_keep_their_parts_and_rows() -> None:
    one = ReturnThenExplore(RULE, actions=8, parts=2)
    one.best = [step(7, 14, 1)._replace(row=3), step(7, 13, 5, True, 1.0)._replace(part=1, row=2)]
    other = ReturnThenExplore(RULE, actions=8, parts=2)
    other.load(one.state())
    assert other.best == one.best


EXCURSION_RULE = ExcursionRule(at_end=1.0, wander=1, rejoin=0.4, repeat=0.8)
PRESET = small_preset().model_copy(
    update={"explore_nested": None, "excursions": EXCURSION_RULE, "imitation": Imitation(batch=2, margin=0.5)}
)
BOTH, START = np.array([0, 1]), np.array([[7, 13, 1], [7, 13, 1]])


NUMBERS = Excursions.numbers


class Done(NamedTuple):
    """One step: the state before, the action, r_N, the state after, and whether the episode terminated."""

    before: Sequence[int]
    action: int
    reward: float
    after: Sequence[int]
    terminated: bool = True


def excursions_of(agent: Agent, *scenarios: Scenario) -> Excursions:
    return Excursions(agent, PRESET, EXCURSION_RULE, scenarios)


def observe(explorer: Excursions, run: int, seen: Done, runs: int = 1, material: int = 0) -> None:
    """Let one run observe a step; nothing happens in the others."""
    before, action, reward, after, terminated = seen
    running = np.arange(runs) == run
    states, next_states = (np.repeat(np.array([state]), runs, axis=0) for state in (before, after))
    chosen, rewards = np.full(runs, material), np.full(runs, float(reward))
    step = Step(
        learning=np.array([run]),
        running=running,
        observations=states[:, :3],
        materials=chosen,
        states=states,
        actions=np.full(runs, action),
        rewards=rewards,
        next_observations=next_states[:, :3],
        next_materials=chosen,
        terminated=np.full(runs, terminated),
        draws=np.empty((runs, 0)),
    )
    explorer.observe(step, next_states)


def end(explorer: Excursions, run: int = 0) -> None:
    explorer.end(np.array([run]), np.zeros(2, np.int64), np.zeros(2))


def act(explorer: Excursions, run: int, observations: Int64s, numbers: Float64s) -> int:
    """Return the next action of that run."""
    return int(explorer.act(np.array([run]), observations, np.zeros(len(observations), np.int64), numbers)[run])


def of_two_runs(name: str = "hierarchical") -> tuple[Agent, Excursions]:
    agent = Agent(AGENT_SPECS[name], [DOT, DOT], PRESET, 0)
    return agent, excursions_of(agent, DOT, DOT)


def played(explorer: Excursions, run: int, material: int, hits: bool = True) -> None:
    """Let one run step back and place its only block."""
    explorer.begin(np.array([run]), np.zeros((2, NUMBERS)))
    step = Done(START[run].tolist(), Action.BD, float(hits), (7, 12, 0))
    observe(explorer, run, step, runs=2, material=material)
    end(explorer, run)


def imitated(agent: Agent) -> list[int]:
    """Return how many steps each row imitates."""
    assert agent.low_level.best is not None
    lengths: list[int] = agent.low_level.best._length.tolist()
    return lengths


def test_the_best_episode_of_a_run_is_imitated_by_the_row_that_played_it() -> None:
    agent, explorer = of_two_runs()
    played(explorer, run=1, material=1)
    assert imitated(agent) == [0, 0, 0, 1]
    played(explorer, run=1, material=0)  # as good, with the other material: the newer one counts
    assert imitated(agent) == [0, 0, 1, 0]
    played(explorer, run=0, material=0, hits=False)  # nothing on the design
    assert imitated(agent) == [0, 0, 1, 0]


def test_an_excursion_repeats_the_runs_own_best_episode() -> None:
    _, explorer = of_two_runs()
    played(explorer, run=1, material=1)
    explorer.begin(BOTH, np.zeros((2, NUMBERS)))
    assert act(explorer, 1, START, np.zeros((2, NUMBERS))) == Action.BD
    # The other run has no best episode: its first number of a step that counts picks among all actions.
    numbers = np.full((2, NUMBERS), 0.99)
    assert act(explorer, 0, START, numbers) == 7


def test_a_loaded_exploration_acts_and_imitates_as_the_saved_one() -> None:
    agent, explorer = of_two_runs()
    played(explorer, run=0, material=1)
    other_agent, other = of_two_runs()
    other.load({name: array.copy() for name, array in explorer.state().items()})
    assert imitated(other_agent) == imitated(agent) == [0, 1, 0, 0]
    for each in (explorer, other):
        each.begin(BOTH, np.zeros((2, NUMBERS)))
    numbers = np.zeros((2, NUMBERS))
    for run in (0, 1):
        assert act(other, run, START, numbers) == act(explorer, run, START, numbers)


def test_a_learner_keeps_no_best_episodes_without_imitation() -> None:
    agent = Agent(AGENT_SPECS["nested"], [DOT], PRESET.model_copy(update={"imitation": None}), 0)
    explorer = excursions_of(agent, DOT)
    explorer.begin(np.array([0]), np.zeros((1, NUMBERS)))
    observe(explorer, 0, Done((7, 13, 1, 0), 7, 1.0, (7, 12, 0, 0)))
    end(explorer)
    assert agent.low_level.best is None
    assert explorer.state()["0.best"].shape == (1, 10)


def test_excursions_remember_outcomes_beyond_15_cells_in_a_larger_arena() -> None:
    far = dataclasses.replace(DOT, design=frozenset({(19, 19)}), start=(19, 19), size=20)
    explorer = excursions_of(Agent(AGENT_SPECS["hierarchical"], [far], PRESET, 0), far)
    only, start = np.array([0]), np.array([[19, 19, 1]])
    explorer.begin(only, np.zeros((1, NUMBERS)))
    observe(explorer, 0, Done((19, 19, 1), Action.BD, 1.0, (19, 18, 0)))
    assert explorer.state()["0.effects"].shape == (1, 20, 20, 8)
    assert explorer.state()["0.effects"][0, 19, 19].any()
    end(explorer)
    explorer.begin(only, np.zeros((1, NUMBERS)))
    assert act(explorer, 0, start, np.zeros((1, NUMBERS))) == Action.BD


def test_each_materials_agent_imitates_its_own_steps_of_an_episode_with_parts() -> None:
    agent = Agent(AGENT_SPECS["hierarchical"], [STRIPES], PRESET, 0)
    explorer = excursions_of(agent, STRIPES)
    states = [(1, 1, 5), (1, 2, 4), (2, 2, 3)]
    explorer.begin(np.array([0]), np.zeros((1, NUMBERS)))
    # Two blocks of the far part by the second material's agent, one of the near part by the first's.
    for material, before, after in zip((1, 1, 0), states, [*states[1:], (3, 1, 2)], strict=True):
        observe(explorer, 0, Done(before, Action.RD, 1.0, after, terminated=False), material=material)
    end(explorer)
    assert imitated(agent) == [1, 2]
    again = Agent(AGENT_SPECS["hierarchical"], [STRIPES], PRESET, 0)
    excursions_of(again, STRIPES).load(explorer.state())
    assert imitated(again) == [1, 2]


def test_a_runs_first_episode_leaves_another_runs_imitation_unchanged() -> None:
    agent, explorer = of_two_runs("nested")
    explorer.begin(BOTH, np.zeros((2, NUMBERS)))
    for run in (0, 1):
        observe(explorer, run, Done((7, 13, 1, 1), 7, 1.0, (7, 12, 0, 1)), runs=2)
        end(explorer, run)
    assert imitated(agent) == [1, 1]


def test_an_action_that_wasted_a_block_in_one_part_is_tried_in_another() -> None:
    agent = Agent(AGENT_SPECS["nested"], [STRIPES], PRESET, 0)
    explorer = excursions_of(agent, STRIPES)
    only, far, near = np.array([0]), np.array([[1, 1, 5]]), np.array([[1, 1, 3]])
    explorer.begin(only, np.zeros((1, NUMBERS)))
    for action in (Action.F, Action.B):
        observe(explorer, 0, Done((1, 1, 5, 0), action, 0.0, (1, 0, 4, 0), terminated=False))
    end(explorer)
    explorer.begin(only, np.zeros((1, NUMBERS)))
    first = [act(explorer, 0, seen, np.array([[*[0.0] * 3, 0.99, 0.99, 0.0]])) for seen in (far, near)]
    assert first == [Action.L, Action.F]
