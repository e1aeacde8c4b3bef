"""An arm of a study: trainings that are the same but for their design and their trial."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from mc_nested.arena.design import MOST_DESIGNS
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.agents import AGENT_SPECS, AgentSpec, check_exploration, check_parts
from mc_nested.learn.preset import Preset
from mc_nested.studies.job import JobBuilders, Run

LIBRARY = "stable-baselines3"

SB3 = "sb3"
"""The name of stable-baselines3's agent (sb3.py)."""

AGENTS = (*AGENT_SPECS, SB3)
"""The agents that an arm can have, by name."""


@dataclass(frozen=True)
class Arm:
    """What a study compares with its other arms.

    Args:
        name: one that no other arm of its designs has.
        preset: its hyper-parameters, complete.
        scenarios: what is built, each in trainings of its own.
        trials: trainings on each scenario.
        agent: who learns.
        preset_name: a shipped preset's name, or a file.
        labels: what tells it apart in the study's table, by column.
        sees_choice: whether the single agent sees the material that it chose; None as it ever does.
        builders: where several share an arena, how many and how they learn.
        stop_at_optimum: whether a trial ends at its first greedy episode at the optimum.
        differs_by_design: whether each design has random numbers of its own, so that one lucky network isn't lucky on
            all; such designs train one after the other, so that what is left takes as long as what is done.
        together: trials on a design that train as one job at most; None for as many as keep every process at work.
    """

    name: str
    preset: Preset
    scenarios: Sequence[Scenario]
    trials: int
    agent: str = "nested"
    preset_name: str = "paper"
    labels: Mapping[str, str] = field(default_factory=dict)
    sees_choice: bool | None = None
    builders: JobBuilders | None = None
    stop_at_optimum: bool = False
    differs_by_design: bool = False
    together: int | None = None

    @property
    def short_preset(self) -> str:
        """The preset's name without a folder and an ending."""
        return Path(self.preset_name).stem

    @property
    def spec(self) -> AgentSpec:
        """How its agent is put together; stable-baselines3's has the single agent's task."""
        return spec_of("single" if self.agent == SB3 else self.agent, self.sees_choice)

    def runs(self) -> list[Run]:
        """Return its trainings, scenario by scenario, trial by trial."""
        return [
            Run(
                group=self.name,
                spec=self.spec,
                preset=self.preset,
                scenario=scenario,
                trial=self.number_of(place, trial),
                stop_at_optimum=self.stop_at_optimum,
                library=LIBRARY if self.agent == SB3 else None,
                builders=self.builders,
                together=self.together,
                turn=place if self.differs_by_design else 0,
            )
            for place, scenario in enumerate(self.scenarios)
            for trial in range(self.trials)
        ]

    def number_of(self, place: int, trial: int) -> int:
        """Return what the random numbers of a trial depend on, on the scenario at that place."""
        return trial * MOST_DESIGNS + place if self.differs_by_design else trial

    def check(self) -> None:
        """Raise PresetError, one line, if its agent can't learn with its preset, or not on its scenarios."""
        if self.agent != SB3:
            check_exploration(self.spec, self.preset)
        check_parts(self.scenarios, self.preset)


def spec_of(agent: str, sees_choice: bool | None = None) -> AgentSpec:
    """Return the agent's spec; ``sees_choice`` is the single agent's, where it isn't None."""
    spec = AGENT_SPECS[agent]
    return spec if sees_choice is None or agent != "single" else replace(spec, sees_choice=sees_choice)
