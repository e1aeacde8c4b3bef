"""Write recorded play as a Minari dataset: the Env's own transitions."""

import re
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from minari.data_collector.episode_buffer import EpisodeBuffer
from minari.dataset.minari_storage import MinariStorage

from mc_nested.arena.demonstration import Demonstration, ShownGame
from mc_nested.arena.env import ArenaEnv, action_space_of, highest_observation, space_up_to, step_in
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording.demonstrations import RecordedPlay

_UNSAID = {"placed": (-1, -1), "score": np.nan, "earned": 0.0, "chooses": True}
"""What stands for a fact that a step's info doesn't have; the last two come with parts alone."""


def write_minari(folder: Path, recordings: Sequence[RecordedPlay]) -> str:
    """Write recordings into an empty folder of datasets; return the dataset's id, as "line-v0".

    Raise RecordingError if they are of different designs, OSError if the disk refuses.
    """
    scenario = recordings[0].scenario
    if any(each.scenario != scenario for each in recordings):
        raise RecordingError("these recordings are of different designs: export each by itself")
    name = f"{re.sub('[^a-zA-Z0-9]+', '-', scenario.name).strip('-') or 'design'}-v0"
    (folder / name).mkdir()
    seen, done = space_up_to(highest_observation(scenario)), action_space_of(scenario)
    storage = MinariStorage.new((folder / name / "data").absolute(), seen, done, data_format="arrow")
    about = {"dataset_id": name, "minari_version": version("minari"), "algorithm_name": "mc-nested"}
    storage.update_metadata({**about, "description": f"{scenario.name}, built in the arena of mc-nested"})
    storage.update_episodes(_buffer(scenario, each) for played in recordings for each in played.episodes)
    return name


def _buffer(scenario: Scenario, shown: Demonstration) -> EpisodeBuffer:
    """Return an episode; one that was left off ends as truncated, as Minari's own do."""
    env = ArenaEnv(ShownGame(shown, scenario.start), scenario)
    first, begun = env.reset(options={"material": scenario.materials[shown.material].name})
    actions = [step_in(scenario, step.action, step.material) for step in shown.steps]
    seen, rewards, terminations, truncations, told = zip(*map(env.step, actions), strict=True)
    infos, unsaid = [begun, *told], dict(list(_UNSAID.items())[: 4 if scenario.parts else 2])
    columns: dict[str, Any] = {name: [info.get(name, none) for info in infos] for name, none in unsaid.items()}
    return EpisodeBuffer(
        observations=[first, *seen],
        actions=actions,
        rewards=list(rewards),
        terminations=list(terminations),
        truncations=[*truncations[:-1], not terminations[-1]],
        infos={**columns, "placed": np.array(columns["placed"]), "material": [info["material"] for info in infos]},
    )
