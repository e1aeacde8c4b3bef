"""A benchmark: every contestant, an agent with a preset, on every design of a corpus; a trial ends at the optimum."""

from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from mc_nested.arena.corpus_file import MOST_DESIGNS
from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.arena.scenario_file import ScenarioTable, scenario_of
from mc_nested.errors import PresetError, RunError, UserError
from mc_nested.learn.agents import AGENT_SPECS, check_exploration
from mc_nested.learn.experiments.experiment_folder import ExperimentConfig
from mc_nested.learn.experiments.jobs import Job
from mc_nested.learn.experiments.sb3_model import LIBRARY
from mc_nested.learn.preset import Preset, parse_preset

SB3, SB3_PRESET = "sb3", "dqn"
"""The name of stable-baselines3's agent, and of what stands for a preset beside it (baseline.toml)."""

AGENTS = (*AGENT_SPECS, SB3)
"""The agents that can take part, by name."""

BASELINE = "baseline.toml"


def _known(name: str) -> str:
    if name not in AGENTS:
        raise ValueError(f"must be one of {', '.join(AGENTS)}")
    return name


class Contestant(BaseModel):
    """An agent with a preset, complete: no other file is needed."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    agent: Annotated[str, AfterValidator(_known)]
    preset_name: str
    preset: Preset

    @property
    def short_preset(self) -> str:
        """The preset's name without a folder and an ending."""
        return Path(self.preset_name).stem

    @property
    def name(self) -> str:
        """A name that no other contestant of a benchmark has."""
        return f"{self.agent}, {self.short_preset}"


class BenchmarkConfig(ExperimentConfig):
    """A benchmark; ``corpus`` is the file that its designs came from, None if they were drawn from the seed."""

    corpus: str | None = None
    designs: Annotated[list[ScenarioTable], Field(min_length=1, max_length=MOST_DESIGNS)]
    contestants: Annotated[list[Contestant], Field(min_length=1)]

    def loaded_designs(self) -> list[Scenario]:
        """The designs; RunError if two have the same name, ScenarioError if one can't be built."""
        _check_different([table.name for table in self.designs], "designs")
        return [scenario_of(table, table.name) for table in self.designs]

    def cut(self) -> list[Job]:
        """A job for each contestant on each design, design by design, so that what is left takes as long as before.

        stable-baselines3 trains each trial in a job of its own.
        """
        designs = self.loaded_designs()
        _check_different([contestant.name for contestant in self.contestants], "contestants")
        jobs: list[Job] = []
        for number, design in enumerate(designs):
            runs = [run_number(number, trial) for trial in range(self.trials)]
            for contestant in self.contestants:
                together = [[run] for run in runs] if contestant.agent == SB3 else [runs]
                jobs += [self._job(f"{len(jobs) + k:05d}", contestant, design, own) for k, own in enumerate(together)]
        return jobs

    def _job(self, name: str, contestant: Contestant, design: Scenario, runs: Sequence[int]) -> Job:
        is_sb3 = contestant.agent == SB3
        return Job(
            name=name,
            spec=AGENT_SPECS["single" if is_sb3 else contestant.agent],
            preset=contestant.preset,
            groups=(contestant.name,) * len(runs),
            scenarios=(design,) * len(runs),
            trials=tuple(runs),
            seed=self.seed,
            stop_at_optimum=True,
            library=LIBRARY if is_sb3 else None,
        )


def run_number(design: int, trial: int) -> int:
    """What a run's random numbers depend on: its design's number, too, or one lucky network would be lucky on all."""
    return trial * MOST_DESIGNS + design


def trial_of(run: int) -> int:
    """The trial of a run's number."""
    return run // MOST_DESIGNS


def baseline() -> Contestant:
    """stable-baselines3's DQN."""
    text = (resources.files("mc_nested.learn.experiments") / BASELINE).read_text("utf-8")
    return Contestant(agent=SB3, preset_name=SB3_PRESET, preset=parse_preset(text, BASELINE))


def contestants_of(agents: Sequence[str], presets: Sequence[tuple[str, Preset]]) -> tuple[list[Contestant], list[str]]:
    """Every agent with every preset that it can take, sb3 with its own; and a line for each that it can't take.

    UserError if an agent can take none of them.
    """
    found: list[Contestant] = []
    left_out: list[str] = []
    for agent in agents:
        if agent == SB3:
            found.append(baseline())
            continue
        reasons = {name: _reason_against(agent, preset) for name, preset in presets}
        if all(reasons.values()):
            raise UserError(f"{agent} can't take {' or '.join(reasons)}: {next(iter(reasons.values()))}")
        found += [
            Contestant(agent=agent, preset_name=name, preset=preset) for name, preset in presets if not reasons[name]
        ]
        left_out += [f"{agent} with {name} is left out: {reason}" for name, reason in reasons.items() if reason]
    return found, left_out


def _reason_against(agent: str, preset: Preset) -> str:
    """Why the agent can't take the preset; empty if it can."""
    try:
        check_exploration(AGENT_SPECS[agent], preset)
    except PresetError as error:
        return str(error)
    return ""


def episodes_without_a_prior(blocks: int, size: int = DEFAULT_SIZE) -> float:
    """How many episodes a design of so many blocks should take if no cell is likelier than another.

    The blocks stand on n of the N = size x (size - 1) cells where one can land. Tested in any order, the last of them
    is expected at test (N + 1) n / (n + 1). An episode tests n cells, and one more builds them all.
    """
    cells = size * (size - 1)
    return (cells + 1) / (blocks + 1) + 1


def _check_different(names: Sequence[str], what: str) -> None:
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise RunError(f"two {what} are named {twice!r}: name it once, or rename a file")
