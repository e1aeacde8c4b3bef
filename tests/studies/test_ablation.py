"""An ablation: its parts, and which trials train together."""

import pytest

from mc_nested.arena.scenario import Scenario
from mc_nested.errors import RunError
from mc_nested.learn.preset import load_preset
from mc_nested.studies.ablation import arms
from mc_nested.studies.arm import Arm
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.study import StudyOptions
from tests.learn.made_experiments import BAR, DOT


def shipped(*scenarios: Scenario, episodes: int | None = None) -> dict[str, Arm]:
    return {arm.name: arm for arm in arms(StudyOptions(trials=2, episodes=episodes, scenarios=scenarios))}


PARTS = shipped(DOT)

LIVE = load_preset("model-based").model_copy(update={"episodes": 30})
"""The preset model-based, for as many episodes as an ablation's trial has."""


def config(*scenarios: Scenario) -> StudyConfig:
    return config_of("ablation", list(shipped(*scenarios).values()), trials=2, seed=0, jobs=2)


def test_the_first_part_is_the_unchanged_preset_model_based() -> None:
    first = next(iter(PARTS.values()))
    assert (first.name, first.preset) == ("model-based as it is", LIVE)


def test_every_ablated_part_changes_its_base_and_no_two_parts_are_alike() -> None:
    for part in PARTS.values():
        base = LIVE if part.preset_name == "model-based" else load_preset(part.preset_name)
        assert (part.preset == base) == part.name.endswith("as it is"), part.name
    assert len({part.preset.model_dump_json() for part in PARTS.values()}) == len(PARTS)


@pytest.mark.parametrize(
    ("name", "off"),
    [
        ("without neighbours", {"neighbours": False}),
        ("without optimism", {"neighbours": False, "optimism": False}),
        ("without real transitions", {"real_transitions": False}),
        ("single Q-learning", {"double": False}),
        ("narrow exploration", {"highest_epsilon": 0.1, "lowest_epsilon": 0.1}),
    ],
)
def test_each_imagination_part_turns_off_only_its_own_settings(name: str, off: dict[str, object]) -> None:
    assert LIVE.imagination is not None
    rule = LIVE.imagination.model_copy(update=off)
    assert PARTS[name].preset == LIVE.model_copy(update={"imagination": rule})


def test_parts_of_the_preset_tuned_drop_imitation_or_td_errors() -> None:
    assert PARTS["tuned without imitation"].preset == load_preset("tuned").model_copy(update={"imitation": None})
    alone = PARTS["tuned, imitation only"].preset.imitation
    assert alone is not None
    assert alone.td_weight == 0.0


def test_no_part_of_the_preset_model_based_has_imitation() -> None:
    assert all(part.preset.imitation is None for part in PARTS.values() if part.preset_name == "model-based")


def test_every_trial_of_every_part_on_every_design_is_trained_once() -> None:
    jobs = config(DOT, BAR).cut()
    trained = [
        (group, scenario.name, trial)
        for job in jobs
        for group, scenario, trial in zip(job.groups, job.scenarios, job.trials, strict=True)
    ]
    assert sorted(trained) == sorted(
        (name, design, trial) for name in PARTS for design in ("bar", "dot") for trial in (0, 1)
    )
    assert all(job.arm.stop_at_optimum for job in jobs)
    assert not any(job.arm.library for job in jobs)


def test_trials_with_imagination_train_one_by_one_and_others_side_by_side() -> None:
    for job in config(DOT).cut():
        part = PARTS[job.groups[0]]
        assert len(job.trials) == (1 if part.preset_name == "model-based" else 2), part.name


def test_the_episodes_option_applies_to_every_part() -> None:
    assert {part.preset.episodes for part in shipped(DOT, episodes=7).values()} == {7}


def test_two_designs_of_one_name_are_refused() -> None:
    with pytest.raises(RunError, match="two scenarios are named 'dot'"):
        config(DOT, DOT)
