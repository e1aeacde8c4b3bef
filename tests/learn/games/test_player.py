"""A game plays what was planned: with the plan's network alone, without torch, and only whole episodes."""

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.games.episode import PlayedEpisode
from mc_nested.learn.games.player import play_episode
from mc_nested.learn.preset import load_preset
from sim.grid import GridVectorEnv
from tests.learn.games.lockstep import game_of, learner_of
from tests.learn.imagination.made_games import BENT, SMALL
from tests.learn.made_trainings import StartsOver

PAPER = load_preset("paper")


def assert_equal(one: PlayedEpisode, other: PlayedEpisode) -> None:
    assert (one.number, one.terminated, one.score) == (other.number, other.terminated, other.score)
    for name in ("observations", "actions", "rewards"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


@pytest.mark.parametrize("agent", ["nested", "hierarchical", "single"])
def test_a_game_plays_a_greedy_plan_as_the_learners_networks_do(agent: str) -> None:
    learner = learner_of(BENT, PAPER, agent=agent, seed=3)
    learner.begin_from(learner.agent.online())
    plan = learner.plan("game")
    assert plan.greedy
    played = game_of(BENT, PAPER, agent)(plan)
    view = learner.agent.view_of(GridVectorEnv([BENT]), [BENT])
    expected = play_greedily(view, [BENT], learner.agent)[0]
    assert played.actions.tolist() == expected.actions
    assert played.score == expected.score
    assert played.steps == len(played.rewards) == len(played.observations) - 1


def test_playing_a_plan_twice_gives_the_same_episode_and_leaves_the_plan_unchanged() -> None:
    plan = learner_of(BENT, SMALL).plan("game")
    before, play = pickle.dumps(plan), game_of(BENT, SMALL)
    assert_equal(play(plan), play(pickle.loads(before)))  # noqa: S301 - our own
    assert pickle.dumps(plan) == before


def test_the_plans_random_numbers_choose_every_action_at_an_epsilon_of_1() -> None:
    plan = learner_of(BENT, PAPER).plan("game")
    assert (plan.epsilon, plan.numbers.shape) == (1.0, (BENT.step_limit, 2))
    played = game_of(BENT, PAPER)(plan)
    assert played.actions.tolist() == [int(8 * number) for number in plan.numbers[: played.steps, 1]]


def test_a_game_tries_each_action_in_turn_within_its_first_episode() -> None:
    played = game_of(BENT, SMALL)(learner_of(BENT, SMALL).plan("game"))
    assert played.actions[: len(Action)].tolist() == sorted(Action)[: played.steps]


def test_play_episode_passes_on_an_error_of_the_game() -> None:
    game = StartsOver(BENT)
    game.acts_left = 3
    arena = ArenaVectorEnv([ArenaEnv(game, BENT)])
    agent = Agent(AGENT_SPECS["nested"], [BENT], SMALL, 0)
    with pytest.raises(ConnectionError):
        play_episode(arena, learner_of(BENT, SMALL).plan("game"), agent)


GAME = """
import pickle, sys
from pathlib import Path
sys.modules["torch"] = None
plan = pickle.loads(Path(sys.argv[1]).read_bytes())
assert not any(name.startswith(("numba", "mc_nested.learn.dqn")) for name in sys.modules), "plain data"
from tests.learn.games.lockstep import game_of
from tests.learn.imagination.made_games import BENT, SMALL
Path(sys.argv[2]).write_bytes(pickle.dumps(game_of(BENT, SMALL)(plan)))
"""


@pytest.mark.slow
def test_a_process_without_torch_plays_a_pickled_plan(tmp_path: Path) -> None:
    plan = learner_of(BENT, SMALL).plan("game")
    sent, back = tmp_path / "plan", tmp_path / "episode"
    sent.write_bytes(pickle.dumps(plan))
    subprocess.run([sys.executable, "-c", GAME, sent, back], check=True)
    assert_equal(pickle.loads(back.read_bytes()), game_of(BENT, SMALL)(plan))  # noqa: S301 - our own
