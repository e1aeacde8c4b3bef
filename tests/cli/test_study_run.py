"""How many processes train a study, and the view of how far they are, on a terminal and where there is none."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from mc_nested.cli import study_run as progress_module
from mc_nested.cli.study_run import MOST_JOBS, StudyProgress, StudyStatus, cores
from mc_nested.studies.job import Job, cut_into_jobs
from mc_nested.studies.outcome import Evaluated, JobOutcome, RunOutcome
from mc_nested.workers.executor import JobEnded, JobReport
from tests.learn.made_experiments import BAR, DOT, one_job, runs_of, small_preset


def test_number_of_cores_is_at_least_one_and_at_most_the_limit() -> None:
    assert 1 <= cores() <= MOST_JOBS


JOB = one_job("nested", [DOT, BAR], 2)
HALF = JobReport(JOB.name, [10, 10, 10, 10], (11.0, 10.0, None, 12.0), updates=100)


def test_a_terminal_shows_scores_beside_the_optimum() -> None:
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=True, width=120)
    with StudyProgress("reproduce", StudyStatus([(JOB, None)]), console) as progress:
        progress.watch(HALF)
    shown = screen.getvalue()
    for words in ("reproduce", "50 %", "updates/s", "dot of 11", "bar of 13", "nested", "10.5", "12.0"):
        assert words in shown


def test_without_a_terminal_study_progress_is_a_line_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress_module, "LINE_EVERY_S", 0.0)
    log = io.StringIO()
    with StudyProgress("sweep", StudyStatus([(JOB, None)]), Console(file=log, width=40)) as progress:
        progress.watch(HALF)
        progress.watch(None)
    lines = log.getvalue().splitlines()
    assert len(lines) == 2
    assert all(line.startswith("sweep: 50 % of 80 episodes  ") for line in lines)


def test_without_a_terminal_a_short_experiment_says_nothing() -> None:
    log = io.StringIO()
    with StudyProgress("sweep", StudyStatus([(JOB, None)]), Console(file=log)) as progress:
        progress.watch(HALF)
    assert log.getvalue() == ""


def test_progress_of_many_designs_counts_trials_instead_of_naming_designs() -> None:
    scenarios = [replace(DOT, name=f"design {number}") for number in range(9)]
    job = one_job("nested", scenarios, 1)
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=True, width=80)
    with StudyProgress("benchmark", StudyStatus([(job, None)]), console) as progress:
        progress.watch(JobReport(job.name, [10] * 9, (11.0,) * 4 + (2.0,) * 5, updates=100))
    shown = screen.getvalue()
    assert "design 3" not in shown
    for words in ("at the optimum", "0 of 9", " 4 "):
        assert words in shown


def two_jobs() -> list[Job]:
    """Return two jobs, nested and single, of two trials each on the dot and on the bar, 20 episodes a run."""
    return cut_into_jobs(runs_of(["nested", "single"], [DOT, BAR], 2, small_preset(20)), 1, seed=0)


def outcome(score: float) -> JobOutcome:
    last = Evaluated(episode=20, score=score, material="stone", steps=3)
    run = RunOutcome(evaluations=[last], score=score, updates=1, env_steps=1)
    return JobOutcome(identity="", networks=1, parameters=1, seconds=1, runs=[run] * 4)


def test_a_new_status_has_nothing_done() -> None:
    status = StudyStatus([(job, None) for job in two_jobs()])
    assert (status.episodes, status.total, status.updates) == (0, 160, 0)
    assert status.optimum == {"dot": 11.0, "bar": 13.0}
    assert status.score("nested", "dot") is None


def test_reports_of_all_processes_are_added_up() -> None:
    nested, single = two_jobs()
    status = StudyStatus([(nested, None), (single, None)])
    status.hear(JobReport(nested.name, [5, 6, 7, 8], (11.0, 10.0, None, 12.0), updates=100))
    status.hear(JobReport(nested.name, [6, 6, 7, 8], (11.0, 10.0, None, 12.0), updates=150))
    status.hear(JobReport(single.name, [1, 1, 1, 1], (None, None, None, None), updates=40))
    assert status.episodes == 27 + 4
    assert status.score("nested", "dot") == 10.5
    assert status.score("nested", "bar") == 12.0
    assert status.score("single", "bar") is None
    assert status.groups == ["nested", "single"]
    status.hear(JobEnded(nested.name, finished=True))
    assert status.episodes == 80 + 4


def test_episodes_done_before_this_start_count_as_done_but_not_as_speed() -> None:
    nested, single = two_jobs()
    status = StudyStatus([(nested, outcome(9.0)), (single, None)])
    assert status.episodes == 80
    assert status.score("nested", "bar") == 9.0
    status.hear(JobReport(single.name, [10, 10, 10, 10], (None, None, None, None), updates=5000))
    assert (status.episodes, status.episodes_before, status.updates) == (120, 120, 0)
    status.hear(JobReport(single.name, [11, 11, 11, 11], (None, None, None, None), updates=5300))
    assert (status.episodes, status.episodes_before, status.updates) == (124, 120, 300)


def test_runs_that_have_ended_and_are_at_the_optimum_are_counted() -> None:
    nested, single = two_jobs()
    status = StudyStatus([(nested, outcome(11.0)), (single, None)])
    # The dot's optimum is 11, the bar's 13: two trials on each.
    assert (status.ended("nested"), status.at_optimum("nested")) == ((4, 4), 2)
    assert (status.ended("single"), status.at_optimum("single")) == ((0, 4), 0)
    status.hear(JobReport(single.name, [9, 9, 9, 9], (10.0, 11.0, 13.0, None), updates=1))
    assert (status.ended("single"), status.at_optimum("single")) == ((0, 4), 2)
    status.hear(JobEnded(single.name, finished=True))
    assert status.ended("single") == (4, 4)
