"""The paper's experiment again under each of its open choices, one at a time, by all three agents (robustness.toml)."""

from importlib import resources
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import LONGEST, scenario_of, table_of
from mc_nested.errors import PresetError, ScenarioError
from mc_nested.learn.agents import AGENT_SPECS, AgentSpec
from mc_nested.learn.experiments.experiment_folder import OnePresetConfig
from mc_nested.learn.experiments.jobs import Run
from mc_nested.learn.experiments.sweep import Variant, side_by_side
from mc_nested.learn.preset import Preset
from mc_nested.toml_file import parse_toml

FILE = "robustness.toml"

SINGLE = "single"


class Choice(BaseModel):
    """One choice made otherwise; what isn't given stays as it is. An empty choice is the base: nothing is changed.

    ``designs``: other drawings for the scenarios of those names. ``sees_choice`` is the single agent's.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    choice: str = ""
    value: str = ""
    needs: str | None = None
    preset: dict[str, Any] = Field(default_factory=dict)
    start: Annotated[list[int], Field(min_length=2, max_length=2)] | None = None
    step_limit: Annotated[int, Field(ge=1, le=LONGEST)] | None = None
    sees_choice: bool | None = None
    designs: dict[str, str] = Field(default_factory=dict)

    @property
    def name(self) -> str:
        """A name that no other choice has."""
        return f"{self.choice}: {self.value}" if self.choice else "base"

    def group(self, agent: str) -> str:
        """The group of its runs of that agent."""
        return f"{self.name}, {agent}"

    def spec(self, agent: str) -> AgentSpec:
        """That agent's spec."""
        return self._variant(agent).spec()

    def preset_from(self, base: Preset) -> Preset:
        """The preset with its changes; PresetError if they don't fit."""
        return self._variant(SINGLE).preset_from(base)

    def scenario_from(self, base: Scenario) -> Scenario:
        """The scenario with its changes; ScenarioError if it can't be built."""
        design = self.designs.get(base.name)
        if design is not None:
            table = table_of(base).model_copy(update={"design": design})
            base = scenario_of(table, f"{self.name}, scenario {base.name}")
        return self._variant(SINGLE).scenario_from(base)

    def changes(self, preset: Preset, scenarios: list[Scenario]) -> bool:
        """Whether it changes anything, and is possible, for all agents with this preset and these designs."""
        try:
            if [self.scenario_from(scenario) for scenario in scenarios] != scenarios:
                return True
        except ScenarioError:
            return False
        return self._variant(SINGLE).changes(preset, scenarios)

    def _variant(self, agent: str) -> Variant:
        return Variant(
            choice=self.choice,
            value=self.value,
            agent=agent,
            needs=self.needs,
            preset=self.preset,
            start=self.start,
            step_limit=self.step_limit,
            sees_choice=self.sees_choice if agent == SINGLE else None,
        )


class _Choices(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    choices: list[Choice]


class RobustnessConfig(OnePresetConfig):
    """The paper's experiment under each choice, the base first."""

    choices: Annotated[list[Choice], Field(min_length=1)]

    def runs(self) -> list[Run]:
        """Choice by choice, agent by agent, scenario by scenario, trial by trial; what can train together adjacent."""
        scenarios = self.loaded_scenarios()
        return side_by_side(
            [
                Run(choice.group(agent), choice.spec(agent), preset, scenario, trial)
                for choice in self.choices
                for preset in [choice.preset_from(self.preset)]
                for changed in [[choice.scenario_from(scenario) for scenario in scenarios]]
                for agent in AGENT_SPECS
                for scenario in changed
                for trial in range(self.trials)
            ]
        )


def shipped_choices(preset: Preset, scenarios: list[Scenario]) -> list[Choice]:
    """The base, and the shipped choices that change anything with this preset and these designs."""
    text = (resources.files("mc_nested.learn.experiments") / FILE).read_text("utf-8")
    choices = parse_toml(_Choices, text, FILE, PresetError).choices
    return [Choice(), *(choice for choice in choices if choice.changes(preset, scenarios))]
