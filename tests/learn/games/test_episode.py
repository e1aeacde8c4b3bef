"""Episodes of games: each game has one out, until it comes back, is left or is superseded.

A game plays what was planned: with the plan's network alone, without torch, and only whole episodes.
"""

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
from mc_nested.learn.games.episode import EpisodeOut, EpisodePlan, EpisodesOut, PlayedEpisode, play_episode
from mc_nested.learn.preset import load_preset
from sim.grid import GridVectorEnv
from tests.learn.games.lockstep import game_of, learner_of
from tests.learn.imagination.made_games import BENT, SMALL
from tests.learn.made_trainings import StartsOver


def an_episode(number: int, *, greedy: bool = False, probes: frozenset[tuple[int, int]] = frozenset()) -> EpisodeOut:
    """Return the episode of that number, played by the game of that number, planned after ten times as many."""
    plan = EpisodePlan(number, 0, number % 2, greedy, np.zeros(1, np.float32), 0.0, np.zeros((0, 2)), None)
    return EpisodeOut(plan, f"game {number}", 10 * number, (0.0, 0.0), probes, {})


def out_of(*episodes: EpisodeOut) -> EpisodesOut:
    out = EpisodesOut()
    for episode in episodes:
        out.add(episode)
    return out


def test_an_episode_can_be_removed_only_once() -> None:
    episode = an_episode(3)
    out = out_of(episode)
    assert out.remove(3) is episode
    assert out.remove(3) is None
    assert len(out) == 0


def test_a_leaving_game_removes_its_own_episode_alone() -> None:
    out = out_of(an_episode(3), an_episode(4))
    out.leave("game 3")
    assert out.remove(3) is None
    assert out.remove(4) is not None


def test_probes_and_materials_of_all_episodes_out_are_combined() -> None:
    out = out_of(an_episode(3, probes=frozenset({(1, 1)})), an_episode(4, probes=frozenset({(1, 1), (2, 1)})))
    assert out.probes == {(1, 1), (2, 1)}
    assert out.materials == {0, 1}
    assert (EpisodesOut().probes, EpisodesOut().materials) == (frozenset(), frozenset())


def test_superseding_removes_older_evaluations_and_keeps_training_episodes() -> None:
    out = out_of(an_episode(1, greedy=True), an_episode(2), an_episode(3, greedy=True))
    assert out.newest_evaluation == 30
    out.supersede(30)
    assert out.remove(1) is None
    assert out.remove(2) is not None
    assert out.newest_evaluation == 30
    out.keep_evaluations()
    assert len(out) == 1
    out.clear()
    assert out.newest_evaluation == -1


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
from tests.learn.made_trainings import StartsOver
Path(sys.argv[2]).write_bytes(pickle.dumps(game_of(BENT, SMALL)(plan)))
"""


@pytest.mark.slow
def test_a_process_without_torch_plays_a_pickled_plan(tmp_path: Path) -> None:
    plan = learner_of(BENT, SMALL).plan("game")
    sent, back = tmp_path / "plan", tmp_path / "episode"
    sent.write_bytes(pickle.dumps(plan))
    subprocess.run([sys.executable, "-c", GAME, sent, back], check=True)
    assert_equal(pickle.loads(back.read_bytes()), game_of(BENT, SMALL)(plan))  # noqa: S301 - our own
