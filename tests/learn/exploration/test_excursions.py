"""The excursions of many runs: each run's own episodes, and the best of them handed to the right learner's row."""

import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Float64s, Int64s
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.exploration.excursions import Excursions
from mc_nested.learn.practice import Step
from mc_nested.learn.preset import ExcursionRule, Imitation
from tests.arena.made_parts import STRIPES
from tests.learn.made_experiments import DOT, small_preset

RULE = ExcursionRule(at_end=1.0, wander=1, rejoin=0.4, repeat=0.8)
PRESET = small_preset().model_copy(
    update={"explore_nested": None, "excursions": RULE, "imitation": Imitation(batch=2, margin=0.5)}
)
BOTH, START = np.array([0, 1]), np.array([[7, 13, 1], [7, 13, 1]])


NUMBERS = Excursions.numbers


class Done(NamedTuple):
    """The state before it, the action, r_N, the state after it, and whether that was the last."""

    before: Sequence[int]
    action: int
    reward: float
    after: Sequence[int]
    terminated: bool = True


def excursions_of(agent: Agent, *scenarios: Scenario) -> Excursions:
    return Excursions(agent, PRESET, RULE, scenarios)


def observe(explorer: Excursions, run: int, seen: Done, runs: int = 1, material: int = 0) -> None:
    """Let one run observe that; nothing happens in the others."""
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


def test_a_loaded_exploration_goes_on_and_imitates_what_it_did() -> None:
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


def test_without_imitation_no_best_episode_is_kept_for_it() -> None:
    agent = Agent(AGENT_SPECS["nested"], [DOT], PRESET.model_copy(update={"imitation": None}), 0)
    explorer = excursions_of(agent, DOT)
    explorer.begin(np.array([0]), np.zeros((1, NUMBERS)))
    observe(explorer, 0, Done((7, 13, 1, 0), 7, 1.0, (7, 12, 0, 0)))
    end(explorer)
    assert agent.low_level.best is None
    assert explorer.state()["0.best"].shape == (1, 10)


def test_in_a_larger_arena_it_remembers_what_happened_beyond_15_cells() -> None:
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


def test_each_row_imitates_its_own_steps_of_an_episode_in_parts() -> None:
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


def test_a_runs_first_episode_takes_nothing_from_another_run() -> None:
    agent, explorer = of_two_runs("nested")
    explorer.begin(BOTH, np.zeros((2, NUMBERS)))
    for run in (0, 1):
        observe(explorer, run, Done((7, 13, 1, 1), 7, 1.0, (7, 12, 0, 1)), runs=2)
        end(explorer, run)
    assert imitated(agent) == [1, 1]


def test_what_was_wasted_in_one_part_is_tried_in_another() -> None:
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
