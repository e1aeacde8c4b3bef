"""What a training leaves behind: config.toml, episodes.csv, evaluations.csv, summary.json and checkpoint/."""

import csv
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

import tomlkit
import torch
from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import ScenarioTable, scenario_of
from mc_nested.errors import RunError, ScenarioError
from mc_nested.learn.checkpoint import read_checkpoint, write_checkpoint
from mc_nested.learn.preset import Preset
from mc_nested.learn.trainer import EpisodeRow, EvaluationRow, Trainer
from mc_nested.toml_file import parse_toml, read_toml_text


class RunConfig(BaseModel):
    """Everything needed to repeat a training: the scenario and the preset whole, so no other file has to be found."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    agent: Literal["nested"]
    backend: Literal["sim", "live"]
    profile: str | None = None
    trials: Annotated[int, Field(ge=1)]
    seed: Annotated[int, Field(ge=0)]
    stop_at_optimum: bool
    preset_name: str
    preset: Preset
    scenario: ScenarioTable

    def identity(self) -> dict[str, Any]:
        """What a checkpoint of this run belongs to: all but the profile, which may be moved or renamed."""
        return self.model_dump(exclude={"profile"})


class RunFolder:
    """The folder of one training.

    Args:
        path: where it lies.
        config: what is trained there.
    """

    def __init__(self, path: Path, config: RunConfig) -> None:
        self.path = path
        self.config = config
        self.scenario: Scenario = scenario_of(config.scenario, str(path / "config.toml"))

    @classmethod
    def new(cls, path: Path, config: RunConfig) -> "RunFolder":
        """A folder to begin a training in; RunError where the path holds anything already. Nothing is written yet."""
        if path.exists() and (not path.is_dir() or any(path.iterdir())):
            raise RunError(f"{path}: exists and is not empty: name a new folder, nothing was overwritten")
        return cls(path, config)

    @classmethod
    def open(cls, path: Path) -> "RunFolder":
        """The folder of an earlier training; RunError where it isn't one."""
        if not (path / "config.toml").is_file():
            raise RunError(f"{path}: no config.toml there: name the folder of a training (its --out)")
        text = read_toml_text(path / "config.toml", RunError)
        try:
            return cls(path, parse_toml(RunConfig, text, str(path / "config.toml"), RunError))
        except ScenarioError as error:
            raise RunError(str(error)) from error

    @property
    def scenarios(self) -> list[Scenario]:
        """Each trial's scenario."""
        return [self.scenario] * self.config.trials

    def begin(self) -> None:
        """Make the folder and write config.toml; RunError where the disk refuses."""
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            text = tomlkit.dumps(self.config.model_dump(exclude_none=True))
            (self.path / "config.toml").write_text(text, encoding="utf-8")
        except OSError as error:
            raise RunError(f"{self.path}: can't be written, {error.strerror}: name another folder") from error

    def save(self, trainer: Trainer, wall_s: float) -> None:
        """Write the checkpoint and the tables as they stand now; RunError where the disk refuses."""
        state = {**trainer.state(), "wall_s": torch.tensor(wall_s, dtype=torch.float64)}
        try:
            write_checkpoint(self.path / "checkpoint", state, self.config.identity())
            _write_table(self.path / "episodes.csv", EpisodeRow._fields, trainer.episode_rows)
            _write_table(self.path / "evaluations.csv", EvaluationRow._fields, trainer.evaluation_rows)
        except (OSError, RuntimeError) as error:
            raise RunError(
                f"{self.path}: can't be written ({error}): make room, then mc-nested train --resume {self.path} "
                f"goes on from the last checkpoint"
            ) from error

    def load(self) -> dict[str, torch.Tensor]:
        """The last checkpoint's tensors by name; RunError where there is none that fits."""
        return read_checkpoint(self.path / "checkpoint", self.config.identity())

    def write_summary(self, trainer: Trainer, wall_s: float) -> dict[str, Any]:
        """Write and return what the training came to."""
        summary = summarise(self.config, self.scenario, trainer, wall_s)
        (self.path / "summary.json").write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
        return summary


def summarise(config: RunConfig, scenario: Scenario, trainer: Trainer, wall_s: float) -> dict[str, Any]:
    """What a training came to, for summary.json; scores are r_M, one a trial, of the policy that the run keeps."""
    evaluations = [[row for row in trainer.evaluation_rows if row.trial == trial] for trial in range(config.trials)]
    return {
        "scenario": scenario.name,
        "agent": config.agent,
        "preset": config.preset_name,
        "backend": config.backend,
        "trials": config.trials,
        "seed": config.seed,
        "episodes": config.preset.episodes,
        "optimum": scenario.optimum,
        "final_scores": [rows[-1].score if rows else None for rows in evaluations],
        "episodes_to_optimum": [
            next((row.episode for row in rows if row.score >= scenario.optimum), None) for rows in evaluations
        ],
        "episodes_done": [int(done) for done in trainer.episodes_done],
        "env_steps": trainer.env_steps,
        "evaluation_steps": trainer.evaluation_steps,
        "updates": trainer.agent.updates,
        "wall_s": round(wall_s, 3),
        "networks": trainer.agent.networks,
        "parameters": trainer.agent.parameters,
    }


def _write_table(path: Path, header: Sequence[str], rows: Sequence[EpisodeRow | EvaluationRow]) -> None:
    unfinished = path.with_suffix(".csv.unfinished")
    with unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
    unfinished.replace(path)
