"""A training's folder: config.toml, episodes.csv, evaluations.csv, summary.json and checkpoint/."""

import shutil
from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import ScenarioTable, scenario_of
from mc_nested.arrays import Arrays
from mc_nested.errors import RunError, ScenarioError
from mc_nested.learn.agents import AGENT_SPECS, Agent, AgentName
from mc_nested.learn.imagination.imagination import learnt_game
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.checkpoint import Checkpoint
from mc_nested.learn.runs.folder_kind import FORMAT, check_free
from mc_nested.learn.runs.run_files import begin_folder, read_config, wall_s_so_far, write_results, writing_in
from mc_nested.learn.state_dict import part_of
from mc_nested.learn.training import Training


class RunConfig(BaseModel):
    """Everything needed to repeat a training; scenario and preset are complete, no other file is needed."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    format: int = FORMAT
    agent: AgentName
    backend: Literal["sim", "virtual", "live"]
    profile: str | None = None
    trials: Annotated[int, Field(ge=1)]
    seed: Annotated[int, Field(ge=0)]
    stop_at_optimum: bool
    preset_name: str
    preset: Preset
    scenario: ScenarioTable

    def identity(self) -> dict[str, Any]:
        """What is trained: a checkpoint fits only the same.

        Without the profile, which may be moved or renamed, and the device.
        """
        return self.model_dump(exclude={"format": True, "profile": True, "preset": {"device"}})

    def on_device(self, device: str) -> "RunConfig":
        """The same training, computed elsewhere; PresetError if its engine can't."""
        return self.model_copy(update={"preset": self.preset.changed(device=device)})


