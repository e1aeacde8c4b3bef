"""The exploration of many runs: each run's own episodes, and the best of them handed to the right learner's row."""

import dataclasses

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.exploration.batched_return_then_explore import NUMBERS, BatchedReturnThenExplore
from mc_nested.learn.preset import ExcursionRule, Imitation
from tests.arena.made_parts import STRIPES
from tests.learn.made_experiments import DOT, small_preset

RULE = ExcursionRule(at_end=1.0, wander=1, rejoin=0.4, repeat=0.8)
PRESET = small_preset().model_copy(
    update={"explore_nested": None, "excursions": RULE, "imitation": Imitation(batch=2, margin=0.5)}
)
BOTH, START = np.array([0, 1]), np.array([[7, 13, 1], [7, 13, 1]])


def of_two_runs(name: str = "hierarchical") -> tuple[Agent, BatchedReturnThenExplore]:
    agent = Agent(AGENT_SPECS[name], [DOT, DOT], PRESET, 0)
    return agent, BatchedReturnThenExplore(RULE, agent, [DOT, DOT])


def played(explorer: BatchedReturnThenExplore, run: int, row: int, hits: bool = True) -> None:
    """One run steps back and places its only block."""
    only, after = np.array([run]), np.array([[7, 12, 0]])
    explorer.begin(only, np.zeros((2, NUMBERS)))
    reward, action = np.array([float(hits)]), np.array([int(Action.BD)])
    explorer.observe(only, START[[run]], START[[run]], action, reward, after, np.array([True]), np.array([row]))
    explorer.end(only)


def imitated(agent: Agent) -> list[int]:
    """How many steps each row imitates."""
    assert agent.low_level.best is not None
    lengths: list[int] = agent.low_level.best._length.tolist()
    return lengths


def test_the_best_episode_of_a_run_is_imitated_by_the_row_that_played_it() -> None:
    agent, explorer = of_two_runs()
    played(explorer, run=1, row=3)
    assert imitated(agent) == [0, 0, 0, 1]
    played(explorer, run=1, row=2)  # as good, with the other material: the newer one counts
    assert imitated(agent) == [0, 0, 1, 0]
    played(explorer, run=0, row=0, hits=False)  # nothing on the design
    assert imitated(agent) == [0, 0, 1, 0]


def test_an_excursion_repeats_the_runs_own_best_episode() -> None:
    _, explorer = of_two_runs()
    played(explorer, run=1, row=3)
    explorer.begin(BOTH, np.zeros((2, NUMBERS)))
    assert explorer.act(np.array([1]), START, np.zeros((2, NUMBERS))).tolist() == [Action.BD]
    # The other run has no best episode: its first number of a step that counts picks among all actions.
    numbers = np.full((2, NUMBERS), 0.99)
    assert explorer.act(np.array([0]), START, numbers).tolist() == [7]


def test_a_loaded_exploration_goes_on_and_imitates_what_it_did() -> None:
    agent, explorer = of_two_runs()
    played(explorer, run=0, row=1)
    other_agent, other = of_two_runs()
    other.load({name: array.copy() for name, array in explorer.state().items()})
    assert imitated(other_agent) == imitated(agent) == [0, 1, 0, 0]
    for each in (explorer, other):
        each.begin(BOTH, np.zeros((2, NUMBERS)))
    numbers = np.zeros((2, NUMBERS))
    assert other.act(BOTH, START, numbers).tolist() == explorer.act(BOTH, START, numbers).tolist()


def test_without_imitation_no_best_episode_is_kept_for_it() -> None:
    agent = Agent(AGENT_SPECS["nested"], [DOT], PRESET.model_copy(update={"imitation": None}), 0)
    explorer = BatchedReturnThenExplore(RULE, agent, [DOT])
    played_states = np.array([[7, 13, 1, 0]])
    explorer.begin(np.array([0]), np.zeros((1, NUMBERS)))
    after = np.array([[7, 12, 0, 0]])
    seen = np.array([7]), np.ones(1), after, np.array([True])
    explorer.observe(np.array([0]), START[:1], played_states, *seen, np.array([0]))
    explorer.end(np.array([0]))
    assert agent.low_level.best is None
    assert explorer.state()["0.best"].shape == (1, 10)


