"""A benchmark's contestants and jobs, and the episodes that a design should take without a prior."""

import itertools
from pathlib import Path

import pytest

from mc_nested.arena.design import MOST_DESIGNS
from mc_nested.errors import RunError, UserError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.report.game_time import episodes_without_a_prior
from mc_nested.studies.arm import AGENTS, SB3, Arm, Run
from mc_nested.studies.benchmark import baseline, contestants_of
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.job import Job
from mc_nested.studies.job_training import JobTraining, agents_trainer
from mc_nested.studies.outcome import outcome_of
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, DOT, small_preset

PAPER, TUNED = ("paper", load_preset("paper")), ("tuned", load_preset("tuned"))


def contestant(agent: str, preset_name: str, preset: Preset, trials: int = 2) -> Arm:
    """Return a contestant as ``arms`` makes it, on two designs."""
    return Arm(
        name=f"{agent}, {preset_name}",
        agent=agent,
        preset=preset,
        preset_name=preset_name,
        scenarios=[DOT, BAR],
        trials=trials,
        stop_at_optimum=True,
        differs_by_design=True,
        together=1 if agent == SB3 else trials,
    )


def contestants(trials: int = 2) -> list[Arm]:
    return [contestant("nested", "small", small_preset(), trials), contestant(SB3, "dqn", baseline(), trials)]


def config(trials: int = 2) -> StudyConfig:
    return config_of("benchmark", contestants(trials), trials=trials, seed=3, jobs=2)


def trial_of(run: int) -> int:
    """Return the trial of a run's number."""
    return run // MOST_DESIGNS


def test_jobs_come_design_by_design_and_sb3_trains_each_trial_alone() -> None:
    jobs = config().cut()
    found = [
        (job.groups[0], job.scenarios[0].name, [trial_of(run) for run in job.trials], job.arm.library) for job in jobs
    ]
    assert found == [
        ("sb3, dqn", "dot", [0], "stable-baselines3"),
        ("sb3, dqn", "dot", [1], "stable-baselines3"),
        ("nested, small", "dot", [0, 1], None),
        ("sb3, dqn", "bar", [0], "stable-baselines3"),
        ("sb3, dqn", "bar", [1], "stable-baselines3"),
        ("nested, small", "bar", [0, 1], None),
    ]
    assert all(job.arm.stop_at_optimum and len(set(job.scenarios)) == 1 for job in jobs)
    assert len({job.name for job in jobs}) == len(jobs)
    assert {job.arm.spec for job in jobs if job.arm.library} == {AGENT_SPECS["single"]}


def test_run_numbers_are_distinct_and_independent_of_the_number_of_trials() -> None:
    arm = contestants()[0]
    runs = [(arm.number_of(design, trial), trial) for design in range(1000) for trial in range(3)]
    assert len({run for run, _ in runs}) == len(runs)
    assert all(trial_of(run) == trial for run, trial in runs)
    of_bar = [next(job for job in config(trials).cut() if job.scenarios[0] == BAR) for trials in (1, 2)]
    assert of_bar[0].trials == of_bar[1].trials[:1]


def test_a_trial_ends_at_its_first_greedy_episode_at_the_optimum(tmp_path: Path) -> None:
    job = next(job for job in config().cut() if not job.arm.library)
    trainer = agents_trainer(job, GridVectorEnv(job.scenarios))
    trainer._optimum[:] = -1e9
    training = JobTraining(job, tmp_path, trainer)
    while not training.finished:
        training.tick()
    assert training.episodes_done.tolist() == [5, 5]


def test_a_folder_is_opened_with_the_same_jobs(tmp_path: Path) -> None:
    folder = StudyFolder.new(tmp_path / "new", config())
    folder.begin()
    again = StudyFolder.open(tmp_path / "new")
    assert again.config == folder.config
    assert again.jobs == folder.jobs


def test_two_contestants_of_one_name_are_refused() -> None:
    with pytest.raises(RunError, match="two arms are named 'sb3, dqn'"):
        config_of("benchmark", [*contestants(), contestants()[1]], trials=2, seed=0, jobs=1)


def test_presets_that_an_agent_can_not_take_are_left_out_with_a_line() -> None:
    found, lines = contestants_of(["nested", "single", SB3], [TUNED, PAPER])
    assert [(agent, name) for agent, name, _ in found] == [
        ("nested", "tuned"),
        ("nested", "paper"),
        ("single", "paper"),
        ("sb3", "dqn"),
    ]
    assert len(lines) == 1
    assert lines[0].startswith("single with tuned is left out: [excursions] is not for the single agent")


def test_an_agent_that_can_take_no_preset_is_refused() -> None:
    with pytest.raises(UserError, match=r"^single can't take tuned: \[excursions\] is not for the single agent"):
        contestants_of(["nested", "single"], [TUNED])


def test_the_agent_with_objectives_is_not_told_the_design_and_finds_it_in_a_few_episodes(
    tmp_path: Path,
) -> None:
    (found,), _ = contestants_of(["nested"], [("any-design", load_preset("any-design"))])
    runs = tuple(Run(contestant(*found), scenario, trial) for trial, scenario in enumerate((DOT, BAR)))
    job = Job("000", runs, 0)
    training = JobTraining(job, tmp_path, agents_trainer(job, GridVectorEnv([DOT, BAR])))
    while not training.finished:
        training.tick()
    training.finish()
    outcome = outcome_of(job, tmp_path)
    assert outcome
    assert [run.score for run in outcome.runs] == [DOT.optimum, BAR.optimum]
    assert [run.updates for run in outcome.runs] == [0, 0], "it learns nothing between two episodes"
    assert max(len(run.evaluations) for run in outcome.runs) < 10
    assert sum(outcome.seconds_of(run) for run in outcome.runs) == pytest.approx(outcome.seconds)
    assert outcome.seconds_of(outcome.runs[0]) > 0


def test_sb3_is_capped_and_explores_by_epsilon() -> None:
    preset = baseline()
    assert preset.episodes == 500
    assert preset.explore_nested
    assert preset.update == TUNED[1].update
    assert preset.hidden == TUNED[1].hidden
    assert set(AGENTS) == {"nested", "hierarchical", "single", SB3}


@pytest.mark.parametrize(("blocks", "episodes"), [(11, 18.6), (16, 13.4), (210, 2.0)])
def test_expected_episodes_without_a_prior_follow_from_the_number_of_blocks(blocks: int, episodes: float) -> None:
    assert episodes_without_a_prior(blocks) == pytest.approx(episodes, abs=0.05)


def test_expected_episodes_without_a_prior_match_an_enumeration_of_block_pairs() -> None:
    # Two blocks among the six cells of an arena of three by three: every pair equally likely.
    pairs = list(itertools.combinations(range(1, 7), 2))
    last_test = sum(max(pair) for pair in pairs) / len(pairs)
    assert episodes_without_a_prior(2, size=3) == pytest.approx(last_test / 2 + 1)
