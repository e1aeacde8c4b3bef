"""The single-file DQN: it runs as it is, it learns, and the step that begins an episode is no transition."""

import re
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
import torch
from gymnasium.vector import VectorEnv, VectorWrapper
from gymnasium.wrappers.vector import RecordEpisodeStatistics

from mc_nested.arena.action import Action
from scripts.examples.cleanrl_dqn import QNetwork, greedy_score, main, train
from tests.scripts.examples.running import MISTAKES, PAIR, pair_in, run

RETURNED = re.compile(r"step (\d+): return (\d+), length (\d+)")
PROGRESS = re.compile(r"\d+ of \d+ steps, \d+ a second, ε \d\.\d\d, mean return \d+\.\d\d")


class PaysForBeginning(VectorWrapper[Any, Any, Any, Any, Any]):
    """Arenas that pay a fortune at the step that begins an episode: a network that learns from that step shows it."""

    def __init__(self, env: VectorEnv[Any, Any, Any]) -> None:
        super().__init__(env)
        self._ended = np.zeros(env.num_envs, dtype=np.bool_)
        self.paid = 0

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        observations, rewards, terminated, truncated, info = self.env.step(actions)
        rewards = np.where(self._ended, 1e6, rewards)
        self.paid += int(self._ended.sum())
        self._ended = terminated | truncated
        return observations, rewards, terminated, truncated, info


def arenas() -> VectorEnv[Any, Any, Any]:
    return gymnasium.make_vec("mc_nested/Arena-v0", num_envs=4, scenario=PAIR)


@pytest.mark.slow
def test_the_step_that_begins_an_episode_is_never_learnt_from() -> None:
    paying = PaysForBeginning(arenas())
    q = train(RecordEpisodeStatistics(paying), steps=2000, seed=1)
    assert paying.paid > 50
    values = q(torch.tensor([[x, y, 1] for x in range(5) for y in range(5)])).detach()
    assert float(values.abs().max()) < 10


def test_greedy_score_is_that_of_the_first_arena() -> None:
    class Builder(QNetwork):
        """Steps back once, then steps back and places: PAIR. The other arenas bump against the edge."""

        def greedy(self, observations: Any) -> Any:
            chosen = np.full(len(observations), Action.F)
            chosen[0] = Action.B if observations[0, 1] == PAIR.start[1] else Action.BD
            return chosen

    envs = RecordEpisodeStatistics(arenas())
    assert greedy_score(envs, Builder(np.array([4, 4, 2]), 8)) == PAIR.optimum


def test_the_networks_input_is_one_hot_in_each_part() -> None:
    q = QNetwork(np.array([4, 4, 2]), 8)
    seen: list[torch.Tensor] = []
    q.layers.register_forward_pre_hook(lambda _, inputs: seen.append(inputs[0]))
    q.greedy(np.array([[4, 0, 2]]))
    assert seen[0].tolist() == [[0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1]]


@pytest.mark.slow
def test_a_few_hundred_steps_print_every_return_and_end_with_a_greedy_episode(tmp_path: Path) -> None:
    words = ["--scenario", "line", "--steps", "800", "--seed", "3"]
    done = run("cleanrl_dqn", tmp_path, *words)
    assert (done.returncode, done.stderr) == (0, "")
    *lines, last = done.stdout.splitlines()
    assert re.fullmatch(r"greedy: score -?\d+", last)
    episodes = [tuple(map(int, found.groups())) for line in lines if (found := RETURNED.fullmatch(line))]
    assert len(episodes) >= 4 * (200 // 61)  # the longest take 60 steps, and one to begin the next
    assert all(0 <= returned <= 11 <= length <= 60 for _, returned, length in episodes)
    assert all(RETURNED.fullmatch(line) or PROGRESS.fullmatch(line) for line in lines)
    assert sum(length for *_, length in episodes) <= 800
    again = run("cleanrl_dqn", tmp_path, *words).stdout
    assert RETURNED.findall(again) == RETURNED.findall(done.stdout)


@pytest.mark.slow
def test_the_example_learns_two_blocks_within_seconds(tmp_path: Path) -> None:
    done = run("cleanrl_dqn", tmp_path, "--scenario", pair_in(tmp_path), "--steps", "6000")
    assert done.stdout.splitlines()[-1] == f"greedy: score {PAIR.optimum:g}"


@pytest.mark.slow
@MISTAKES
def test_mistake_is_refused_in_one_line_with_exit_code_2(words: list[str], says: str, tmp_path: Path) -> None:
    done = run("cleanrl_dqn", tmp_path, *words)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("cleanrl_dqn: ")
    assert says in done.stderr
    assert done.stderr.count("\n") == 1


def test_unknown_scenario_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--scenario", "castle"]) == 2
    assert "no scenario 'castle'" in capsys.readouterr().err
