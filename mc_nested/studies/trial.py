"""What came of each trial of a study, and the study's table of them: a row for each trial, or each greedy episode."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mc_nested.arena.design import kind_of_design
from mc_nested.arena.scenario import Scenario
from mc_nested.report.game_time import episodes_without_a_prior
from mc_nested.studies.arm import Arm
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import Evaluated, JobOutcome, RunOutcome
from mc_nested.studies.table import Table

Outcomes = Sequence[tuple[Job, JobOutcome]]
"""Every job of a finished study with its outcome."""


@dataclass(frozen=True)
class Trial:
    """One training of an arm on a scenario.

    ``networks`` and ``parameters`` are its own; ``seconds`` of computing are its share where others were trained at
    once.
    """

    arm: Arm
    scenario: Scenario
    number: int
    outcome: RunOutcome
    networks: int
    parameters: int
    seconds: float

    @property
    def scores(self) -> list[float]:
        """r_M of its greedy episodes."""
        return [each.score for each in self.outcome.evaluations]

    @property
    def best_score(self) -> float:
        """The highest of them."""
        return max(self.scores)

    @property
    def episodes_to_optimum(self) -> int | None:
        """Training episodes before the first greedy one at the optimum; None if there is none."""
        return next((row.episode for row in self.outcome.evaluations if row.score >= self.scenario.optimum), None)

    @property
    def played_to_optimum(self) -> int | None:
        """Episodes played until the first greedy one at the optimum, that and other greedy ones too; None: never."""
        for greedy, row in enumerate(self.outcome.evaluations, start=1):
            if row.score >= self.scenario.optimum:
                return row.episode + greedy
        return None


def trials_of(arms: Iterable[Arm], outcomes: Outcomes) -> list[Trial]:
    """Return the trials, arm by arm, scenario by scenario, however they were cut into jobs."""
    found = {
        (run.arm.name, run.scenario.name, run.trial): (of_run, outcome)
        for job, outcome in outcomes
        for run, of_run in zip(job.runs, outcome.runs, strict=True)
    }
    trials = []
    for arm in arms:
        for place, scenario in enumerate(arm.scenarios):
            for number in range(arm.trials):
                run, outcome = found[arm.name, scenario.name, arm.number_of(place, number)]
                costs = outcome.networks, outcome.parameters, outcome.seconds_of(run)
                trials.append(Trial(arm, scenario, number, run, *costs))
    return trials


def on_each(trials: Iterable[Trial]) -> dict[tuple[str, str], list[Trial]]:
    """Return the trials by arm and scenario, in their order."""
    found: dict[tuple[str, str], list[Trial]] = {}
    for trial in trials:
        found.setdefault((trial.arm.name, trial.scenario.name), []).append(trial)
    return found


def optimum_of(trials: Iterable[Trial]) -> dict[str, float]:
    """Return each scenario's highest score, in the order of the scenarios."""
    return {trial.scenario.name: trial.scenario.optimum for trial in trials}


OF_A_TRIAL: Mapping[str, Callable[[Trial], Any]] = {
    "agent": lambda trial: trial.arm.agent,
    "preset": lambda trial: trial.arm.short_preset,
    "scenario": lambda trial: trial.scenario.name,
    "design": lambda trial: trial.scenario.name,
    "trial": lambda trial: trial.number,
    "kind": lambda trial: kind_of_design(trial.scenario.design),
    "blocks": lambda trial: trial.scenario.blocks,
    "optimum": lambda trial: trial.scenario.optimum,
    "final_score": lambda trial: trial.outcome.score,
    "best_score": lambda trial: trial.best_score,
    "mean_score": lambda trial: sum(trial.scores) / len(trial.scores),
    "episodes_to_optimum": lambda trial: trial.episodes_to_optimum,
    "played_to_optimum": lambda trial: trial.played_to_optimum,
    "without_a_prior": lambda trial: without_a_prior(trial.scenario),
    "updates": lambda trial: trial.outcome.updates,
}
"""The columns of a table whose rows are trials; an arm's labels are columns, too."""

OF_A_GREEDY_EPISODE = tuple(Evaluated.model_fields)
"""The columns of a table whose rows are greedy episodes, beside those of their trial."""


def trial_table(trials: Iterable[Trial], columns: Sequence[str]) -> Table:
    """Return a row for each trial."""
    return Table(columns, [[_cell(trial, column) for column in columns] for trial in trials])


def greedy_table(trials: Iterable[Trial], columns: Sequence[str]) -> Table:
    """Return a row for each greedy episode of each trial."""
    return Table(
        columns,
        [
            [getattr(row, column) if column in OF_A_GREEDY_EPISODE else _cell(trial, column) for column in columns]
            for trial in trials
            for row in trial.outcome.evaluations
        ],
    )


def without_a_prior(scenario: Scenario) -> float:
    """Return how many episodes the scenario should take if no cell were likelier than another."""
    return round(episodes_without_a_prior(scenario.blocks, scenario.size), 2)


def _cell(trial: Trial, column: str) -> Any:
    labels = trial.arm.labels
    return labels[column] if column in labels else OF_A_TRIAL[column](trial)
