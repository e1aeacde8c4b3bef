"""An ablation: the preset live with each part off in turn, beside the model-free preset and a planner (ablation.toml).

The presets aren't chosen: the parts are theirs.
"""

from importlib import resources
from typing import Annotated, Any

import tomlkit
from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import ScenarioTable
from mc_nested.errors import PresetError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.experiments.experiment_folder import ExperimentConfig, scenarios_of
from mc_nested.learn.experiments.jobs import PLANNER, Job
from mc_nested.learn.experiments.sweep import changed_tables
from mc_nested.learn.preset import Preset, load_preset, parse_preset
from mc_nested.toml_file import parse_toml

FILE = "ablation.toml"
LIVE = "live"


class AblatedPart(BaseModel):
    """What one line of an ablation trains: a complete preset, or a planner that plays as many episodes at most."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    name: str
    base: str
    what: str = ""
    preset: Preset
    planner: bool = False


class AblationConfig(ExperimentConfig):
    """An ablation of the nested agent; the first part is what the others of its base are compared with."""

    scenarios: Annotated[list[ScenarioTable], Field(min_length=1)]
    parts: Annotated[list[AblatedPart], Field(min_length=1)]

    def loaded_scenarios(self) -> list[Scenario]:
        """The scenarios; RunError if two have the same name, ScenarioError if one can't be built."""
        return scenarios_of(self.scenarios)

    def cut(self) -> list[Job]:
        """A job for each trial of what practises, since nothing is quicker in a batch; else of each part and design.

        The large jobs come first.
        """
        jobs: list[Job] = []
        for part in self.parts:
            for scenario in self.loaded_scenarios():
                trials = range(self.trials)
                alone = part.preset.imagination is not None and not part.planner
                for together in [[trial] for trial in trials] if alone else [list(trials)]:
                    jobs.append(self._job(f"{len(jobs):04d}", part, scenario, together))
        return sorted(jobs, key=lambda job: -job.work)

    def _job(self, name: str, part: AblatedPart, scenario: Scenario, trials: list[int]) -> Job:
        return Job(
            name=name,
            spec=AGENT_SPECS["nested"],
            preset=part.preset,
            groups=(part.name,) * len(trials),
            scenarios=(scenario,) * len(trials),
            trials=tuple(trials),
            seed=self.seed,
            stop_at_optimum=True,
            library=PLANNER if part.planner else None,
        )


class _Row(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    name: str
    base: str
    what: str = ""
    preset: dict[str, Any] = Field(default_factory=dict)
    without: list[str] = Field(default_factory=list)
    planner: bool = False

    def part(self, episodes: int | None) -> AblatedPart:
        base = load_preset(self.base).model_dump(exclude_none=True)
        kept = {key: value for key, value in base.items() if key not in self.without}
        changed = changed_tables(kept, self.preset)
        if episodes is not None:
            changed["episodes"] = episodes
        preset = parse_preset(tomlkit.dumps(changed), f"{FILE}, {self.name}")
        return AblatedPart(name=self.name, base=self.base, what=self.what, preset=preset, planner=self.planner)


class _Rows(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    live_episodes: int
    rows: list[_Row]


def shipped_parts(episodes: int | None = None) -> list[AblatedPart]:
    """The shipped parts, each with as many episodes as are asked for, or as its preset and ablation.toml say."""
    text = (resources.files("mc_nested.learn.experiments") / FILE).read_text("utf-8")
    read = parse_toml(_Rows, text, FILE, PresetError)
    return [row.part(episodes or (read.live_episodes if row.base == LIVE else None)) for row in read.rows]
