"""A study's runs, divided into jobs that each train as one batch, so that every process has work.

What a run learns depends on its seed and its trial, not on its batch: the division changes nothing but the time.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import accumulate, groupby
from typing import Any

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import table_of
from mc_nested.learn.dqn.engines import NUMBERS
from mc_nested.learn.preset import Preset
from mc_nested.studies.arm import Arm, Run


@dataclass(frozen=True)
class Job:
    """Runs that train as one batch; what differs between them is there as a tuple (runs,), too."""

    name: str
    runs: tuple[Run, ...]
    seed: int

    @property
    def arm(self) -> Arm:
        """How all of them are trained: the first one's arm, or one like it."""
        return self.runs[0].arm

    @property
    def preset(self) -> Preset:
        """The hyper-parameters of all."""
        return self.arm.preset

    @property
    def groups(self) -> tuple[str, ...]:
        """The arms that they count for."""
        return tuple(run.arm.name for run in self.runs)

    @property
    def scenarios(self) -> tuple[Scenario, ...]:
        """What they build."""
        return tuple(run.scenario for run in self.runs)

    @property
    def trials(self) -> tuple[int, ...]:
        """Their numbers."""
        return tuple(run.trial for run in self.runs)

    @property
    def work(self) -> int:
        """How long all of them take, relative to other jobs."""
        return sum(run.work for run in self.runs)

    @property
    def episodes(self) -> int:
        """Training episodes of all of them."""
        return self.preset.episodes * len(self.runs)

    def identity(self) -> dict[str, Any]:
        """Return what is trained; a checkpoint fits only the same identity."""
        arm = self.arm
        return {
            "spec": asdict(arm.spec),
            "preset": arm.preset.model_dump(exclude={"device"}),
            "groups": list(self.groups),
            "scenarios": [table_of(scenario).model_dump() for scenario in self.scenarios],
            "trials": list(self.trials),
            "seed": self.seed,
            "stop_at_optimum": arm.stop_at_optimum,
            "library": arm.library,
            "builders": {"count": arm.builders, "networks": arm.networks} if arm.builders else None,
        }


def side_by_side(runs: Sequence[Run]) -> list[Run]:
    """Return the runs in their order, but those of one agent and preset adjacent."""
    kinds: list[tuple[object, object]] = []
    for run in runs:
        if (run.arm.spec, run.arm.preset) not in kinds:
            kinds.append((run.arm.spec, run.arm.preset))
    return sorted(runs, key=lambda run: kinds.index((run.arm.spec, run.arm.preset)))


def cut_into_jobs(runs: Sequence[Run], parts: int, seed: int) -> list[Job]:
    """Divide the runs into jobs: some trials of a design each where a run says so, all others into equal parts.

    Runs of a part that can train together are one job. The longest jobs come first: if each process takes the next job
    when it is free, all have work until the end. But a run's ``turn`` comes before its length.
    """
    batches = _of_few_trials([run for run in runs if run.arm.together is not None])
    if free := [run for run in runs if run.arm.together is None]:
        batches += [list(batch) for part in _in_parts(free, parts) for _, batch in groupby(part, _kind)]
    jobs = [Job(f"{number:03d}", tuple(batch), seed) for number, batch in enumerate(batches)]
    return sorted(jobs, key=lambda job: (job.runs[0].turn, -job.work))


def _of_few_trials(runs: Sequence[Run]) -> list[list[Run]]:
    """Return jobs of one group and scenario each, of as many trials as train together."""
    jobs = []
    for _, alike in groupby(runs, lambda run: (run.arm.name, run.scenario.name)):
        own = list(alike)
        most = own[0].arm.together or len(own)
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
    arm, preset = run.arm, run.arm.preset
    one_hot_blocks = run.scenario.blocks if preset.encoding == "one-hot" else 0
    side = run.scenario.size if preset.states != NUMBERS else 0
    trained_by = arm.stop_at_optimum, arm.library, arm.builders, arm.networks
    return arm.spec, preset, *trained_by, len(run.scenario.materials), one_hot_blocks, side
