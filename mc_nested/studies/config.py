"""config.toml of a study: all that is needed to repeat it. No other file is; a preset or a design stands there once."""

import itertools
from collections.abc import Sequence
from typing import Annotated, TypeVar

from pydantic import Field

from mc_nested.arena.cooperative.team import MOST_BUILDERS
from mc_nested.arena.design import MOST_DESIGNS
from mc_nested.arena.scenario_file import ScenarioTable, scenario_of, table_of
from mc_nested.errors import RunError
from mc_nested.learn.builders import Networks
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.folder_kind import FORMAT
from mc_nested.studies.arm import AGENTS, Arm
from mc_nested.studies.job import Job, cut_into_jobs, side_by_side
from mc_nested.toml_file import TomlTable, one_of


class ArmTable(TomlTable):
    """An arm as config.toml has it, where presets and scenarios are named; arm.py says what each key is."""

    name: str
    agent: Annotated[str, one_of(AGENTS)]
    preset: str
    preset_name: str
    scenarios: Annotated[list[str], Field(min_length=1, max_length=MOST_DESIGNS)]
    trials: Annotated[int, Field(ge=1)]
    labels: dict[str, str] = Field(default_factory=dict)
    sees_choice: bool | None = None
    builders: Annotated[int, Field(ge=1, le=MOST_BUILDERS)] | None = None
    networks: Networks = "shared"
    stop_at_optimum: bool = False
    differs_by_design: bool = False
    together: Annotated[int, Field(ge=1)] | None = None


class StudyConfig(TomlTable):
    """A study with its arms in the order of its report.

    ``jobs`` is the number of processes, which may decide what trains as one batch, but not the results. ``notes`` are
    what its report says of it beside.
    """

    format: int = FORMAT
    study: str
    trials: Annotated[int, Field(ge=1)]
    seed: Annotated[int, Field(ge=0)]
    jobs: Annotated[int, Field(ge=1)]
    notes: dict[str, str] = Field(default_factory=dict)
    presets: dict[str, Preset]
    scenarios: dict[str, ScenarioTable]
    arms: Annotated[list[ArmTable], Field(min_length=1)]

    def loaded_arms(self) -> list[Arm]:
        """Return the arms; ScenarioError or RunError if one can't be trained, or is there twice."""
        scenarios = {name: scenario_of(table, name) for name, table in self.scenarios.items()}
        arms = []
        for table in self.arms:
            missing = [name for name in table.scenarios if name not in scenarios]
            if missing or table.preset not in self.presets:
                raise RunError(f"arm {table.name!r}: names what isn't there: put config.toml back as it was")
            own = tuple(scenarios[name] for name in table.scenarios)
            arms.append(Arm(**{**table.model_dump(), "preset": self.presets[table.preset], "scenarios": own}))
        _check_different(arms)
        return arms

    def cut(self) -> list[Job]:
        """Return the jobs, in the order in which processes take them; errors as ``loaded_arms``'s."""
        runs = [run for arm in self.loaded_arms() for run in arm.runs()]
        return cut_into_jobs(side_by_side(runs), self.jobs, self.seed)


Table = TypeVar("Table", Preset, ScenarioTable)


def config_of(
    study: str, arms: Sequence[Arm], *, trials: int, seed: int, jobs: int, notes: dict[str, str] | None = None
) -> StudyConfig:
    """Return the config of a study with these arms; RunError if two of them are the same."""
    _check_different(arms)
    presets: dict[str, Preset] = {}
    scenarios: dict[str, ScenarioTable] = {}
    tables = []
    for arm in arms:
        names = [_keyed(scenarios, table.name, table) for table in map(table_of, arm.scenarios)]
        preset = _keyed(presets, arm.short_preset, arm.preset)
        tables.append(ArmTable(**{**vars(arm), "preset": preset, "scenarios": names}))
    return StudyConfig(
        study=study,
        trials=trials,
        seed=seed,
        jobs=jobs,
        notes=notes or {},
        presets=presets,
        scenarios=scenarios,
        arms=tables,
    )


def _keyed(tables: dict[str, Table], name: str, table: Table) -> str:
    """Put the table among the others, unless it is there, and return its key: its name, or nearly."""
    for number in itertools.count(1):
        key = name if number == 1 else f"{name}, {number}"
        if tables.setdefault(key, table) == table:
            return key
    raise AssertionError("there is always another number")


def _check_different(arms: Sequence[Arm]) -> None:
    """Raise RunError if two scenarios of an arm have one name, or two arms on a scenario."""
    seen: set[tuple[str, str]] = set()
    for arm in arms:
        names = [scenario.name for scenario in arm.scenarios]
        for name in names:
            if names.count(name) > 1:
                raise RunError(f"two scenarios are named {name!r}: name it once, or rename one in its file")
            if (arm.name, name) in seen:
                raise RunError(f"two arms are named {arm.name!r}: name it once, or rename a file")
            seen.add((arm.name, name))
