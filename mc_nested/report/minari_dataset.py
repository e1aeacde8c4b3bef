"""Write recorded play as a Minari dataset: the Env's own transitions. The extra ``share`` has the packages."""

import re
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from minari.data_collector.episode_buffer import EpisodeBuffer
from minari.dataset.minari_storage import MinariStorage

from mc_nested.arena.env import action_space_of, highest_observation, space_up_to, step_in
from mc_nested.errors import RecordingError
from mc_nested.live.recording.frames import Episode, Played

NOWHERE = (-1, -1)
"""Where a block landed, if none did."""


def write_minari(folder: Path, recordings: Sequence[Played]) -> str:
    """Write recordings into an empty folder of datasets; return the dataset's id, as "line-v0".

    Raise RecordingError if they are of different designs, OSError if the disk refuses.
    """
    episodes = [episode for played in recordings for episode in played.episodes]
    scenario = episodes[0].scenario
    if any(each.scenario != scenario for each in episodes):
        raise RecordingError("these recordings are of different designs: export each by itself")
    name = re.sub(r"[^a-zA-Z0-9]+", "-", scenario.name).strip("-") or "design"
    data = folder / f"{name}-v0" / "data"
    data.mkdir(parents=True)
    spaces = {
        "observation_space": space_up_to(highest_observation(scenario)),
        "action_space": action_space_of(scenario),
    }
    storage = MinariStorage.new(data, data_format="arrow", **spaces)
    about = {"dataset_id": f"{name}-v0", "minari_version": version("minari"), "algorithm_name": "mc-nested"}
    storage.update_metadata({**about, "description": f"{scenario.name}, built in mc-nested's arena."})
    storage.update_episodes(map(_buffer, range(len(episodes)), episodes))
    return f"{name}-v0"


def _buffer(index: int, episode: Episode) -> EpisodeBuffer:
    """Return an episode; one that was left off ends as truncated, as Minari's own do."""
    steps = episode.steps
    infos = [episode.info, *(step.info for step in steps)]
    told: dict[str, Any] = {
        "material": [info["material"] for info in infos],
        "placed": np.array([info.get("placed", NOWHERE) for info in infos]),
        "score": [float(info.get("score", np.nan)) for info in infos],
    }
    if episode.scenario.parts:
        told["earned"] = [float(info.get("earned", 0)) for info in infos]
        told["chooses"] = [bool(info.get("chooses", True)) for info in infos]
    terminations = [step.terminated for step in steps]
    return EpisodeBuffer(
        id=index,
        observations=[episode.observation, *(step.observation for step in steps)],
        actions=[step_in(episode.scenario, step.action, step.material) for step in steps],
        rewards=[step.reward for step in steps],
        terminations=terminations,
        truncations=[*(step.truncated for step in steps[:-1]), not terminations[-1]],
        infos=told,
    )
