"""The words at a training's end: next commands that can be typed as they are."""

import sys
from pathlib import Path
from typing import Any

import pytest

from mc_nested.arena.scenario_file import load_scenario, table_of
from mc_nested.cli.training_end import next_steps
from mc_nested.learn.preset import load_preset
from mc_nested.learn.runs.run_config import RunConfig
from tests.learn.made_experiments import run_config

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows quotes words otherwise")


def config(**changes: Any) -> RunConfig:
    of_the_paper = {"preset_name": "paper", "preset": load_preset("paper")}
    return run_config(load_scenario("zigzag"), **{**of_the_paper, **changes})


def test_at_the_optimum_the_next_step_is_to_watch_the_agent() -> None:
    assert next_steps(Path("runs/x"), config(), is_at_optimum=True) == [
        "next:       mc-nested play runs/x shows what it builds; in your game: with --backend live"
    ]


def test_after_several_trials_the_next_step_is_to_evaluate_them() -> None:
    lines = next_steps(Path("my runs/x"), config(trials=3), is_at_optimum=True)
    assert lines[1:] == ["            mc-nested runs evaluate 'my runs/x' plays each of its trials"]


def test_below_the_optimum_the_next_step_is_to_train_twice_as_long() -> None:
    lines = next_steps(Path("runs/x"), config(), is_at_optimum=False)
    more = "mc-nested train --from runs/x --scenario zigzag --preset paper --episodes 6000"
    assert lines[0] == f"below the optimum; for more: {more}"
    assert lines[1].startswith("next:")


def test_command_for_more_training_names_every_option_that_is_not_the_default() -> None:
    design = table_of(load_scenario("line")).model_copy(update={"step_limit": 50})
    changes = {"agent": "hierarchical", "preset_name": "my.toml", "stop_at_optimum": True, "scenario": design}
    (line, *_) = next_steps(Path("x"), config(**changes), is_at_optimum=False)
    more = "--scenario FILE --agent hierarchical --preset my.toml --episodes 6000 --stop-at-optimum"
    assert line.endswith(f"mc-nested train --from x {more}"), "a design of that name, but another one"


def test_command_for_more_training_names_an_engine_that_differs_from_the_presets() -> None:
    other = load_preset("paper").changed(engine="torch", states="image")
    (line, *_) = next_steps(Path("x"), config(preset=other), is_at_optimum=False)
    assert "--preset paper --engine torch --states image --episodes 6000" in line
    image = config(preset_name="image", preset=load_preset("image"))
    assert "--engine" not in next_steps(Path("x"), image, is_at_optimum=False)[0]


def test_next_steps_of_a_training_on_the_virtual_client_name_that_backend() -> None:
    more, play, *_ = next_steps(Path("x"), config(backend="virtual"), is_at_optimum=False)
    assert more.endswith("--episodes 6000 --backend virtual")
    assert "mc-nested play x --backend virtual shows what it builds" in play


@pytest.mark.parametrize(("profile", "words"), [("default", ""), ("mine", " --profile mine")])
def test_next_steps_of_a_live_training_name_its_backend_and_profile(profile: str, words: str) -> None:
    live = config(backend="live", profile=profile)
    assert next_steps(Path("x"), live, is_at_optimum=True) == [
        f"next:       mc-nested play x --backend live{words} builds it again"
    ]
    assert next_steps(Path("x"), live, is_at_optimum=False)[0].endswith(f"--episodes 6000 --backend live{words}")
