"""Gymnasium's own wrappers on the Env: films by RecordVideo, returns by RecordEpisodeStatistics; and SB3's checker."""

import warnings
from importlib import import_module
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.wrappers import RecordEpisodeStatistics, RecordVideo
from gymnasium.wrappers import vector as of_vectors

import mc_nested  # noqa: F401 - importing it registers the Env
from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.drawing import Picture
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from tests.report.films import pictures_of

ID = "mc_nested/Arena-v0"
FPS = 4
SOFTENED = 5.0
"""How far a film's picture may lie from the one drawn, of 255, on average: H.264 halves the colours' resolution."""


@pytest.fixture(autouse=True, scope="module")
def moviepy() -> None:
    """Import what writes films. Where an old pip has left it uncompiled, it warns of its own escape sequences once."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import_module("moviepy.video.io.ImageSequenceClip")


def always(_: int) -> bool:
    return True


def difference(one: Picture, other: Picture) -> float:
    return float(np.abs(one.astype(np.int64) - other).mean())


def drawn(scenario: Scenario, actions: list[Action]) -> list[Picture]:
    """Return what the Env draws after its reset and after each action."""
    env = gymnasium.make(ID, scenario=scenario, render_mode="rgb_array")
    env.reset()
    pictures = [env.render()]
    for action in actions:
        env.step(action)
        pictures.append(env.render())
    return [np.asarray(picture) for picture in pictures]


def play(env: gymnasium.Env[Any, Any], actions: list[Action]) -> dict[str, Any]:
    """Play these actions, and return the last step's info."""
    env.reset()
    info: dict[str, Any] = {}
    for action in actions:
        *_, info = env.step(action)
    return info


@pytest.mark.parametrize("name", ["diamond", pytest.param("house", marks=pytest.mark.slow)])
def test_record_video_films_every_step_of_an_episode(name: str, tmp_path: Path) -> None:
    scenario = load_scenario(name)
    actions = build(scenario)
    env = gymnasium.make(ID, scenario=name, render_mode="rgb_array")
    filmed: gymnasium.Env[Any, Any] = RecordVideo(env, str(tmp_path / "films"), episode_trigger=always)
    play(filmed, actions)
    filmed.close()
    expected = drawn(scenario, actions)
    film = pictures_of(tmp_path / "films" / "rl-video-episode-0.mp4")
    assert [seconds for _, seconds in film] == [1 / FPS] * (len(actions) + 1)
    for index, (picture, _) in enumerate(film):
        assert picture.shape == (16 * scenario.size, 16 * scenario.size, 3)
        apart = [difference(picture, own) for own in expected]
        assert apart[index] == min(apart) < SOFTENED


def test_record_video_films_only_the_chosen_episode(tmp_path: Path) -> None:
    env = gymnasium.make(ID, render_mode="rgb_array")
    filmed: gymnasium.Env[Any, Any] = RecordVideo(
        env, str(tmp_path / "films"), episode_trigger=lambda episode: episode == 1
    )
    for actions in ([Action.B], [Action.B, Action.L, Action.BD], [Action.F]):
        play(filmed, actions)
    filmed.close()
    (film,) = (tmp_path / "films").iterdir()
    assert film.name == "rl-video-episode-1.mp4"
    assert len(pictures_of(film)) == 4


def test_a_vector_of_arenas_is_filmed_side_by_side(tmp_path: Path) -> None:
    envs = gymnasium.make_vec(ID, num_envs=2, render_mode="rgb_array")
    filmed = of_vectors.RecordVideo(envs, str(tmp_path / "films"), step_trigger=lambda step: step == 0, video_length=5)
    filmed.reset()
    for _ in range(8):
        filmed.step(np.array([Action.BD, Action.F]))
    filmed.close()
    (film,) = (tmp_path / "films").iterdir()
    pictures = pictures_of(film)
    assert len(pictures) >= 5
    assert pictures[0][0].shape[1] == 2 * pictures[0][0].shape[0]


@pytest.mark.parametrize("name", ["line", "zigzag"])
def test_record_episode_statistics_reports_the_return_and_the_length(name: str) -> None:
    scenario = load_scenario(name)
    env = RecordEpisodeStatistics(gymnasium.make(ID, scenario=name))
    actions = build(scenario)
    info = play(env, actions)
    assert (info["episode"]["r"], info["episode"]["l"]) == (scenario.blocks, len(actions))
    assert info["score"] == scenario.optimum
    info = play(env, [Action.F] * scenario.step_limit)
    assert (info["episode"]["r"], info["episode"]["l"]) == (0, scenario.step_limit)
    assert list(env.return_queue) == [scenario.blocks, 0]


@pytest.mark.parametrize("mode", [None, "sync"])
def test_each_arena_of_a_vector_has_its_own_return_and_length(mode: str | None) -> None:
    scenario = load_scenario("line")
    actions = build(scenario)
    envs = of_vectors.RecordEpisodeStatistics(gymnasium.make_vec(ID, num_envs=2, vectorization_mode=mode))
    envs.reset()
    ended = []
    for step in range(2 * len(actions) + 1):  # the step between the two episodes counts for neither
        first = actions[step % (len(actions) + 1)] if step % (len(actions) + 1) < len(actions) else Action.F
        *_, info = envs.step(np.array([first, Action.F]))
        if "episode" in info:
            ended.append((info["_episode"].tolist(), info["episode"]["r"][0], info["episode"]["l"][0]))
    assert ended == [([True, False], scenario.blocks, len(actions))] * 2


@pytest.mark.slow
@pytest.mark.parametrize("render_mode", [None, "rgb_array"])
@pytest.mark.parametrize("scenario", ["line", "house"])
def test_stable_baselines3s_checker_passes_without_a_warning(scenario: str, render_mode: str | None) -> None:
    from stable_baselines3.common.env_checker import check_env

    check_env(gymnasium.make(ID, scenario=scenario, render_mode=render_mode), skip_render_check=render_mode is None)
