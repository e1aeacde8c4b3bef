"""An arm of a study, and its runs: trainings that are the same but for their design and their trial."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from mc_nested.arena.design import MOST_DESIGNS
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.agents import AGENT_SPECS, AgentSpec, check_exploration, check_parts
from mc_nested.learn.builders import Networks
from mc_nested.learn.dqn.engines import NUMBERS
from mc_nested.learn.preset import Preset

LIBRARY = "stable-baselines3"

SB3 = "sb3"
"""The name of stable-baselines3's agent (sb3.py)."""

AGENTS = (*AGENT_SPECS, SB3)
"""The agents that an arm can have, by name."""

IMAGE_WORK = 100
"""How much longer an episode seen as images takes."""


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
        builders: how many share an arena, spread along the scenario's start (builders.py); ``agent`` says nothing then.
        networks: how they learn.
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
    builders: int | None = None
    networks: Networks = "shared"
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

    @property
    def library(self) -> str | None:
        """Whose algorithm trains it; None for this project's agents."""
        return LIBRARY if self.agent == SB3 else None

    def runs(self) -> list["Run"]:
        """Return its trainings, scenario by scenario, trial by trial."""
        alone = replace(self, scenarios=())  # a worker is sent its own scenarios, not all
        return [
            Run(alone, scenario, self.number_of(place, trial), place if self.differs_by_design else 0)
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


@dataclass(frozen=True)
class Run:
    """One training of an arm.

    Args:
        arm: how it is trained; its scenarios aren't there.
        scenario: what it builds.
        trial: its number, which its random numbers depend on (streams.py).
        turn: its job begins after those of a lower one.
    """

    arm: Arm
    scenario: Scenario
    trial: int
    turn: int = 0

    @property
    def work(self) -> int:
        """How long it takes, relative to others: per episode, each network takes about as long as everything else.

        Ten trials of the paper's experiment took 6.6 seconds per run of the nested agent, 10.0 of the hierarchical and
        4.6 of the single one. An image takes some hundred times as long as numbers.
        """
        spec, preset = self.arm.spec, self.arm.preset
        networks = spec.has_main + (len(self.scenario.materials) if spec.low_level_per_material else 1)
        image = 1 if preset.states == NUMBERS else IMAGE_WORK
        return preset.episodes * (1 + networks) * (self.arm.builders or 1) * image


def spec_of(agent: str, sees_choice: bool | None = None) -> AgentSpec:
    """Return the agent's spec; ``sees_choice`` is the single agent's, where it isn't None."""
    spec = AGENT_SPECS[agent]
    return spec if sees_choice is None or agent != "single" else replace(spec, sees_choice=sees_choice)
