"""The folder of a team's training: config.toml, episodes.csv, evaluations.csv, summary.json and checkpoint/."""

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.cooperative.team import MOST_BUILDERS, Team
from mc_nested.arena.scenario_file import ScenarioTable, scenario_of
from mc_nested.errors import RunError, ScenarioError
from mc_nested.learn.cooperation.team_agent import Kind, TeamAgent
from mc_nested.learn.cooperation.team_trainer import TeamArena, TeamTrainer
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.checkpoint import Checkpoint
from mc_nested.learn.runs.folder_kind import FORMAT, check_free
from mc_nested.learn.runs.run_files import begin_folder, read_config, wall_s_so_far, write_results, writing_in
from mc_nested.learn.state_dict import part_of

Coordinate = Annotated[int, Field(ge=0)]


class TeamConfig(BaseModel):
    """Everything needed to repeat a team's training; scenario and preset are complete, no other file is needed."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    format: int = FORMAT
    builders: Annotated[int, Field(ge=1, le=MOST_BUILDERS)]
    networks: Kind
    starts: list[Annotated[list[Coordinate], Field(min_length=2, max_length=2)]]
    trials: Annotated[int, Field(ge=1)]
    seed: Annotated[int, Field(ge=0)]
    preset_name: str
    preset: Preset
    scenario: ScenarioTable

    def identity(self) -> dict[str, Any]:
        """What is trained: a checkpoint fits only the same."""
        return self.model_dump(exclude={"format"})


class TeamRun:
    """The folder of one training of a team.

    Args:
        path: its path.
        config: what is trained there.

    Raises:
        ScenarioError: the scenario can't be built, or not by these builders.
        PresetError: builders in one arena can't explore as the preset does.
    """

    def __init__(self, path: Path, config: TeamConfig) -> None:
        self.path = path
        self.config = config
        source = str(path / "config.toml")
        starts = tuple((x, y) for x, y in config.starts)
        self.team = Team(scenario_of(config.scenario, source), starts)
        if self.team.builders != config.builders:
            raise ScenarioError(f"{source}: {config.builders} builders and {len(starts)} starts: give each a start")
        self.checkpoint = Checkpoint(path / "checkpoint", config.identity())

    @classmethod
    def new(cls, path: Path, config: TeamConfig) -> "TeamRun":
        """A folder for a new training; RunError if the path holds anything already. Nothing is written yet."""
        check_free(path)
        return cls(path, config)

    @classmethod
    def open(cls, path: Path) -> "TeamRun":
        """The folder of an earlier training; RunError if it isn't one."""
        config = read_config(path, TeamConfig, "cooperate", "cooperation")
        try:
            return cls(path, config)
        except ScenarioError as error:
            raise RunError(str(error)) from error

    def new_trainer(self, arenas: Sequence[TeamArena]) -> TeamTrainer:
        """An untrained team in each of these arenas."""
        config = self.config
        agent = TeamAgent(config.networks, self.team, config.preset, config.seed, range(len(arenas)))
        return TeamTrainer(arenas, agent, config.preset, config.seed)

    def begin(self) -> None:
        """Make the folder and write config.toml; RunError if the disk refuses."""
        begin_folder(self.path, self.config)

    def writing(self) -> AbstractContextManager[None]:
        """Around writing here: RunError, one line that says how to resume, if the disk refuses."""
        return writing_in(self.path, "cooperate")

    def save(self, trainer: TeamTrainer, wall_s: float) -> dict[str, Any]:
        """Write the checkpoint, the tables and the summary as they are now, and return the summary.

        RunError if the disk refuses. The same training writes the same bytes, except for the summary's ``wall_s``.
        """
        summary = summarise(self.config, self.team, trainer, wall_s)
        with self.writing():
            self.checkpoint.save(trainer, finished=trainer.finished)
            write_results(self.path, trainer.episode_rows, trainer.evaluation_rows, summary)
        return summary

    def agent_of(self, trial: int) -> TeamAgent:
        """The agents of the policy that a trial keeps, able to act; RunError as for ``Checkpoint.state``."""
        config = self.config
        agent = TeamAgent(config.networks, self.team, config.preset, config.seed, [trial])
        kept, rows = part_of(self.checkpoint.state(), "kept"), agent.rows_of(trial)
        agent.load_online({role: kept[role][rows[role]] for role in agent.online()})
        return agent

    @property
    def only_begun(self) -> bool:
        """Whether nothing was ever saved here: the training was killed before its first checkpoint."""
        return not self.checkpoint.exists

    def wall_s_so_far(self) -> float:
        """Seconds that the training took until its last save; 0 if the summary doesn't say."""
        return wall_s_so_far(self.path)


def summarise(config: TeamConfig, team: Team, trainer: TeamTrainer, wall_s: float) -> dict[str, Any]:
    """The results of a training so far, for summary.json; scores are the team's r_M, one per trial.

    An unfinished trial has no final score: it has learned since its last greedy evaluation.
    """
    evaluations = [[row for row in trainer.evaluation_rows if row.trial == trial] for trial in range(config.trials)]
    optimum = team.scenario.optimum
    return {
        "scenario": team.scenario.name,
        "builders": config.builders,
        "networks_kind": config.networks,
        "starts": config.starts,
        "preset": config.preset_name,
        "trials": config.trials,
        "seed": config.seed,
        "episodes": config.preset.episodes,
        "optimum": optimum,
        "final_scores": [
            float(score) if finished else None
            for score, finished in zip(trainer.kept_scores, trainer.runs_finished, strict=True)
        ],
        "episodes_to_optimum": [
            next((row.episode for row in rows if row.score >= optimum), None) for rows in evaluations
        ],
        "episodes_done": [int(done) for done in trainer.episodes_done],
        "env_ticks": trainer.env_ticks,
        "evaluation_ticks": trainer.evaluation_ticks,
        "updates": trainer.agent.updates,
        "wall_s": round(wall_s, 3),
        "networks": trainer.agent.networks,
        "parameters": trainer.agent.parameters,
    }
