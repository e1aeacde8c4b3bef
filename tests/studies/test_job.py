"""The cut of an experiment into jobs: every run once, work for every process, only what can train together mixed."""

from dataclasses import replace
from itertools import pairwise
from typing import Any

from hypothesis import given
from hypothesis import strategies as some

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import load_preset
from mc_nested.studies.arm import SB3, Arm, Run
from mc_nested.studies.job import Job, cut_into_jobs, side_by_side
from tests.learn.made_experiments import BAR, DOT, MATERIALS, runs_of, small_preset

PRESETS = [small_preset(10), small_preset(100)]
SCENARIOS = [DOT, BAR, replace(DOT, name="of one material", materials=MATERIALS[1:])]

SOME_RUNS = some.lists(
    some.builds(
        lambda agent, preset, scenario, trial: Run(Arm(agent, preset, (), 6, agent), scenario, trial),
        some.sampled_from(list(AGENT_SPECS)),
        some.sampled_from(PRESETS),
        some.sampled_from(SCENARIOS),
        some.integers(0, 5),
    ),
    min_size=1,
    max_size=40,
)


def changed(run: Run, **arm: Any) -> Run:
    return replace(run, arm=replace(run.arm, **arm))


def in_order(jobs: list[Job]) -> list[Run]:
    return [run for job in sorted(jobs, key=lambda job: job.name) for run in job.runs]


@given(SOME_RUNS, some.integers(1, 9))
def test_every_run_is_in_one_job_and_the_longest_job_comes_first(runs: list[Run], parts: int) -> None:
    jobs = cut_into_jobs(runs, parts, seed=0)
    assert in_order(jobs) == runs
    assert [job.work for job in jobs] == sorted((job.work for job in jobs), reverse=True)
    assert len({job.name for job in jobs}) == len(jobs)


@given(SOME_RUNS, some.integers(1, 9))
def test_a_job_has_one_agent_one_preset_and_one_number_of_materials(runs: list[Run], parts: int) -> None:
    for job in cut_into_jobs(runs, parts, seed=0):
        assert len({len(scenario.materials) for scenario in job.scenarios}) == 1
        assert {AGENT_SPECS[group] for group in job.groups} == {job.arm.spec}
    kinds = 1 + sum(
        (one.arm.spec, one.arm.preset, len(one.scenario.materials))
        != (two.arm.spec, two.arm.preset, len(two.scenario.materials))
        for one, two in pairwise(runs)
    )
    assert len(cut_into_jobs(runs, parts, seed=0)) <= kinds + parts - 1


@given(some.integers(1, 60), some.integers(1, 9))
def test_alike_runs_are_cut_evenly(trials: int, parts: int) -> None:
    jobs = cut_into_jobs(runs_of(["nested"], [DOT], trials, small_preset()), parts, seed=0)
    sizes = [len(job.trials) for job in jobs]
    assert max(sizes) - min(sizes) <= 1
    assert len(jobs) == min(parts, trials)


def test_the_papers_experiment_is_cut_into_four_jobs_for_two_cores() -> None:
    scenarios = [load_scenario(name) for name in ("line", "zigzag", "diamond")]
    jobs = cut_into_jobs(runs_of(list(AGENT_SPECS), scenarios, 10, load_preset("paper")), 2, seed=0)
    assert [(job.groups[0], len(job.trials)) for job in jobs] == [
        ("nested", 30),
        ("hierarchical", 19),
        ("single", 30),
        ("hierarchical", 11),
    ]


def test_one_hot_scenarios_train_together_only_with_equal_numbers_of_blocks() -> None:
    one_hot = small_preset().model_copy(update={"encoding": "one-hot"})
    scenarios = [load_scenario(name) for name in ("line", "zigzag", "diamond")]
    jobs = cut_into_jobs(runs_of(["nested"], scenarios, 2, one_hot), 1, seed=0)
    assert [[scenario.name for scenario in job.scenarios[::2]] for job in jobs] == [["line", "zigzag"], ["diamond"]]


def test_a_long_run_weighs_as_much_as_ten_short_ones() -> None:
    runs = runs_of(["nested"], [DOT], 10, small_preset(10)) + runs_of(["nested"], [DOT], 2, small_preset(100))
    assert [len(job.trials) for job in cut_into_jobs(runs, 3, seed=0)] == [10, 1, 1]


def test_jobs_that_differ_in_runs_preset_seed_or_agent_have_different_identities() -> None:
    runs = runs_of(["nested"], [DOT, BAR], 2, small_preset())
    shorter = runs_of(["nested"], [DOT, BAR], 2, small_preset(19))
    jobs = [
        cut_into_jobs(runs, 1, seed=0),
        cut_into_jobs(runs, 1, seed=1),
        cut_into_jobs(runs[1:], 1, seed=0),
        cut_into_jobs(shorter, 1, seed=0),
        cut_into_jobs([changed(run, agent="single") for run in runs], 1, seed=0),
    ]
    identities = [str(job.identity()) for (job,) in jobs]
    assert len(set(identities)) == len(identities)
    assert cut_into_jobs(runs, 1, seed=0)[0].identity() == jobs[0][0].identity()


def test_a_jobs_identity_includes_stop_at_optimum_and_the_library() -> None:
    (run,) = runs_of(["single"], [DOT], 1, small_preset())
    kinds = [run, changed(run, stop_at_optimum=True), changed(run, agent=SB3)]
    assert len({str(cut_into_jobs([each], 1, seed=0)[0].identity()) for each in kinds}) == 3


def test_runs_with_a_limit_are_cut_into_small_jobs_of_one_design() -> None:
    runs = [changed(run, together=2) for run in runs_of(["nested"], [DOT, BAR], 5, small_preset())]
    jobs = cut_into_jobs(runs, 7, seed=0)
    assert [(job.scenarios[0].name, job.trials) for job in jobs] == [
        ("dot", (0, 1)),
        ("dot", (2, 3)),
        ("bar", (0, 1)),
        ("bar", (2, 3)),
        ("dot", (4,)),
        ("bar", (4,)),
    ]


def test_a_long_run_with_a_later_turn_comes_after_a_short_one() -> None:
    short, long = (runs_of(["nested"], [DOT], 1, small_preset(episodes))[0] for episodes in (10, 100))
    jobs = cut_into_jobs([replace(changed(long, together=1), turn=1), changed(short, together=1)], 1, seed=0)
    assert [job.preset.episodes for job in jobs] == [10, 100]


def test_side_by_side_groups_runs_of_one_kind() -> None:
    one, other = (runs_of(["nested"], [DOT], 1, small_preset(episodes)) for episodes in (10, 100))
    assert side_by_side([*one, *other, *one]) == [*one, *one, *other]
