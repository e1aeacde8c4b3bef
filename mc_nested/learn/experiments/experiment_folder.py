"""The folder of an experiment of many runs: config.toml, and jobs/ with each job's checkpoint or outcome."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Generic, TypeVar

import tomlkit
from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import ScenarioTable, scenario_of
from mc_nested.atomic_file import atomic_write
from mc_nested.errors import RunError
from mc_nested.learn.experiments.job_training import JobOutcome, outcome_of
from mc_nested.learn.experiments.jobs import Job, Run, cut_into_jobs
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.learn.runs.folder_kind import FORMAT, check_config, check_free
from mc_nested.toml_file import parse_toml, read_toml_text

CONFIG, JOBS_FOLDER, STAMP = "config.toml", "jobs", "config.sha256"


class ExperimentConfig(BaseModel, ABC):
    """Everything needed to repeat an experiment; scenarios and presets are complete, no other file is needed.

    ``jobs`` is the number of processes, which may decide what trains as one batch, but not the results.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    format: int = FORMAT
    trials: Annotated[int, Field(ge=1)]
    seed: Annotated[int, Field(ge=0)]
    jobs: Annotated[int, Field(ge=1)]

    @abstractmethod
    def cut(self) -> list[Job]:
        """The jobs, in the order in which processes take them; ScenarioError or RunError if it can't be trained."""


class OnePresetConfig(ExperimentConfig):
    """An experiment around one preset, whose runs are cut into as few batches as keep every process at work."""

    preset_name: str
    preset: Preset
    scenarios: Annotated[list[ScenarioTable], Field(min_length=1)]

    @abstractmethod
    def runs(self) -> list[Run]:
        """Every run; those that can train as one batch are adjacent."""

    def cut(self) -> list[Job]:
        return cut_into_jobs(self.runs(), self.jobs, self.seed)

    def loaded_scenarios(self) -> list[Scenario]:
        """The scenarios; RunError if two have the same name, ScenarioError if one can't be built."""
        return scenarios_of(self.scenarios)


def scenarios_of(tables: Sequence[ScenarioTable]) -> list[Scenario]:
    """The scenarios of a config; RunError if two have the same name, ScenarioError if one can't be built."""
    names = [table.name for table in tables]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise RunError(f"two scenarios are named {twice!r}: name it once, or rename one in its file")
    return [scenario_of(table, table.name) for table in tables]


Config = TypeVar("Config", bound=ExperimentConfig)


class ExperimentFolder(Generic[Config]):
    """The folder of one experiment.

    Args:
        path: its path.
        config: what is trained there.
        verb: the command that made it and can resume it.
    """

    def __init__(self, path: Path, config: Config, verb: str) -> None:
        self.path = path
        self.config = config
        self.verb = verb
        self.jobs = config.cut()

    @classmethod
    def new(cls, path: Path, config: Config, verb: str) -> "ExperimentFolder[Config]":
        """A folder for a new experiment; RunError if the path holds anything already. Nothing is written yet."""
        check_free(path)
        return cls(path, config, verb)

    @classmethod
    def open(cls, path: Path, model: type[Config], verb: str) -> "ExperimentFolder[Config]":
        """The folder of an earlier experiment; RunError if it isn't one, or its config was changed since."""
        file = path / CONFIG
        if not file.is_file():
            raise RunError(f"{path}: no {CONFIG} there: name the folder of a {verb} (its --out)")
        text = read_toml_text(file, RunError)
        check_config(text, path, verb)
        folder = cls(path, parse_toml(model, text, str(file), RunError), verb)
        stamp = path / JOBS_FOLDER / STAMP
        if stamp.exists() and stamp.read_text("utf-8", errors="replace").strip() != folder._stamp:
            raise RunError(
                f"{file}: was changed after the {verb} began, so what is trained already wouldn't fit: put it back as "
                f"it was, or start over with another --out"
            )
        return folder

    @property
    def resume_command(self) -> str:
        """The command that resumes it."""
        return f"mc-nested {self.verb} --resume {self.path}"

    def begin(self) -> None:
        """Make the folder and write the config, unless they are there; RunError if the disk refuses."""
        try:
            (self.path / JOBS_FOLDER).mkdir(parents=True, exist_ok=True)
            for file, text in (
                (self.path / CONFIG, tomlkit.dumps(self.config.model_dump(exclude_none=True))),
                (self.path / JOBS_FOLDER / STAMP, f"{self._stamp}\n"),
            ):
                if not file.exists():
                    with atomic_write(file) as unfinished:
                        unfinished.write_text(text, encoding="utf-8")
        except OSError as error:
            raise RunError(f"{self.path}: can't be written, {error.strerror}: name another folder") from error

    def folder_of(self, job: Job) -> Path:
        """The job's own folder."""
        return self.path / JOBS_FOLDER / job.name

    def outcomes(self) -> list[tuple[Job, JobOutcome | None]]:
        """Every job with its outcome, None if it isn't finished; RunError if a file can't be used."""
        return [(job, outcome_of(job, self.folder_of(job))) for job in self.jobs]

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Around writing here: RunError, one line that says how to resume, if the disk refuses."""
        try:
            yield
        except OSError as error:
            raise RunError(
                f"{self.path}: can't be written ({error}): make room, then {self.resume_command} goes on"
            ) from error

    @property
    def _stamp(self) -> str:
        return fingerprint(self.config.model_dump(exclude={"format"}, exclude_none=True))
