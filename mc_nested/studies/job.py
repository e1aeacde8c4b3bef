"""A study's runs, divided into jobs that each train as one batch, so that every process has work.

What a run learns depends on its seed and its trial, not on its batch: the division changes nothing but the time.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import accumulate, groupby
from typing import Any

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import table_of
from mc_nested.learn.agents import AgentSpec
from mc_nested.learn.builders import Networks
from mc_nested.learn.dqn.engines import NUMBERS
from mc_nested.learn.preset import Preset


@dataclass(frozen=True)
class JobBuilders:
    """Several builders in one arena, spread along the scenario's start, and how they learn (builders.py)."""

    count: int
    networks: Networks


IMAGE_WORK = 100
"""How much longer an episode seen as images takes."""


@dataclass(frozen=True)
class Run:
    """One training of a study.

    Args:
        group: what its results count for: an arm's name.
        spec: which agent.
        preset: its hyper-parameters.
        scenario: what it builds.
        trial: its number, which its random numbers depend on (streams.py).
        stop_at_optimum: whether it ends at its first greedy episode at the optimum.
        library: whose algorithm trains it; None for this project's agents.
        builders: where several share an arena; ``spec`` says nothing then.
        together: how many trials of a group on a scenario are one job at most; None for as many as fit.
        turn: its job begins after those of a lower one.
    """

    group: str
    spec: AgentSpec
    preset: Preset
    scenario: Scenario
    trial: int
    stop_at_optimum: bool = False
    library: str | None = None
    builders: JobBuilders | None = None
    together: int | None = None
    turn: int = 0

    @property
    def work(self) -> int:
        """How long it takes, relative to others: per episode, each network takes about as long as everything else.

        Ten trials of the paper's experiment took 6.6 seconds per run of the nested agent, 10.0 of the hierarchical and
        4.6 of the single one. An image takes some hundred times as long as numbers.
        """
        networks = self.spec.has_main + (len(self.scenario.materials) if self.spec.low_level_per_material else 1)
        builders = self.builders.count if self.builders else 1
        return self.preset.episodes * (1 + networks) * builders * (1 if self.preset.states == NUMBERS else IMAGE_WORK)


@dataclass(frozen=True)
class Job:
    """Runs of one agent with one preset that train as one batch; where they differ there is a tuple (runs,).

    The other fields are those of a run; ``work`` is that of all its runs.
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
    builders: JobBuilders | None = None
    work: int = 0

    @property
    def episodes(self) -> int:
        """Training episodes of all its runs."""
        return self.preset.episodes * len(self.trials)

    def identity(self) -> dict[str, Any]:
        """Return what is trained; a checkpoint fits only the same identity."""
        return {
            "spec": asdict(self.spec),
            "preset": self.preset.model_dump(exclude={"device"}),
            "groups": list(self.groups),
            "scenarios": [table_of(scenario).model_dump() for scenario in self.scenarios],
            "trials": list(self.trials),
            "seed": self.seed,
            "stop_at_optimum": self.stop_at_optimum,
            "library": self.library,
            "builders": asdict(self.builders) if self.builders else None,
        }


def side_by_side(runs: Sequence[Run]) -> list[Run]:
    """Return the runs in their order, but those of one agent and preset adjacent."""
    kinds: list[tuple[AgentSpec, Preset]] = []
    for run in runs:
        if (run.spec, run.preset) not in kinds:
            kinds.append((run.spec, run.preset))
    return sorted(runs, key=lambda run: kinds.index((run.spec, run.preset)))


def cut_into_jobs(runs: Sequence[Run], parts: int, seed: int) -> list[Job]:
    """Divide the runs into jobs: some trials of a design each where a run says so, all others into equal parts.

    Runs of a part that can train together are one job. The longest jobs come first: if each process takes the next job
    when it is free, all have work until the end. But a run's ``turn`` comes before its length.
    """
    batches = _of_few_trials([run for run in runs if run.together is not None])
    if free := [run for run in runs if run.together is None]:
        batches += [list(batch) for part in _in_parts(free, parts) for _, batch in groupby(part, _kind)]
    jobs = [_job(f"{number:03d}", batch, seed) for number, batch in enumerate(batches)]
    turns = {job.name: batch[0].turn for job, batch in zip(jobs, batches, strict=True)}
    return sorted(jobs, key=lambda job: (turns[job.name], -job.work))


def _of_few_trials(runs: Sequence[Run]) -> list[list[Run]]:
    """Return jobs of one group and scenario each, of as many trials as train together."""
    jobs = []
    for _, alike in groupby(runs, lambda run: (run.group, run.scenario.name)):
        own = list(alike)
        most = own[0].together or len(own)
        jobs += [own[first : first + most] for first in range(0, len(own), most)]
    return jobs


def _in_parts(runs: Sequence[Run], parts: int) -> list[list[Run]]:
    """Put each run into the part that contains the middle of its work."""
    work = [run.work for run in runs]
    ends = list(accumulate(work))
    shared: list[list[Run]] = [[] for _ in range(parts)]
    for run, own, end in zip(runs, work, ends, strict=True):
        twice_the_middle = 2 * end - own
        shared[twice_the_middle * parts // (2 * ends[-1])].append(run)
    return shared


def _kind(run: Run) -> tuple[object, ...]:
    """Return what runs must have in common to be one batch: their networks have one shape, as in a batch of one.

    There is an output for each material of a choice; with one-hot, an input for each number of blocks left; an image is
    as large as its arena.
    """
    one_hot_blocks = run.scenario.blocks if run.preset.encoding == "one-hot" else 0
    side = run.scenario.size if run.preset.states != NUMBERS else 0
    trained_by = run.stop_at_optimum, run.library, run.builders
    return run.spec, run.preset, *trained_by, len(run.scenario.materials), one_hot_blocks, side


def _job(name: str, runs: Sequence[Run], seed: int) -> Job:
    return Job(
        name=name,
        spec=runs[0].spec,
        preset=runs[0].preset,
        groups=tuple(run.group for run in runs),
        scenarios=tuple(run.scenario for run in runs),
        trials=tuple(run.trial for run in runs),
        seed=seed,
        stop_at_optimum=runs[0].stop_at_optimum,
        library=runs[0].library,
        builders=runs[0].builders,
        work=sum(run.work for run in runs),
    )
