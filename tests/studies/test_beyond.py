"""The arms of study beyond, and the jobs that they are cut into."""

from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import PresetError
from mc_nested.studies.arm import Arm
from mc_nested.studies.beyond import arms, with_materials
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.study import StudyOptions


def found(trials: int = 10, episodes: int | None = None, device: str | None = None) -> list[Arm]:
    return arms(StudyOptions(trials=trials, episodes=episodes, device=device))


def config(trials: int = 10, jobs: int = 2) -> StudyConfig:
    return config_of("beyond", found(trials), trials=trials, seed=0, jobs=jobs)


def test_more_materials_are_spaced_evenly_in_worth_and_keep_the_optimum() -> None:
    line = load_scenario("line")
    four = with_materials(line, 4)
    assert [(m.name, m.p) for m in four.materials] == [("wood", -5), ("clay", 0), ("sandstone", 5), ("stone", 10)]
    eight = with_materials(line, 8)
    assert [m.p for m in eight.materials] == pytest.approx([-5 + 15 * number / 7 for number in range(8)])
    assert len({m.block for m in eight.materials}) == 8
    two = with_materials(line, 2)
    assert two.materials == line.materials
    assert line.optimum == two.optimum == four.optimum == eight.optimum == 21


def test_every_arm_and_scenario_is_unique_and_every_topic_has_arms() -> None:
    keys = [(arm.name, scenario.name) for arm in found() for scenario in arm.scenarios]
    assert len(set(keys)) == len(keys)
    assert {arm.labels["topic"] for arm in found()} == {"images", "parts", "materials", "cooperation"}
    assert {arm.builders for arm in found() if arm.builders} == {1, 2, 3, 4}


def test_images_have_three_trials_on_slow_designs_unless_the_option_trials_is_given() -> None:
    images = [arm for arm in found() if arm.labels["topic"] == "images"]
    trials = {(arm.scenarios[0].name, arm.labels["agent"]): arm.trials for arm in images}
    assert trials == {
        ("line", "images"): 10,
        ("line", "numbers"): 10,
        ("zigzag", "images"): 3,
        ("zigzag", "numbers"): 3,
        ("diamond", "images"): 3,
        ("diamond", "numbers"): 3,
    }
    assert {arm.trials for arm in arms(StudyOptions(trials=10, given=frozenset({"trials"})))} == {10}


def test_agents_with_numbers_explore_as_long_as_agents_with_images() -> None:
    images, numbers = (arm.preset for arm in found(1)[:2])
    assert (images.states, numbers.states) == ("image", "numbers")
    assert images.explore_nested == numbers.explore_nested
    assert images.explore_main == numbers.explore_main


def test_the_episodes_option_shortens_arms_and_never_lengthens_them() -> None:
    assert {arm.preset.episodes for arm in found(1)} == {1500, 3000}
    assert {arm.preset.episodes for arm in found(1, 2000)} == {1500, 2000}
    assert {arm.preset.episodes for arm in found(1, 7)} == {7}


def test_an_unknown_device_is_refused() -> None:
    with pytest.raises(PresetError, match="device"):
        found(1, device="nonsense")


@pytest.mark.parametrize("jobs", [1, 2, 7])
def test_every_trial_of_every_arm_is_in_one_job(jobs: int) -> None:
    own = config(jobs=jobs)
    trained = [
        (group, scenario.name, trial)
        for job in own.cut()
        for group, scenario, trial in zip(job.groups, job.scenarios, job.trials, strict=True)
    ]
    wanted = [
        (arm.name, scenario.name, trial) for arm in found() for scenario in arm.scenarios for trial in range(arm.trials)
    ]
    assert sorted(trained) == sorted(wanted)
    assert len({job.name for job in own.cut()}) == len(own.cut())


def test_the_cut_into_jobs_does_not_depend_on_the_number_of_processes() -> None:
    one, many = config(jobs=1).cut(), config(jobs=16).cut()
    assert one == many
    assert max(len(job.trials) for job in one) == 5
    assert all(len(set(job.groups)) == len({scenario.name for scenario in job.scenarios}) == 1 for job in one)


def test_jobs_with_images_come_first() -> None:
    states = [job.preset.states for job in config().cut()]
    assert states == sorted(states, key=lambda each: each != "image")


def test_a_folder_is_opened_with_the_same_jobs(tmp_path: Path) -> None:
    folder = StudyFolder.new(tmp_path / "new", config(trials=2))
    folder.begin()
    again = StudyFolder.open(tmp_path / "new")
    assert again.config == folder.config
    assert again.jobs == folder.jobs
