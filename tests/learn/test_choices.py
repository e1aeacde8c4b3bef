"""The main agent's choices in scenarios with parts: what each is credited with, when it learns, and in which state."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.scenario import Part, Scenario
from mc_nested.arrays import Arrays, Int64s
from mc_nested.errors import PresetError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.learner import Learner
from mc_nested.learn.preset import MainUpdates, Preset, load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.arena.made_parts import STONE, STRIPES, WOOD
from tests.learn.made_experiments import DOT, small_preset
from tests.learn.made_trainings import finish

ONE_PART = replace(DOT, parts=(Part(DOT.design, (-5.0, 10.0)),))


def trainer_of(
    scenarios: Sequence[Scenario], agent: str = "nested", preset: Preset | None = None, seed: int = 0
) -> Trainer:
    preset, spec = preset or small_preset(12), AGENT_SPECS[agent]
    made = Agent(spec, scenarios, preset, seed)
    return Trainer(made.view_of(GridVectorEnv(scenarios), scenarios), scenarios, made, preset, seed)


def main_of(trainer: Trainer) -> Learner:
    assert trainer.agent.main is not None
    return trainer.agent.main


def transitions(learner: Learner, row: int = 0) -> list[tuple[int, int, float, int, float]]:
    """Return state, action, reward, next state and discount of what a row remembers, oldest first."""
    every = learner.replay.added_since(None)
    ends = np.cumsum(every["counts"])
    of_row = slice(ends[row] - every["counts"][row], ends[row])
    states, following = np.moveaxis(every["states"].reshape(-1, 2), -1, 0)
    columns = (states, every["actions"], every["rewards"], following, every["discounts"])
    return [tuple(values) for values in zip(*(column[of_row].tolist() for column in columns), strict=True)]


def index(learner: Learner, *state: int) -> int:
    return int(learner.states.encoded(np.array([state]))[0])


class Follows:
    """Low-level agents that do what they are told, tick by tick."""

    def __init__(self, actions: Sequence[int]) -> None:
        self._actions = iter(actions)

    def __call__(self, states: Int64s, *_: object) -> Int64s:
        return np.full(len(states), next(self._actions, int(Action.F)))


def test_a_choice_is_credited_with_its_parts_reward_and_leads_to_the_next_choices_state(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    preset = small_preset(1).model_copy(update={"evaluate_every": 100})
    trainer = trainer_of([STRIPES], preset=preset)
    main, far = main_of(trainer), (Action.FD, Action.RD)
    near = (Action.B, Action.RD, Action.L, Action.LD, Action.RD)
    monkeypatch.setattr(trainer.agent, "act", Follows([*far, *near]))
    choices = iter([STONE, WOOD])
    monkeypatch.setattr(main, "act", lambda states, *_: np.full(len(states), next(choices)))
    for _ in (*far, *near):
        trainer.tick()
    start, middle, end = (index(main, *state) for state in ((1, 1, 5), (2, 2, 3), (2, 1, 0)))
    gamma = pytest.approx(preset.update.gamma)
    assert transitions(main) == [(start, STONE, 2 + 10, middle, gamma), (middle, WOOD, 3 + 6, end, 0.0)]
    assert trainer.episode_rows[0].score == STRIPES.optimum
    # The nested agent's state holds the choice for what comes, where a part is used up.
    low = trainer.agent.low_level
    kept = transitions(low)
    assert [step[3] for step in kept[1:3]] == [index(low, 2, 2, 3, WOOD), index(low, 2, 1, 3, WOOD)]
    assert kept[1][4] == gamma


@pytest.mark.parametrize(("second", "steps"), [(WOOD, [1, 2]), (STONE, [0, 3])])
def test_each_materials_agent_stores_its_own_steps_and_a_switch_ends_no_episode(
    monkeypatch: pytest.MonkeyPatch, second: int, steps: list[int]
) -> None:
    preset = small_preset(1).model_copy(update={"evaluate_every": 100})
    trainer = trainer_of([STRIPES], "hierarchical", preset)
    monkeypatch.setattr(trainer.agent, "act", Follows([Action.FD, Action.RD, Action.B]))
    choices = iter([STONE, second])
    monkeypatch.setattr(main_of(trainer), "act", lambda states, *_: np.full(len(states), next(choices)))
    for _ in range(3):
        trainer.tick()
    assert trainer.agent.low_level.replay.added.tolist() == steps
    assert [step[4] for step in transitions(trainer.agent.low_level, STONE)][1] == pytest.approx(preset.update.gamma)


def test_an_episodes_score_is_the_sum_of_its_choices_rewards() -> None:
    trainer = finish(trainer_of([STRIPES, replace(STRIPES, choose_every=3)], preset=small_preset(30)))
    for run in range(2):
        returns, total = [], 0.0
        for *_, reward, _, discount in transitions(main_of(trainer), run):
            total += reward
            if discount == 0.0:
                returns.append(total)
                total = 0.0
        scores = [row.score for row in trainer.episode_rows if row.trial == run]
        assert returns == pytest.approx(scores)
        assert total == 0.0


def test_each_choice_is_followed_by_as_many_updates_as_the_preset_says() -> None:
    preset = small_preset(30)
    several = preset.model_copy(update={"main": MainUpdates(learning_starts=2, updates_an_episode=5)})
    for each, starts, updates in ((preset, preset.update.learning_starts, 1), (several, 2, 5)):
        main = main_of(finish(trainer_of([STRIPES], preset=each)))
        assert main.replay.added[0] > 30, "some episodes have two choices"
        assert main.engine.updates.tolist() == [(main.replay.added[0] - starts + 1) * updates]


@pytest.mark.parametrize("agent", ["nested", "hierarchical"])
def test_a_training_with_one_part_is_the_same_to_the_bit_as_without_parts(agent: str) -> None:
    one, none = (finish(trainer_of([scenario] * 2, agent)) for scenario in (ONE_PART, DOT))
    assert one.episode_rows == none.episode_rows
    assert one.evaluation_rows == none.evaluation_rows
    for name, kept in none.agent.state().items():
        np.testing.assert_array_equal(one.agent.state()[name], kept, err_msg=name)


@pytest.mark.parametrize("agent", ["nested", "hierarchical", "single"])
def test_a_run_learns_the_same_alone_in_a_batch_and_resumed(agent: str) -> None:
    scenarios = [replace(STRIPES, choose_every=2), STRIPES]
    both = finish(trainer_of(scenarios, agent))
    alone = finish(trainer_of(scenarios[:1], agent))
    assert [row for row in both.episode_rows if row.trial == 0] == alone.episode_rows
    stopped = trainer_of(scenarios, agent)
    while stopped.ticks < 5 or (agent != "single" and not stopped.state()["choices.earned"].any()):
        stopped.tick()  # until a run is in a later choice, before which something was earned
    assert not stopped.finished
    state: Arrays = {name: kept.copy() for name, kept in stopped.state().items()}
    resumed = trainer_of(scenarios, agent)
    resumed.load(state, [stopped.journal(None)])
    finish(resumed)
    assert resumed.episode_rows == both.episode_rows
    assert resumed.evaluation_rows == both.evaluation_rows
    for name, kept in both.agent.transitions_since(None).items():
        np.testing.assert_array_equal(resumed.agent.transitions_since(None)[name], kept, err_msg=name)


@pytest.mark.parametrize("agent", ["nested", "hierarchical"])
def test_excursions_and_imitation_reach_the_optimum_of_a_scenario_with_parts(agent: str) -> None:
    tuned = load_preset("tuned").model_copy(update={"episodes": 250, "hidden": [16, 16]})
    trainer = finish(trainer_of([STRIPES], agent, tuned))
    assert trainer.policy_scores.tolist() == [STRIPES.optimum]


def test_an_evaluated_policy_plays_the_same_episode_again() -> None:
    trainer = finish(trainer_of([STRIPES], preset=small_preset(40)))
    (episode,) = play_greedily(GridVectorEnv([STRIPES]), [STRIPES], trainer.agent)
    last = trainer.evaluation_rows[-1]
    assert (episode.score, len(episode.actions), episode.material) == (last.score, last.steps, last.material)


def test_greedy_play_chooses_again_for_the_next_part(monkeypatch: pytest.MonkeyPatch) -> None:
    agent = Agent(AGENT_SPECS["nested"], [STRIPES], small_preset(), 0)
    assert agent.main is not None
    states: list[list[int]] = []

    def chosen(seen: Int64s, *_: object) -> Int64s:
        states.extend(seen.tolist())
        return np.array([STONE if len(states) == 1 else WOOD])

    monkeypatch.setattr(agent.main, "act", chosen)
    monkeypatch.setattr(
        agent, "act", Follows([Action.FD, Action.RD, Action.B, Action.RD, Action.L, Action.LD, Action.RD])
    )
    (episode,) = play_greedily(GridVectorEnv([STRIPES]), [STRIPES], agent)
    assert states == [[1, 1, 5], [2, 2, 3]]
    assert episode.score == STRIPES.optimum
    assert episode.materials == [STONE] * 2 + [WOOD] * 5
    assert episode.material_name(STRIPES) == "stone, then wood"


def test_a_preset_with_imagination_refuses_scenarios_with_parts() -> None:
    with pytest.raises(PresetError, match=r"^\[imagination\] knows no parts, and stripes has some: take the preset"):
        Agent(AGENT_SPECS["nested"], [DOT, STRIPES], load_preset("model-based"), 0)
