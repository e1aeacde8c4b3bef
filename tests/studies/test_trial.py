"""A study's trials from its jobs' outcomes, and the tables that are made of them."""

import pytest

from mc_nested.arena.design import MOST_DESIGNS
from mc_nested.studies.arm import Arm
from mc_nested.studies.config import config_of
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import Evaluated, JobOutcome, RunOutcome
from mc_nested.studies.trial import greedy_table, trial_table, trials_of
from tests.learn.made_experiments import BAR, DOT, small_preset
from tests.studies.made_trials import LINE, made_arm, made_trial

ARMS = [
    Arm(name, small_preset(), [DOT, BAR], 2, labels={"part": name}, differs_by_design=name == "b", together=1)
    for name in ("b", "a")
]


def outcome(job: Job) -> JobOutcome:
    """Return two greedy episodes; the score of the last is the trial's own number."""
    runs = []
    for number in job.trials:
        scores = [0.0, float(number)]
        rows = [Evaluated(episode=3 * at, score=score, material="stone", steps=4) for at, score in enumerate(scores)]
        runs.append(RunOutcome(evaluations=rows, score=scores[-1], updates=50, env_steps=9))
    return JobOutcome(identity="", networks=2, parameters=9, seconds=4.0, runs=runs)


def test_the_order_of_trials_does_not_depend_on_the_order_of_jobs() -> None:
    jobs = config_of("some", ARMS, trials=2, seed=0, jobs=3).cut()
    trials = trials_of(ARMS, [(job, outcome(job)) for job in reversed(jobs)])
    assert [(trial.arm.name, trial.scenario.name, trial.number) for trial in trials] == [
        (name, scenario, number) for name in ("b", "a") for scenario in ("dot", "bar") for number in (0, 1)
    ]
    assert [trial.outcome.score for trial in trials[:4]] == [0, MOST_DESIGNS, 1, MOST_DESIGNS + 1]
    assert [trial.outcome.score for trial in trials[4:]] == [0, 1, 0, 1]
    assert {trial.seconds for trial in trials} == {4.0}


@pytest.mark.parametrize(
    ("evaluations", "played"),
    [
        ([(10, 3.0), (20, 21.0), (30, 21.0)], 22),
        ([(0, 21.0)], 1),
        ([(10, 3.0), (10, 21.0)], 12),
        ([(10, 3.0), (20, 19.0)], None),
    ],
)
def test_played_to_optimum_counts_greedy_episodes_too(evaluations: list[tuple[int, float]], played: int | None) -> None:
    assert made_trial(made_arm("any"), LINE, 0, evaluations).played_to_optimum == played


def test_tables_have_a_row_per_trial_or_greedy_episode_and_columns_for_labels() -> None:
    arm = made_arm("images: numbers", labels={"agent": "numbers"})
    trials = [made_trial(arm, LINE, number, [(30, 2.0), (60, 4.0)]) for number in (0, 1)]
    assert trial_table(trials, ("agent", "trial", "mean_score", "best_score")).rows == [
        ["numbers", 0, 3.0, 4.0],
        ["numbers", 1, 3.0, 4.0],
    ]
    assert greedy_table(trials, ("agent", "trial", "episode", "score")).rows[:3] == [
        ["numbers", 0, 30, 2.0],
        ["numbers", 0, 60, 4.0],
        ["numbers", 1, 30, 2.0],
    ]
