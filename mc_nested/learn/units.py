"""How an experiment's runs are shared out: units of runs that train as one batch, cut so that every process has work.

What a run learns depends on its seed and its trial, not on what trains beside it: a cut changes nothing but the time.
"""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from itertools import accumulate, groupby
from typing import Any

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import table_of
from mc_nested.learn.agents import Form
from mc_nested.learn.preset import Preset


@dataclass(frozen=True)
class Run:
    """One training of an experiment.

    Args:
        group: what it counts as: an agent's name, or a variant's.
        form: which agent.
        preset: its hyper-parameters.
        scenario: what it builds.
        trial: its number, by which it draws its random numbers (streams.py).
    """

    group: str
    form: Form
    preset: Preset
    scenario: Scenario
    trial: int


@dataclass(frozen=True)
class Unit:
    """Runs of one agent with one preset that train as one batch; what they differ in is a tuple (runs,)."""

    name: str
    form: Form
    preset: Preset
    groups: tuple[str, ...]
    scenarios: tuple[Scenario, ...]
    trials: tuple[int, ...]
    seed: int

    @property
    def episodes(self) -> int:
        """Training episodes of all its runs."""
        return self.preset.episodes * len(self.trials)

    @property
    def work(self) -> int:
        """How long it takes, beside another unit."""
        return sum(work_of(self.form, self.preset, scenario) for scenario in self.scenarios)

    def identity(self) -> dict[str, Any]:
        """What its checkpoint belongs to."""
        return {
            "form": asdict(self.form),
            "preset": self.preset.model_dump(),
            "groups": list(self.groups),
            "scenarios": [table_of(scenario).model_dump() for scenario in self.scenarios],
            "trials": list(self.trials),
            "seed": self.seed,
        }


def work_of(form: Form, preset: Preset, scenario: Scenario) -> int:
    """How long a run takes, beside another: its episodes, and each of its networks about as much as all the rest.

    Ten trials of the paper's experiment took 6.6 seconds a run of the nested agent, 10.0 of the hierarchical and 4.6 of
    the single one.
    """
    networks = form.has_main + (len(scenario.materials) if form.one_low_a_material else 1)
    return preset.episodes * (1 + networks)


def cut_into_units(runs: Sequence[Run], parts: int, seed: int) -> list[Unit]:
    """Units with every run in one of them, cut where the runs, in their order, fall into parts of alike much work.

    Runs that can train together and aren't cut apart are one unit. The units that take longest come first: a process
    that takes the next one whenever it is free then has work until the end.
    """
    shared = _in_parts(runs, parts)
    units = [
        _unit(f"{number:03d}", batch, seed)
        for number, batch in enumerate(batch for part in shared for batch in _batches(part))
    ]
    return sorted(units, key=lambda unit: -unit.work)


def _in_parts(runs: Sequence[Run], parts: int) -> list[list[Run]]:
    """Each run is in the part in which the middle of its work lies."""
    work = [work_of(run.form, run.preset, run.scenario) for run in runs]
    ends = list(accumulate(work))
    shared: list[list[Run]] = [[] for _ in range(parts)]
    for run, own, end in zip(runs, work, ends, strict=True):
        twice_the_middle = 2 * end - own
        shared[twice_the_middle * parts // (2 * ends[-1])].append(run)
    return shared


def _batches(runs: Iterable[Run]) -> list[list[Run]]:
    return [list(batch) for _, batch in groupby(runs, _kind)]


def _kind(run: Run) -> tuple[Form, Preset, int, int]:
    """What runs must have in common to be one batch: their networks are of one shape, the one each would have alone.

    There is an output for each material of a choice; and one-hot, an input for each number of blocks left.
    """
    one_hot_blocks = run.scenario.blocks if run.preset.encoding == "one-hot" else 0
    return run.form, run.preset, len(run.scenario.materials), one_hot_blocks


def _unit(name: str, runs: Sequence[Run], seed: int) -> Unit:
    return Unit(
        name=name,
        form=runs[0].form,
        preset=runs[0].preset,
        groups=tuple(run.group for run in runs),
        scenarios=tuple(run.scenario for run in runs),
        trials=tuple(run.trial for run in runs),
        seed=seed,
    )
