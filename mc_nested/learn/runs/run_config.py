"""What is trained in a run's folder, as its config.toml says it."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from mc_nested.arena.scenario_file import ScenarioTable
from mc_nested.learn.agents import AgentName
from mc_nested.learn.builders import Builders, Networks
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.folder_kind import FORMAT
from mc_nested.toml_file import TomlTable

Coordinate = Annotated[int, Field(ge=0)]


class TeamTable(TomlTable):
    """Several builders in one arena: the start cell of each, in the order of their numbers, and how they learn."""

    networks: Networks
    starts: Annotated[list[Annotated[list[Coordinate], Field(min_length=2, max_length=2)]], Field(min_length=1)]

    @property
    def builders(self) -> Builders:
        """The builders that it describes."""
        return Builders(tuple((x, y) for x, y in self.starts), self.networks)


class RunConfig(TomlTable):
    """Everything needed to repeat a training; scenario and preset are complete, no other file is needed."""

    format: int = FORMAT
    agent: AgentName
    backend: Literal["sim", "virtual", "live"]
    profile: str | None = None
    trials: Annotated[int, Field(ge=1)]
    seed: Annotated[int, Field(ge=0)]
    stop_at_optimum: bool
    preset_name: str
    preset: Preset
    scenario: ScenarioTable
    team: TeamTable | None = None
    design_unknown: bool = False

    @property
    def trains_objectives(self) -> bool:
        """Whether the agent with objectives is trained: one run, which is told the design."""
        return self.preset.objectives is not None and not self.design_unknown

    @property
    def title(self) -> str:
        """What is built, who learns it, and with which preset, in a line."""
        who = f"{self.agent} agent"
        if self.team:
            count = len(self.team.starts)
            who = f"{count} builders" if count > 1 else "one builder"
            who += f", networks {self.team.networks}"
        unknown = ", design unknown" if self.design_unknown else ""
        return f"{self.scenario.name}, {who}, preset {Path(self.preset_name).stem}{unknown}"

    def identity(self) -> dict[str, Any]:
        """Return what is trained: a checkpoint fits only the same.

        Without the profile, which may be moved or renamed, and the device.
        """
        usual = {} if self.design_unknown else {"design_unknown": True}
        return self.model_dump(exclude={"format": True, "profile": True, "preset": {"device"}, **usual})
