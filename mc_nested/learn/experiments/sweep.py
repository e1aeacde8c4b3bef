"""A sensitivity run: every agent with the preset, and with one choice at a time changed (variants.toml)."""

from collections.abc import Mapping
from dataclasses import replace
from importlib import resources
from typing import Annotated, Any

import tomlkit
from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import LONGEST, scenario_of, table_of
from mc_nested.errors import PresetError, ScenarioError
from mc_nested.learn.agents import AGENT_SPECS, AgentName, AgentSpec, check_exploration
from mc_nested.learn.experiments.experiment_folder import OnePresetConfig
from mc_nested.learn.experiments.jobs import Run
from mc_nested.learn.preset import Preset, parse_preset
from mc_nested.toml_file import parse_toml

FILE = "variants.toml"


class Variant(BaseModel):
    """One changed choice; what isn't given stays as it is. An empty choice is the base: nothing is changed."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    choice: str = ""
    value: str = ""
    agent: AgentName = "nested"
    needs: str | None = None
    preset: dict[str, Any] = Field(default_factory=dict)
    start: Annotated[list[int], Field(min_length=2, max_length=2)] | None = None
    step_limit: Annotated[int, Field(ge=1, le=LONGEST)] | None = None
    sees_choice: bool | None = None

    @property
    def name(self) -> str:
        """A name that no other variant has."""
        return f"{self.choice}: {self.value}" if self.choice else f"base, {self.agent}"

    def spec(self) -> AgentSpec:
        """The agent's spec."""
        spec = AGENT_SPECS[self.agent]
        return spec if self.sees_choice is None else replace(spec, sees_choice=self.sees_choice)

    def preset_from(self, base: Preset) -> Preset:
        """The preset with its changes; PresetError if they don't fit."""
        changed = changed_tables(base.model_dump(exclude_none=True), self.preset)
        return parse_preset(tomlkit.dumps(changed), f"variant {self.name}")

    def scenario_from(self, base: Scenario) -> Scenario:
        """The scenario with its changes; ScenarioError if it can't be built."""
        start, limit = self.start or list(base.start), self.step_limit or base.step_limit
        table = table_of(base).model_copy(update={"start": start, "step_limit": limit})
        return scenario_of(table, f"variant {self.name}, scenario {base.name}")

    def changes(self, preset: Preset, scenarios: list[Scenario]) -> bool:
        """Whether it changes anything, and is possible, with this preset and these designs."""
        if self.needs and getattr(preset, self.needs, None) is None:
            return False
        try:
            check_exploration(self.spec(), preset)
            changed = [self.scenario_from(scenario) for scenario in scenarios]
            changed_preset = self.preset_from(preset)
        except (PresetError, ScenarioError):
            return False
        return changed_preset != preset or changed != scenarios or self.spec() != AGENT_SPECS[self.agent]


class _Variants(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    variants: list[Variant]


class SweepConfig(OnePresetConfig):
    """A sensitivity run: the variants, the base of each of their agents first."""

    variants: Annotated[list[Variant], Field(min_length=1)]

    def runs(self) -> list[Run]:
        """Variant by variant, scenario by scenario, trial by trial; variants of one agent and preset are adjacent."""
        scenarios = self.loaded_scenarios()
        return side_by_side(
            [
                Run(variant.name, variant.spec(), preset, changed, trial)
                for variant in self.variants
                for preset in [variant.preset_from(self.preset)]
                for changed in [variant.scenario_from(scenario) for scenario in scenarios]
                for trial in range(self.trials)
            ]
        )


def side_by_side(runs: list[Run]) -> list[Run]:
    """The runs in their order, but those of one agent and preset adjacent."""
    kinds: list[tuple[AgentSpec, Preset]] = []
    for run in runs:
        if (run.spec, run.preset) not in kinds:
            kinds.append((run.spec, run.preset))
    return sorted(runs, key=lambda run: kinds.index((run.spec, run.preset)))


def shipped_variants(preset: Preset, scenarios: list[Scenario]) -> list[Variant]:
    """The shipped variants that change anything here; the base of each agent comes first."""
    text = (resources.files("mc_nested.learn.experiments") / FILE).read_text("utf-8")
    variants = [
        variant
        for variant in parse_toml(_Variants, text, FILE, PresetError).variants
        if variant.changes(preset, scenarios)
    ]
    agents = list(dict.fromkeys(["nested", *(variant.agent for variant in variants)]))
    return [*(Variant(agent=agent) for agent in agents), *variants]


def changed_tables(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """The nested tables with some values changed."""
    both = dict(base)
    for key, value in changes.items():
        both[key] = changed_tables(base.get(key) or {}, value) if isinstance(value, Mapping) else value
    return both
