"""Minari itself reads the Env's transitions back."""

from dataclasses import replace
from pathlib import Path

import minari
import numpy as np
import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording.demonstrations import played_in
from mc_nested.report.minari_dataset import write_minari
from sim.grid import GridGame
from tests.live.recording.recorded_play import record_play
from tests.recordings.test_recordings import VIRTUAL

LINE = VIRTUAL / "rehearsal-window.mcap"


def test_a_dataset_is_loaded_by_its_id(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    played = played_in(LINE)
    assert write_minari(tmp_path, [played, played]) == "line-v0"
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    dataset = minari.load_dataset("line-v0")
    assert (len(dataset), dataset.total_steps) == (2, 26)
    env = ArenaEnv(GridGame(played.scenario), played.scenario)
    assert (dataset.observation_space, dataset.action_space) == (env.observation_space, env.action_space)
    for episode in dataset:
        observation, info = env.reset()
        assert (episode.observations[0] == observation).all()
        for at, action in enumerate(episode.actions):
            observation, reward, terminated, truncated, info = env.step(action)
            assert (episode.observations[at + 1] == observation).all()
            assert (episode.rewards[at], episode.terminations[at]) == (reward, terminated)
            assert episode.truncations[at] == truncated
            assert tuple(episode.infos["placed"][at + 1]) == info.get("placed", (-1, -1))
            assert episode.infos["material"][at + 1] == info["material"]
        assert (terminated, episode.infos["score"][-1]) == (True, info["score"])


def test_an_episode_that_was_left_off_ends_as_truncated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record_play(tmp_path / "play", 5, seed=1)
    write_minari(tmp_path, [played_in(tmp_path / "play")])
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    (episode,) = minari.load_dataset("diamond-v0")
    assert (episode.truncations.tolist(), episode.terminations.any()) == ([False] * 4 + [True], False)


def test_in_a_scenario_with_parts_the_material_is_beside_the_action(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record_play(tmp_path / "play", 12, seed=4, scenario_name="flag")
    played = played_in(tmp_path / "play")
    write_minari(tmp_path, [played])
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    (episode,) = minari.load_dataset("flag-v0")
    shown = played.episodes[0]
    steps = shown.steps
    assert episode.actions.tolist() == [[step.action, step.material] for step in steps]
    assert len({step.material for step in steps}) > 1
    env = ArenaEnv(GridGame(played.scenario), played.scenario)
    env.reset(options={"material": played.scenario.materials[shown.material].name})
    infos = [env.step((step.action, step.material))[4] for step in steps]
    assert episode.infos["chooses"].tolist()[1:] == [info["chooses"] for info in infos]
    assert np.allclose(episode.infos["earned"][1:], [info["earned"] for info in infos])


def test_recordings_of_different_designs_are_refused(tmp_path: Path) -> None:
    played = played_in(LINE)
    with pytest.raises(RecordingError, match="of different designs: export each by itself"):
        write_minari(tmp_path, [played, replace(played, scenario=load_scenario("diamond"))])
