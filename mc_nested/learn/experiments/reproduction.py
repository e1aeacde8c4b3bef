"""The paper's experiment as runs: agents x scenarios x trials, all with one preset, and some of them for longer."""

from typing import Annotated

from pydantic import AfterValidator, Field

from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.experiments.experiment_folder import OnePresetConfig
from mc_nested.learn.experiments.jobs import Run
from mc_nested.learn.preset import MOST, Preset

LONGER_AGENTS, LONGER_SCENARIOS = ("nested", "hierarchical"), ("zigzag", "diamond")
"""The paper's appendix says that these would reach the optimum with more training."""

LONGER = "-longer"
"""Ends the group names of the longer runs."""


def _check_agents(names: list[str]) -> list[str]:
    if set(names) - set(AGENT_SPECS) or len(set(names)) < len(names):
        raise ValueError(f"must be some of {', '.join(AGENT_SPECS)}, each once")
    return names


class ReproduceConfig(OnePresetConfig):
    """A repetition of the paper's experiment; claim (f) takes ``longer`` times the episodes, 0 for no such runs."""

    agents: Annotated[list[str], Field(min_length=1), AfterValidator(_check_agents)]
    longer: Annotated[int, Field(ge=0)]

    @property
    def longer_agents(self) -> list[str]:
        """The agents that are also trained for longer."""
        return [agent for agent in self.agents if self.longer and agent in LONGER_AGENTS]

    @property
    def longer_scenarios(self) -> list[str]:
        """The scenarios on which they are trained for longer."""
        return [table.name for table in self.scenarios if self.longer and table.name in LONGER_SCENARIOS]

    @property
    def longer_preset(self) -> Preset:
        """The preset of the longer runs."""
        return self.preset.model_copy(update={"episodes": min(self.longer * self.preset.episodes, MOST)})

    def runs(self) -> list[Run]:
        """Agent by agent, scenario by scenario, trial by trial; the longer runs at the end."""
        scenarios = self.loaded_scenarios()
        usual = [
            Run(agent, AGENT_SPECS[agent], self.preset, scenario, trial)
            for agent in self.agents
            for scenario in scenarios
            for trial in range(self.trials)
        ]
        longer = [
            Run(agent + LONGER, AGENT_SPECS[agent], self.longer_preset, scenario, trial)
            for agent in self.longer_agents
            for scenario in scenarios
            if scenario.name in self.longer_scenarios
            for trial in range(self.trials)
        ]
        return usual + longer
