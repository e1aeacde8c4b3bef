"""The paper's experiment under each open choice: all agents, one choice at a time."""

from itertools import pairwise

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import ScenarioError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import load_preset
from mc_nested.studies.arm import Run, spec_of
from mc_nested.studies.change import Change
from mc_nested.studies.job import side_by_side
from mc_nested.studies.robustness import arms, open_choices
from mc_nested.studies.study import StudyOptions
from tests.learn.made_experiments import BAR, DOT

SCENARIOS = [load_scenario(name) for name in ("line", "zigzag", "diamond")]
PAPER = load_preset("paper")
CHOICES = open_choices(PAPER, SCENARIOS)


def runs_of() -> list[Run]:
    return side_by_side([run for arm in arms(StudyOptions(trials=2, scenarios=SCENARIOS)) for run in arm.runs()])


def test_the_base_comes_first_and_every_other_choice_changes_one_thing() -> None:
    assert CHOICES[0] == Change()
    for choice in CHOICES[1:]:
        preset = choice.preset_from(PAPER).model_dump()
        tables = [key for key, value in preset.items() if PAPER.model_dump().get(key) != value]
        moved = [choice.scenario_from(scenario) for scenario in SCENARIOS] != SCENARIOS
        specs = any(spec_of(agent, choice.sees_choice) != spec for agent, spec in AGENT_SPECS.items())
        assert len(tables) + moved + specs == 1, choice.name


def test_the_choices_include_those_that_the_paper_leaves_open() -> None:
    choices = {choice.choice for choice in CHOICES}
    assert choices >= {"start", "designs", "step limit", "γ", "learning rate", "target period", "learning starts"}
    assert choices >= {f"{agent} ε, {what}" for agent in ("main", "nested") for what in ("share", "floor")}
    assert choices >= {"states", "the policy kept", "single, its choice"}


def test_every_run_of_every_choice_is_unique() -> None:
    runs = runs_of()
    assert len({(run.arm.name, run.scenario.name, run.trial) for run in runs}) == len(runs)
    assert len(runs) == len(CHOICES) * 3 * 3 * 2


def test_every_agent_has_every_choice_and_runs_of_one_kind_stand_side_by_side() -> None:
    runs = runs_of()
    assert {run.arm.name for run in runs} == {f"{choice.name}, {agent}" for choice in CHOICES for agent in AGENT_SPECS}
    kinds = [(run.arm.spec, run.arm.preset) for run in runs]
    assert sum(one != two for one, two in pairwise(kinds)) + 1 == len(set(map(str, kinds)))
    with_the_base = {run.arm.name for run in runs if (run.arm.spec, run.arm.preset) == kinds[0]}
    assert {"base, nested", "start: centre, nested", "designs: smaller, nested", "step limit: 40, nested"} <= (
        with_the_base
    )


def test_only_the_single_agent_stops_seeing_its_choice() -> None:
    choice = next(each for each in CHOICES if each.sees_choice is False)
    assert not spec_of("single", choice.sees_choice).sees_choice
    assert spec_of("nested", choice.sees_choice) == AGENT_SPECS["nested"]


def test_other_designs_are_of_the_same_kinds_with_fewer_blocks() -> None:
    smaller = next(choice for choice in CHOICES if choice.designs)
    found = {scenario.name: smaller.scenario_from(scenario) for scenario in SCENARIOS}
    assert {name: (scenario.blocks, scenario.optimum) for name, scenario in found.items()} == {
        "line": (7, 17.0),
        "zigzag": (9, 19.0),
        "diamond": (12, 22.0),
    }
    assert found["line"].start == SCENARIOS[0].start
    assert found["diamond"].design == {(x, y) for x in range(15) for y in range(15) if abs(x - 7) + abs(y - 7) == 3}


def test_a_design_that_a_choice_does_not_name_is_unchanged() -> None:
    smaller = next(choice for choice in CHOICES if choice.designs)
    assert smaller.scenario_from(BAR) == BAR
    assert smaller not in open_choices(PAPER, [DOT, BAR])


@pytest.mark.parametrize("preset", ["tuned", "model-based"])
def test_a_preset_that_the_single_agent_can_not_use_leaves_only_scenario_choices(preset: str) -> None:
    # Such a preset is refused before; nothing here pretends that it could be judged.
    chosen = load_preset(preset)
    assert all(choice.preset_from(chosen) == chosen for choice in open_choices(chosen, SCENARIOS))


def test_a_choice_with_an_invalid_design_is_left_out_and_refused_when_applied() -> None:
    odd = Change(choice="designs", value="odd", designs={"line": "#"})
    assert not odd.differs(list(AGENT_SPECS), PAPER, SCENARIOS)
    with pytest.raises(ScenarioError, match="designs: odd, scenario line"):
        odd.scenario_from(SCENARIOS[0])