class RunFolder:
    """The folder of one training.

    Args:
        path: its path.
        config: what is trained there.
    """

    def __init__(self, path: Path, config: RunConfig) -> None:
        self.path = path
        self.config = config
        self.scenario: Scenario = scenario_of(config.scenario, str(path / "config.toml"))
        self.checkpoint = Checkpoint(path / "checkpoint", config.identity())

    @classmethod
    def new(cls, path: Path, config: RunConfig) -> "RunFolder":
        """A folder for a new training; RunError if the path holds anything already. Nothing is written yet."""
        check_free(path)
        return cls(path, config)

    @classmethod
    def open(cls, path: Path) -> "RunFolder":
        """The folder of an earlier training; RunError if it isn't one."""
        config = read_config(path, RunConfig, "train", "training")
        try:
            return cls(path, config)
        except ScenarioError as error:
            raise RunError(str(error)) from error

    def new_agent(self, runs: int, device: str = "cpu") -> Agent:
        """An untrained agent as this training's, with that many runs, on the processor or another device."""
        preset = self.config.preset.model_copy(update={"device": device})
        return Agent(AGENT_SPECS[self.config.agent], [self.scenario] * runs, preset, self.config.seed)

    @property
    def scenarios(self) -> list[Scenario]:
        """Each trial's scenario."""
        return [self.scenario] * self.config.trials

    def save_before_all(self, trainer: Training) -> None:
        """Save what a training begins with, before config.toml is written; RunError, and nothing is left.

        So a training that is killed here can't be resumed without its start.
        """
        try:
            self.checkpoint.save(trainer, finished=trainer.finished)
        except OSError as error:
            shutil.rmtree(self.path / "checkpoint", ignore_errors=True)
            raise RunError(f"{self.path}: can't be written ({error}): make room and begin again") from error

    def begin(self) -> None:
        """Make the folder and write config.toml; RunError if the disk refuses."""
        begin_folder(self.path, self.config)

    def writing(self) -> AbstractContextManager[None]:
        """Around writing here: RunError, one line that says how to resume, if the disk refuses."""
        return writing_in(self.path, "train")

    def save(self, trainer: Training, wall_s: float, beside: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Write the checkpoint, the tables and the summary as they are now, and return the summary.

        ``beside`` is added to the summary. RunError if the disk refuses. The same training writes the same bytes,
        except for ``beside`` and the summary's ``wall_s``.
        """
        summary = {**summarise(self.config, self.scenario, trainer, wall_s), **(beside or {})}
        with self.writing():
            self.checkpoint.save(trainer, finished=trainer.finished)
            write_results(self.path, trainer.episode_rows, trainer.evaluation_rows, summary)
        return summary

    def kept(self) -> Arrays:
        """The networks of the policies that the trials keep, by role, and their ``scores``, as last saved.

        RunError if nothing was saved yet, or it is damaged, of other shapes or another training's.
        """
        if self.only_begun:
            raise RunError(f"{self.path}: nothing is trained yet: go on with mc-nested train --resume {self.path}")
        kept = part_of(self.checkpoint.state(), "kept")
        if misfit := _misfit_of(kept, self._shapes_kept()):
            raise RunError(f"{self.checkpoint.file}: {misfit}: bring back a whole copy, or train the run again")
        return kept

    def learnt_game(self, trial: int) -> Arrays | None:
        """What that trial has learnt of its game, for ``Imagination.begin_from``; None if its preset imagines nothing.

        RunError as for ``Checkpoint.state``.
        """
        if self.config.preset.imagination is None:
            return None
        imagination = part_of(self.checkpoint.state(), "imagination")
        try:
            return learnt_game(imagination, trial)
        except (KeyError, IndexError) as error:
            raise RunError(
                f"{self.checkpoint.file}: holds no learnt game of trial {trial}: bring back a whole copy, or train the "
                f"run again"
            ) from error

    def _shapes_kept(self) -> dict[str, tuple[int, ...]]:
        trials = self.config.trials
        alone = self.new_agent(1).online()
        networks = {role: (len(online) * trials, online.shape[1]) for role, online in alone.items()}
        return {**networks, "scores": (trials,)}

    @property
    def has_begun(self) -> bool:
        """Whether there is a config.toml, so that it can be resumed."""
        return (self.path / "config.toml").is_file()

    @property
    def only_begun(self) -> bool:
        """Whether nothing was ever saved here: the training was killed before its first checkpoint."""
        return not self.checkpoint.exists and not (self.path / "episodes.csv").exists()

    def wall_s_so_far(self) -> float:
        """Seconds that the training took until its last save; 0 if the summary doesn't say."""
        return wall_s_so_far(self.path)


def summarise(config: RunConfig, scenario: Scenario, trainer: Training, wall_s: float) -> dict[str, Any]:
    """The results of a training so far, for summary.json; scores are r_M, one per trial, of the policy it keeps.

    An unfinished trial has no final score: it has learned since its last greedy evaluation. ``played_to_optimum``
    includes the greedy episodes: in a live game they take as long as any other.
    """
    evaluations = [[row for row in trainer.evaluation_rows if row.trial == trial] for trial in range(config.trials)]
    firsts = [next((row.episode for row in rows if row.score >= scenario.optimum), None) for rows in evaluations]
    return {
        "scenario": scenario.name,
        "agent": config.agent,
        "preset": config.preset_name,
        "backend": config.backend,
        "trials": config.trials,
        "seed": config.seed,
        "episodes": config.preset.episodes,
        "optimum": scenario.optimum,
        "final_scores": [
            float(score) if finished else None
            for score, finished in zip(trainer.kept_scores, trainer.runs_finished, strict=True)
        ],
        "episodes_to_optimum": firsts,
        "played_to_optimum": [_played_until(trainer, trial, first) for trial, first in enumerate(firsts)],
        "episodes_done": [int(done) for done in trainer.episodes_done],
        "env_steps": trainer.env_steps,
        "evaluation_steps": trainer.evaluation_steps,
        "updates": trainer.agent.updates,
        "wall_s": round(wall_s, 3),
        "networks": trainer.agent.networks,
        "parameters": trainer.agent.parameters,
    }


def _played_until(trainer: Training, trial: int, episode: int | None) -> dict[str, int] | None:
    if episode is None:
        return None
    played = [row for row in trainer.episode_rows if row.trial == trial and row.episode <= episode]
    greedy = [row for row in trainer.evaluation_rows if row.trial == trial and row.episode <= episode]
    steps = sum(row.steps for row in played) + sum(row.steps for row in greedy)
    return {"episodes": len(played) + len(greedy), "steps": steps}


def _misfit_of(kept: Arrays, shapes: Mapping[str, tuple[int, ...]]) -> str | None:
    """What keeps these arrays from being policies of these shapes, by name, and their ``scores``; None if they fit."""
    for name, shape in shapes.items():
        if name not in kept:
            return f"has no array {name}"
        array = kept[name]
        if array.shape != shape:
            return f"its array {name} is {array.shape}, it should be {shape}"
        # A policy that was never played has the score -inf.
        if array.dtype.kind != "f" or not (np.isfinite(array) | (name == "scores") & np.isneginf(array)).all():
            return f"its array {name} holds what is no number"
    return None
