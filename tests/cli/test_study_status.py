"""How far an experiment is, from what its processes report."""

from mc_nested.cli.study_status import StudyStatus
from mc_nested.studies.job import Job, cut_into_jobs
from mc_nested.studies.outcome import Evaluated, JobOutcome, RunOutcome
from mc_nested.workers.messages import JobEnded, JobReport
from tests.learn.made_experiments import BAR, DOT, runs_of, small_preset


def two_jobs() -> list[Job]:
    """Of two trials on the dot and on the bar each, 20 episodes a run: nested in the first, single in the second."""
    return cut_into_jobs(runs_of(["nested", "single"], [DOT, BAR], 2, small_preset(20)), 1, seed=0)


def outcome(score: float) -> JobOutcome:
    last = Evaluated(episode=20, score=score, material="stone", steps=3)
    run = RunOutcome(evaluations=[last], score=score, updates=1, env_steps=1)
    return JobOutcome(identity="", networks=1, parameters=1, seconds=1, runs=[run] * 4)


def test_at_first_nothing_is_done() -> None:
    status = StudyStatus([(job, None) for job in two_jobs()])
    assert (status.episodes, status.total, status.updates) == (0, 160, 0)
    assert status.optimum == {"dot": 11.0, "bar": 13.0}
    assert status.score("nested", "dot") is None


def test_reports_add_up() -> None:
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


def test_what_was_done_before_counts_as_done_and_not_as_speed() -> None:
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
