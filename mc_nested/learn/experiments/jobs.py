"""An experiment's runs, divided into jobs that each train as one batch, so that every process has work.

What a run learns depends on its seed and its trial, not on its batch: the division changes nothing but the time.
"""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from itertools import accumulate, groupby
from typing import Any

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import table_of
from mc_nested.learn.agents import AgentSpec
from mc_nested.learn.cooperation.team_agent import Kind
from mc_nested.learn.engine_fit import NUMBERS
from mc_nested.learn.preset import Preset


@dataclass(frozen=True)
class Builders:
    """Several builders in one arena, spread along the scenario's start, and how they learn (team_agent.py)."""

    count: int
    networks: Kind


PLANNER = "planner"
"""The ``library`` of a job that a script plays, without any network (planner.py)."""


@dataclass(frozen=True)
class Run:
    """One training of an experiment.

    Args:
        group: what its results count for: an agent's name, or a variant's.
        spec: which agent.
        preset: its hyper-parameters.
        scenario: what it builds.
        trial: its number, which its random numbers depend on (streams.py).
    """

    group: str
    spec: AgentSpec
    preset: Preset
    scenario: Scenario
    trial: int


@dataclass(frozen=True)
class Job:
    """Runs of one agent with one preset that train as one batch; where they differ there is a tuple (runs,).

    ``stop_at_optimum``: a run ends at its first greedy episode at its scenario's optimum. ``library``: whose algorithm
    trains it, or that a script plays it (PLANNER); None for this project's agents. ``builders``: where several share
    an arena; ``spec`` says nothing then.
    """

    name: str
    spec: AgentSpec
    preset: Preset
    groups: tuple[str, ...]
    scenarios: tuple[Scenario, ...]
    trials: tuple[int, ...]
    seed: int
    stop_at_optimum: bool = False
    library: str | None = None
    builders: Builders | None = None

    @property
    def episodes(self) -> int:
        """Training episodes of all its runs."""
        return self.preset.episodes * len(self.trials)

    @property
    def work(self) -> int:
        """How long it takes, relative to other jobs."""
        return sum(work_of(self.spec, self.preset, scenario) for scenario in self.scenarios)

    def identity(self) -> dict[str, Any]:
        """What is trained; a checkpoint fits only the same identity."""
        return {
            "spec": asdict(self.spec),
            "preset": self.preset.model_dump(exclude={"device"}),
            "groups": list(self.groups),
            "scenarios": [table_of(scenario).model_dump() for scenario in self.scenarios],
            "trials": list(self.trials),
            "seed": self.seed,
            "stop_at_optimum": self.stop_at_optimum,
            "library": self.library,
            "builders": self.builders and asdict(self.builders),
        }


def work_of(spec: AgentSpec, preset: Preset, scenario: Scenario) -> int:
    """How long a run takes, relative to others: per episode, each network takes about as long as everything else.

    Ten trials of the paper's experiment took 6.6 seconds per run of the nested agent, 10.0 of the hierarchical and 4.6
    of the single one.
    """
    networks = spec.has_main + (len(scenario.materials) if spec.low_level_per_material else 1)
    return preset.episodes * (1 + networks)


def cut_into_jobs(runs: Sequence[Run], parts: int, seed: int) -> list[Job]:
    """Divide the runs, in their order, into parts of about equal work, and each part into jobs.

    Runs of a part that can train together are one job. The longest jobs come first: if each process takes the next job
    when it is free, all have work until the end.
    """
    shared = _in_parts(runs, parts)
    jobs = [
        _job(f"{number:03d}", batch, seed)
        for number, batch in enumerate(batch for part in shared for batch in _batches(part))
    ]
    return sorted(jobs, key=lambda job: -job.work)


def _in_parts(runs: Sequence[Run], parts: int) -> list[list[Run]]:
    """Each run is in the part that contains the middle of its work."""
    work = [work_of(run.spec, run.preset, run.scenario) for run in runs]
    ends = list(accumulate(work))
    shared: list[list[Run]] = [[] for _ in range(parts)]
    for run, own, end in zip(runs, work, ends, strict=True):
        twice_the_middle = 2 * end - own
        shared[twice_the_middle * parts // (2 * ends[-1])].append(run)
    return shared


def _batches(runs: Iterable[Run]) -> list[list[Run]]:
    return [list(batch) for _, batch in groupby(runs, _kind)]


def _kind(run: Run) -> tuple[AgentSpec, Preset, int, int, int]:
    """What runs must have in common to be one batch: their networks have one shape, the same as in a batch of one.

    There is an output for each material of a choice; with one-hot, an input for each number of blocks left; an image is
    as large as its arena.
    """
    one_hot_blocks = run.scenario.blocks if run.preset.encoding == "one-hot" else 0
    side = run.scenario.size if run.preset.states != NUMBERS else 0
    return run.spec, run.preset, len(run.scenario.materials), one_hot_blocks, side


def _job(name: str, runs: Sequence[Run], seed: int) -> Job:
    return Job(
        name=name,
        spec=runs[0].spec,
        preset=runs[0].preset,
        groups=tuple(run.group for run in runs),
        scenarios=tuple(run.scenario for run in runs),
        trials=tuple(run.trial for run in runs),
        seed=seed,
    )
