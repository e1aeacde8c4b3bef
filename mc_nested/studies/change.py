"""One thing changed from a preset, its scenarios or its agent: an arm of the studies that vary one choice at a time."""

from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Annotated, Any

import tomlkit
from pydantic import Field

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import LONGEST, scenario_of, table_of
from mc_nested.errors import PresetError, ScenarioError
from mc_nested.learn.agents import AGENT_SPECS, AgentName, check_exploration
from mc_nested.learn.preset import Preset, parse_preset
from mc_nested.studies.arm import Arm, spec_of
from mc_nested.studies.study import StudyOptions
from mc_nested.toml_file import TomlTable, parse_toml


class Change(TomlTable):
    """One changed choice; what isn't given stays as it is. An empty choice is the base: nothing is changed.

    ``what`` it means, in words. ``base``: the preset that is changed, where that isn't the study's own. ``needs``: a
    table of the preset; where the preset lacks it, the change is left out. ``without``: tables that are left out.
    ``designs``: other drawings for the scenarios of those names. ``sees_choice`` is the single agent's. ``agent`` is
    who learns where not all do.
    """

    choice: str = ""
    value: str = ""
    what: str = ""
    agent: AgentName = "nested"
    base: str = ""
    needs: str | None = None
    preset: dict[str, Any] = Field(default_factory=dict)
    without: list[str] = Field(default_factory=list)
    start: Annotated[list[int], Field(min_length=2, max_length=2)] | None = None
    step_limit: Annotated[int, Field(ge=1, le=LONGEST)] | None = None
    sees_choice: bool | None = None
    designs: dict[str, str] = Field(default_factory=dict)

    @property
    def name(self) -> str:
        """A name that no other change has."""
        return f"{self.choice}: {self.value}" if self.choice else "base"

    def preset_from(self, base: Preset) -> Preset:
        """Return the preset with its changes; PresetError if they don't fit."""
        if not (self.preset or self.without):
            return base
        kept = base.model_dump(exclude_none=True, exclude=set(self.without))
        return parse_preset(tomlkit.dumps(_changed_tables(kept, self.preset)), f"variant {self.name}")

    def scenario_from(self, base: Scenario) -> Scenario:
        """Return the scenario with its changes; ScenarioError if it can't be built."""
        table = table_of(base)
        changed = {
            "start": self.start or table.start,
            "step_limit": self.step_limit or table.step_limit,
            "design": self.designs.get(base.name, table.design),
        }
        return scenario_of(table.model_copy(update=changed), f"variant {self.name}, scenario {base.name}")

    def differs(self, agents: Sequence[str], preset: Preset, scenarios: Sequence[Scenario]) -> bool:
        """Return whether it changes anything, and is possible, for these agents with this preset on these designs."""
        if self.needs and getattr(preset, self.needs, None) is None:
            return False
        specs = [spec_of(agent, self.sees_choice) for agent in agents]
        try:
            for spec in specs:
                check_exploration(spec, preset)
            is_other = self.preset_from(preset) != preset
            is_elsewhere = [self.scenario_from(scenario) for scenario in scenarios] != list(scenarios)
        except (PresetError, ScenarioError):
            return False
        return is_other or is_elsewhere or specs != [AGENT_SPECS[agent] for agent in agents]

    def arm(self, name: str, agent: str, options: StudyOptions, preset: Preset) -> Arm:
        """Return the arm of that name and agent: what was asked for, with this change."""
        return Arm(
            name=name,
            agent=agent,
            preset=self.preset_from(preset),
            preset_name=options.preset,
            scenarios=[self.scenario_from(scenario) for scenario in options.scenarios],
            trials=options.trials,
            labels={"agent": agent, "choice": self.choice, "value": self.value},
            sees_choice=self.sees_choice,
        )


class _Changes(TomlTable):
    changes: list[Change]


def shipped_changes(file: str) -> list[Change]:
    """Return the changes of a file of this package."""
    text = (resources.files("mc_nested.studies") / file).read_text("utf-8")
    return parse_toml(_Changes, text, file, PresetError).changes


def _changed_tables(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the nested tables with some values changed."""
    both = dict(base)
    for key, value in changes.items():
        both[key] = _changed_tables(base.get(key) or {}, value) if isinstance(value, Mapping) else value
    return both
