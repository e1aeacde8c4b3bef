"""Foresight: whoever chooses asks for what it announced, over whole episodes, and announces all that can be known."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.games.episode import EpisodePlan
from mc_nested.learn.games.player import play_episode
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.learnt_game import LearntGame
from mc_nested.learn.preset import Preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridGame, GridVectorEnv
from tests.arena.made_games import TakesAtItsWord
from tests.arena.made_parts import STRIPES, scenarios_with_parts
from tests.learn.imagination.made_games import BENT, SMALL
from tests.learn.made_experiments import small_preset
from tests.learn.made_trainings import SHORT, finish

FLAG = load_scenario("flag")
KINDS = ["nested", "hierarchical", "single"]
PAPER_SMALL = small_preset()


def agent_of(kind: str, scenario: Scenario, seed: int, preset: Preset = PAPER_SMALL, runs: int = 1) -> Agent:
    return Agent(AGENT_SPECS[kind], [scenario] * runs, preset, seed)


def played_by(agent: Agent, scenario: Scenario) -> TakesAtItsWord:
    """Return the game in which the agent has played a greedy episode; it did as in the simulator."""
    game = TakesAtItsWord(scenario)
    arenas = agent.view_of(ArenaVectorEnv([ArenaEnv(game, scenario)]), [scenario])
    simulated = play_greedily(agent.view_of(GridVectorEnv([scenario]), [scenario]), [scenario], agent)
    assert play_greedily(arenas, [scenario], agent) == simulated
    assert game.following is None
    return game


@pytest.mark.parametrize("kind", ["nested", "hierarchical"])
@pytest.mark.parametrize(
    "scenario", [BENT, STRIPES, replace(STRIPES, choose_every=2), FLAG], ids=lambda each: each.name
)
@pytest.mark.parametrize("seed", range(3))
def test_every_action_of_a_greedy_episode_but_the_first_is_announced(kind: str, scenario: Scenario, seed: int) -> None:
    game = played_by(agent_of(kind, scenario, seed), scenario)
    assert game.kept == game.acts - 1 > 0


@given(scenarios_with_parts(), st.sampled_from(KINDS), st.integers(0, 99))
def test_greedy_play_asks_for_what_it_announced(scenario: Scenario, kind: str, seed: int) -> None:
    played_by(agent_of(kind, scenario, seed), scenario)


@pytest.mark.parametrize(("scenario", "steps"), [(BENT, 14), (STRIPES, 12)], ids=["bent", "stripes"])
def test_every_action_of_a_single_agent_after_its_choice_is_announced(scenario: Scenario, steps: int) -> None:
    game = played_by(agent_of("single", scenario, 22), scenario)  # of that seed it chooses first, and then builds
    assert (game.acts, game.kept) == (steps - 1, steps - 2)


def test_an_agent_that_sees_images_announces_nothing() -> None:
    preset = PAPER_SMALL.model_copy(update={"states": "image"})
    assert played_by(agent_of("nested", BENT, 0, preset), BENT).kept == 0


def plan_of(agent: Agent, seed: int, epsilon: float, tries: FirstTries | None = None, material: int = 0) -> EpisodePlan:
    random = np.random.default_rng(seed)
    online = agent.low_level.engine.online[0]
    return EpisodePlan(0, 0, material, False, online, epsilon, random.random((14, 2)), tries)


def played_plan(agent: Agent, scenario: Scenario, plan: EpisodePlan) -> tuple[TakesAtItsWord, list[int]]:
    """Return the game in which the plan was played, and the actions; they are those of a game that is told nothing."""
    game, untold = TakesAtItsWord(scenario), GridVectorEnv([scenario])
    arena = agent.view_of(ArenaVectorEnv([ArenaEnv(game, scenario)]), [scenario])
    episode = play_episode(arena, plan, agent)
    expected = play_episode(agent.view_of(untold, [scenario]), plan, agent)
    assert episode.actions.tolist() == expected.actions.tolist()
    assert game.following is None
    return game, episode.actions.tolist()


@given(st.sampled_from([BENT, STRIPES]), st.sampled_from(KINDS), st.integers(0, 99))
def test_a_plan_with_known_numbers_is_announced_as_they_draw(scenario: Scenario, kind: str, seed: int) -> None:
    agent = agent_of(kind, scenario, seed)
    game, actions = played_plan(agent, scenario, plan_of(agent, seed, 0.5, material=seed % 2))
    built = [kind != "single" or action >= 2 for action in actions]
    assert game.kept == sum(one and other for one, other in pairwise(built))


@given(st.integers(0, 99), st.booleans(), st.booleans(), st.lists(st.booleans(), min_size=8, max_size=8))
def test_a_plan_with_first_tries_is_announced_once_they_are_over(
    seed: int, explores: bool, is_stuck: bool, untried: list[bool]
) -> None:
    agent = agent_of("nested", BENT, seed)
    nothing = np.zeros(8, dtype=np.int64)
    tries = FirstTries(explores, False, is_stuck, np.array(untried), np.zeros(8, np.bool_), nothing)
    game, actions = played_plan(agent, BENT, plan_of(agent, seed, 0.5, tries))
    if not explores or not any(untried):
        assert game.kept == len(actions) - 1


def trained(preset: Preset, kind: str, scenario: Scenario, games: list[GridGame]) -> Trainer:
    scenarios, agent = [scenario] * len(games), agent_of(kind, scenario, 0, preset, len(games))
    arenas = ArenaVectorEnv([ArenaEnv(game, scenario) for game in games])
    return finish(Trainer(agent.view_of(arenas, scenarios), scenarios, agent, preset, 0))


def told_and_untold(preset: Preset, kind: str, scenario: Scenario) -> tuple[list[TakesAtItsWord], Trainer]:
    """Return the games of two runs, and their trainer; it has learnt to the bit what it learns in the simulator."""
    games = [TakesAtItsWord(scenario), TakesAtItsWord(scenario)]
    trainer = trained(preset, kind, scenario, [*games])
    agent, scenarios = agent_of(kind, scenario, 0, preset, 2), [scenario] * 2
    untold = Trainer(agent.view_of(GridVectorEnv(scenarios), scenarios), scenarios, agent, preset, 0)
    finish(untold)
    assert trainer.episode_rows == untold.episode_rows
    assert trainer.evaluation_rows == untold.evaluation_rows
    return games, trainer


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("scenario", [BENT, STRIPES], ids=lambda each: each.name)
def test_a_training_announces_its_evaluations_alone_where_each_step_is_learnt_from(
    kind: str, scenario: Scenario
) -> None:
    games, trainer = told_and_untold(SHORT, kind, scenario)
    evaluations = [row for row in trainer.evaluation_rows if row.steps > 1]
    most = sum(row.steps - 1 for row in evaluations)
    kept = sum(game.kept for game in games)
    assert kept == most if kind != "single" else kept <= most
    assert most < sum(game.acts for game in games)


@pytest.mark.parametrize("kind", ["nested", "hierarchical"])
def test_a_training_that_learns_between_episodes_announces_what_follows_its_first_tries(kind: str) -> None:
    games, trainer = told_and_untold(SMALL, kind, BENT)
    for game in games:
        assert game.acts / 2 < game.kept <= game.acts - game.episodes
    evaluated = sum(row.steps - 1 for row in trainer.evaluation_rows)
    assert sum(game.kept for game in games) > evaluated


def test_a_run_whose_learnt_game_does_not_hold_announces_nothing() -> None:
    trainer = trained(SMALL, "nested", BENT, [GridGame(BENT)])
    practice = trainer.practice
    assert isinstance(practice, LearntGame)
    assert practice.is_settled(0)
    practice._broken[0] = 1  # its excursions choose now
    assert not practice.is_settled(0)