def test_in_a_larger_arena_it_remembers_what_happened_beyond_15_cells() -> None:
    far = dataclasses.replace(DOT, design=frozenset({(19, 19)}), start=(19, 19), size=20)
    explorer = BatchedReturnThenExplore(RULE, Agent(AGENT_SPECS["hierarchical"], [far], PRESET, 0), [far])
    only, start, after = np.array([0]), np.array([[19, 19, 1]]), np.array([[19, 18, 0]])
    explorer.begin(only, np.zeros((1, NUMBERS)))
    explorer.observe(only, start, start, np.array([int(Action.BD)]), np.ones(1), after, np.array([True]), only)
    assert explorer.state()["0.effects"].shape == (1, 20, 20, 8)
    assert explorer.state()["0.effects"][0, 19, 19].any()
    explorer.end(only)
    explorer.begin(only, np.zeros((1, NUMBERS)))
    assert explorer.act(only, start, np.zeros((1, NUMBERS))).tolist() == [Action.BD]


def test_each_row_imitates_its_own_steps_of_an_episode_in_parts() -> None:
    agent = Agent(AGENT_SPECS["hierarchical"], [STRIPES], PRESET, 0)
    explorer = BatchedReturnThenExplore(RULE, agent, [STRIPES])
    only = np.array([0])
    states = [np.array([state]) for state in ([1, 1, 5], [1, 2, 4], [2, 2, 3], [2, 1, 3])]
    explorer.begin(only, np.zeros((1, NUMBERS)))
    # Two blocks of the far part by the second material's agent, one of the near part by the first's.
    for row, before, after in zip((1, 1, 0), states[:3], [*states[1:3], np.array([[3, 1, 2]])], strict=True):
        seen = np.array([int(Action.RD)]), np.ones(1), after, np.array([False])
        explorer.observe(only, before, before, *seen, np.array([row]))
    explorer.end(only)
    assert imitated(agent) == [1, 2]
    again = Agent(AGENT_SPECS["hierarchical"], [STRIPES], PRESET, 0)
    BatchedReturnThenExplore(RULE, again, [STRIPES]).load(explorer.state())
    assert imitated(again) == [1, 2]


def test_a_runs_first_episode_takes_nothing_from_another_run() -> None:
    agent, explorer = of_two_runs("nested")
    explorer.begin(BOTH, np.zeros((2, NUMBERS)))
    after = np.array([[7, 12, 0, 1]])
    for run in (0, 1):
        only = np.array([run])
        before = np.array([[7, 13, 1, 1]])
        explorer.observe(only, START[[run]], before, np.array([7]), np.ones(1), after, np.array([True]), only)
        explorer.end(only)
    assert imitated(agent) == [1, 1]


def test_what_was_wasted_in_one_part_is_tried_in_another() -> None:
    agent = Agent(AGENT_SPECS["nested"], [STRIPES], PRESET, 0)
    explorer = BatchedReturnThenExplore(RULE, agent, [STRIPES])
    only, far, near = np.array([0]), np.array([[1, 1, 5]]), np.array([[1, 1, 3]])
    explorer.begin(only, np.zeros((1, NUMBERS)))
    wasted = np.array([[1, 0, 4, 0]])
    for action in (Action.F, Action.B):
        seen = np.array([int(action)]), np.zeros(1), wasted, np.array([False])
        explorer.observe(only, far, np.array([[1, 1, 5, 0]]), *seen, only)
    explorer.end(only)
    explorer.begin(only, np.zeros((1, NUMBERS)))
    first = [explorer.act(only, seen, np.array([[*[0.0] * 3, 0.99, 0.99, 0.0]])).tolist() for seen in (far, near)]
    assert first == [[Action.L], [Action.F]]
