"""A training's folder: config.toml, episodes.csv, evaluations.csv, summary.json and checkpoint/."""

import csv
import shutil
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np
import tomlkit

from mc_nested.arena.cooperative.team import Team
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import scenario_of
from mc_nested.arrays import Arrays, part_of
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import RunError, ScenarioError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.imagination.imagination import learnt_game
from mc_nested.learn.learnt_game import given_facts_of
from mc_nested.learn.objectives.weights import shipped_weights
from mc_nested.learn.runs.checkpoint import Checkpoint, sealed, unsealed
from mc_nested.learn.runs.folder_kind import check_config, check_free
from mc_nested.learn.runs.folder_lock import holder_of
from mc_nested.learn.runs.run_config import RunConfig
from mc_nested.learn.training import Training
from mc_nested.learn.unknown_design import UnknownDesigns
from mc_nested.toml_file import parse_toml, read_toml_text

CONFIG, SUMMARY = "config.toml", "summary.json"


class RunFolder:
    """The folder of one training.

    Args:
        path: its path.
        config: what is trained there.

    Raises:
        ScenarioError: the scenario can't be built, or not by these builders.
    """

    def __init__(self, path: Path, config: RunConfig) -> None:
        self.path = path
        self.config = config
        self.scenario: Scenario = scenario_of(config.scenario, str(path / CONFIG))
        self.team = Team(self.scenario, config.team.builders.starts) if config.team else None
        self.checkpoint = Checkpoint(path / "checkpoint", config.identity())

    @classmethod
    def new(cls, path: Path, config: RunConfig) -> "RunFolder":
        """Return a folder for a new training; RunError if the path holds anything already. Nothing is written yet."""
        check_free(path)
        return cls(path, config)

    @classmethod
    def open(cls, path: Path) -> "RunFolder":
        """Return the folder of an earlier training; RunError if it isn't one."""
        if not (path / CONFIG).is_file():
            raise RunError(f"{path}: no config.toml there: name the folder of a training (its --out)")
        text = read_toml_text(path / CONFIG, RunError)
        check_config(text, path, "train")
        config = parse_toml(RunConfig, text, str(path / CONFIG), RunError)
        try:
            return cls(path, config)
        except ScenarioError as error:
            raise RunError(str(error)) from error

    def new_agent(self, runs: int, device: str = "cpu") -> Agent:
        """Return an untrained agent as this training's, with that many runs, on the processor or another device."""
        config = self.config
        if config.design_unknown:
            return UnknownDesigns(shipped_weights(), given_facts_of([self.scenario] * runs))
        preset = config.preset.model_copy(update={"device": device})
        builders = config.team.builders if config.team else None
        return Agent(AGENT_SPECS[config.agent], [self.scenario] * runs, preset, config.seed, team=builders)

    def trained_agent(self) -> Agent:
        """Return the agent of the last checkpoint, every trial, able to act."""
        agent = self.new_agent(self.config.trials)
        agent.load_online(self.policies())
        return agent

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
        with refused_as(RunError, self.path, "name another folder, or make room"):
            self.path.mkdir(parents=True, exist_ok=True)
            _write_text(self.path / CONFIG, tomlkit.dumps(self.config.model_dump(exclude_none=True)))

    def writing(self) -> AbstractContextManager[None]:
        """Turn a disk error in the block into a RunError, one line that says how to resume."""
        then = f"make room, then mc-nested train --resume {self.path} goes on from the last checkpoint"
        return refused_as(RunError, self.path, then)

    def save(self, trainer: Training, wall_s: float, beside: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Write the checkpoint, the tables and the summary as they are now, and return the summary.

        ``beside`` is added to the summary. RunError if the disk refuses. The same training writes the same bytes,
        except for ``beside`` and the summary's ``wall_s`` and checksum.
        """
        summary = {**summarise(self.config, self.scenario, trainer, wall_s), **(beside or {})}
        with self.writing():
            self.checkpoint.save(trainer, finished=trainer.finished)
            _write_table(self.path / "episodes.csv", EpisodeRow._fields, trainer.episode_rows)
            _write_table(self.path / "evaluations.csv", EvaluationRow._fields, trainer.evaluation_rows)
            _write_text(self.path / SUMMARY, sealed(summary))
        return summary

    def policies(self) -> Arrays:
        """Return the networks of the policies that the trials keep, by role, and their ``scores``, as last saved.

        RunError if nothing was saved yet, or it is damaged, of other shapes or another training's.
        """
        if self.only_begun:
            if holder := holder_of(self.path):
                raise RunError(f"{self.path}: {holder} is training it, and has saved nothing yet: wait for a minute")
            raise RunError(f"{self.path}: nothing is trained yet: go on with mc-nested train --resume {self.path}")
        kept = part_of(self.checkpoint.state(), "policies")
        if {name: array.shape for name, array in kept.items()} != self._shapes_kept():
            raise RunError(
                f"{self.checkpoint.file}: holds networks of another shape than its preset's: put back the network that "
                f"it was trained with, or train the run again"
            )
        return kept

    def how_far(self) -> tuple[int, int, list[float | None]]:
        """Return how many training episodes all trials have done, in how many of them a person acted, and each score.

        A trial's is None before its end.

        RunError as for ``policies``.
        """
        scores, runs = self.policies()["scores"], part_of(self.checkpoint.state(), "runs")
        ends = zip(scores.tolist(), runs["finished"], strict=True)
        counts = int(runs["episodes"].sum()), int(np.sum(runs.get("demonstrated", 0)))  # none by a version before
        return *counts, [score if finished else None for score, finished in ends]

    def policy_of(self, trial: int) -> Arrays:
        """Return the networks of one trial's policy, by role, for ``Agent.load_online``.

        Raise RunError as for ``policies``.
        """
        policies, rows = self.policies(), self.new_agent(self.config.trials).rows_of(trial)
        return {role: networks[rows[role]] for role, networks in policies.items() if role in rows}

    def learnt_game(self, trial: int) -> Arrays | None:
        """Return what that trial has learnt of its game, for ``Imagination.begin_from``.

        It is None if its preset imagines nothing. RunError as for ``Checkpoint.state``.
        """
        if self.config.preset.imagination is None:
            return None
        imagination = part_of(self.checkpoint.state(), "practice")
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
        return (self.path / CONFIG).is_file()

    @property
    def only_begun(self) -> bool:
        """Whether nothing was ever saved here: the training was killed before its first checkpoint."""
        saved = (self.checkpoint.file, self.checkpoint.weights, self.path / "episodes.csv")
        return not any(file.exists() for file in saved)

    def wall_s_so_far(self) -> float:
        """Return seconds that the training took until its last save, 0 before; RunError if they can't be read."""
        file = self.path / SUMMARY
        try:
            return float(unsealed(file)["wall_s"]) if file.exists() else 0.0
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise RunError(f"{file}: is damaged: remove it, and the seconds are counted from now on") from error


def _write_text(path: Path, text: str) -> None:
    with atomic_write(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8")


def _write_table(path: Path, header: Sequence[str], rows: Sequence[EpisodeRow | EvaluationRow]) -> None:
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def summarise(config: RunConfig, scenario: Scenario, trainer: Training, wall_s: float) -> dict[str, Any]:
    """Return the results of a training so far, for summary.json; scores are r_M, one per trial, of the policy it keeps.

    An unfinished trial has no final score: it has learned since its last greedy evaluation. ``played_to_optimum``
    includes the greedy episodes: in a live game they take as long as any other.
    """
    evaluations = [[row for row in trainer.evaluation_rows if row.trial == trial] for trial in range(config.trials)]
    firsts = [next((row.episode for row in rows if row.score >= scenario.optimum), None) for rows in evaluations]
    team = config.team
    builders = {"builders": len(team.starts), "networks_kind": team.networks, "starts": team.starts} if team else {}
    return {
        "scenario": scenario.name,
        "agent": config.agent,
        "preset": config.preset_name,
        "backend": config.backend,
        **builders,
        "trials": config.trials,
        "seed": config.seed,
        "episodes": config.preset.episodes,
        "optimum": scenario.optimum,
        "final_scores": [
            float(score) if finished else None
            for score, finished in zip(trainer.policy_scores, trainer.runs_finished, strict=True)
        ],
        "episodes_to_optimum": firsts,
        "played_to_optimum": [_played_until(trainer, trial, first) for trial, first in enumerate(firsts)],
        "episodes_done": [int(done) for done in trainer.episodes_done],
        "demonstrated": [int(shown) for shown in trainer.demonstrated],
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
