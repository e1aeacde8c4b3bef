"""The folder of an experiment of many runs: config.toml, and units/ with what trains and what came out of it."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Generic, TypeVar

import tomlkit
from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import ScenarioTable, scenario_of
from mc_nested.errors import RunError
from mc_nested.learn.checkpoint import fingerprint
from mc_nested.learn.folder_kind import refuse_others, refuse_taken
from mc_nested.learn.preset import Preset
from mc_nested.learn.unit_training import UnitOutcome, outcome_of
from mc_nested.learn.units import Run, Unit, cut_into_units
from mc_nested.learn.whole_file import written_whole
from mc_nested.toml_file import parse_toml, read_toml_text

CONFIG, UNITS, STAMP = "config.toml", "units", "config.sha256"


class ExperimentConfig(BaseModel, ABC):
    """What every experiment needs to be repeated; the scenarios and the preset whole, so no other file has to be found.

    ``jobs`` processes share it out, which decides what trains as one batch, but not what comes out.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    trials: Annotated[int, Field(ge=1)]
    seed: Annotated[int, Field(ge=0)]
    jobs: Annotated[int, Field(ge=1)]
    preset_name: str
    preset: Preset
    scenarios: Annotated[list[ScenarioTable], Field(min_length=1)]

    @abstractmethod
    def runs(self) -> list[Run]:
        """Every run, those that can train as one batch side by side."""

    def loaded_scenarios(self) -> list[Scenario]:
        """The scenarios; RunError where two have the same name, ScenarioError where one can't be built."""
        names = [table.name for table in self.scenarios]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise RunError(f"two scenarios are named {twice!r}: name it once, or rename one in its file")
        return [scenario_of(table, table.name) for table in self.scenarios]


Config = TypeVar("Config", bound=ExperimentConfig)


class ExperimentFolder(Generic[Config]):
    """The folder of one experiment.

    Args:
        path: where it lies.
        config: what is trained there.
        verb: the command that made it, and goes on with it.
    """

    def __init__(self, path: Path, config: Config, verb: str) -> None:
        self.path = path
        self.config = config
        self.verb = verb
        self.units = cut_into_units(config.runs(), config.jobs, config.seed)

    @classmethod
    def new(cls, path: Path, config: Config, verb: str) -> "ExperimentFolder[Config]":
        """A folder to begin an experiment in; RunError where the path holds anything. Nothing is written yet."""
        refuse_taken(path)
        return cls(path, config, verb)

    @classmethod
    def open(cls, path: Path, model: type[Config], verb: str) -> "ExperimentFolder[Config]":
        """The folder of an earlier experiment; RunError where it isn't one, or its config was changed since."""
        file = path / CONFIG
        if not file.is_file():
            raise RunError(f"{path}: no {CONFIG} there: name the folder of a {verb} (its --out)")
        text = read_toml_text(file, RunError)
        refuse_others(text, path, verb)
        folder = cls(path, parse_toml(model, text, str(file), RunError), verb)
        stamp = path / UNITS / STAMP
        if stamp.exists() and stamp.read_text("utf-8", errors="replace").strip() != folder._stamp:
            raise RunError(
                f"{file}: was changed after the {verb} began, so what is trained already wouldn't fit: put it back as "
                f"it was, or begin anew with another --out"
            )
        return folder

    @property
    def how_to_go_on(self) -> str:
        """The command that goes on with it."""
        return f"mc-nested {self.verb} --resume {self.path}"

    def begin(self) -> None:
        """Make the folder and write the config, where it isn't there yet; RunError where the disk refuses."""
        try:
            (self.path / UNITS).mkdir(parents=True, exist_ok=True)
            for file, text in (
                (self.path / CONFIG, tomlkit.dumps(self.config.model_dump(exclude_none=True))),
                (self.path / UNITS / STAMP, f"{self._stamp}\n"),
            ):
                if not file.exists():
                    with written_whole(file) as unfinished:
                        unfinished.write_text(text, encoding="utf-8")
        except OSError as error:
            raise RunError(f"{self.path}: can't be written, {error.strerror}: name another folder") from error

    def of_unit(self, unit: Unit) -> Path:
        """The unit's own folder."""
        return self.path / UNITS / unit.name

    def outcomes(self) -> list[tuple[Unit, UnitOutcome | None]]:
        """Every unit with what came out of it, None where it isn't finished; RunError where a file can't be used."""
        return [(unit, outcome_of(unit, self.of_unit(unit))) for unit in self.units]

    @contextmanager
    def writing(self) -> Iterator[None]:
        """While something is written here: RunError, one line that says how to go on, where the disk refuses."""
        try:
            yield
        except OSError as error:
            raise RunError(
                f"{self.path}: can't be written ({error}): make room, then {self.how_to_go_on} goes on"
            ) from error

    @property
    def _stamp(self) -> str:
        return fingerprint(self.config.model_dump(exclude_none=True))
