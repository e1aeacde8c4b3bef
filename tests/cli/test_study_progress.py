"""The one view of all that trains, on a terminal and where there is none."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from mc_nested.cli import study_progress as progress_module
from mc_nested.cli.study_progress import StudyProgress
from mc_nested.cli.study_status import StudyStatus
from mc_nested.workers.messages import JobReport
from tests.learn.made_experiments import BAR, DOT, one_job

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


def test_without_a_terminal_there_is_a_line_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
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


def test_of_many_designs_only_the_trials_are_counted() -> None:
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
