"""A sensitivity run: one choice at a time, around any preset."""

from itertools import pairwise

import pytest

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import PresetError, ScenarioError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import load_preset, shipped_presets
from mc_nested.studies.arm import Run, spec_of
from mc_nested.studies.change import Change
from mc_nested.studies.job import side_by_side
from mc_nested.studies.study import StudyOptions
from mc_nested.studies.sweep import arms, varied

SCENARIOS = [load_scenario(name) for name in ("line", "zigzag", "diamond")]
PAPER = load_preset("paper")


def runs_of(preset: str = "paper") -> list[Run]:
    found = arms(StudyOptions(trials=2, scenarios=SCENARIOS, preset=preset))
    return side_by_side([run for arm in found for run in arm.runs()])


def test_each_choice_that_the_paper_leaves_open_is_varied() -> None:
    choices = {variant.choice for variant in varied(PAPER, SCENARIOS)}
    assert choices >= {"learning rate", "γ", "target period", "start", "step limit", "single, its choice"}
    assert choices >= {f"{agent} ε, {what}" for agent in ("main", "nested") for what in ("share", "floor")}


def test_the_base_of_each_agent_comes_first() -> None:
    variants = varied(PAPER, SCENARIOS)
    assert [arm.name for arm in arms(StudyOptions(trials=1, scenarios=SCENARIOS))][:2] == [
        "base, nested",
        "base, single",
    ]
    assert all(variant.choice for variant in variants[2:])
    for variant in variants[:2]:
        assert variant.preset_from(PAPER) == PAPER
        assert [variant.scenario_from(scenario) for scenario in SCENARIOS] == SCENARIOS


def test_each_variant_changes_one_choice() -> None:
    for variant in varied(PAPER, SCENARIOS)[2:]:
        preset = variant.preset_from(PAPER).model_dump()
        tables = [key for key, value in PAPER.model_dump().items() if preset[key] != value]
        moved = variant.scenario_from(SCENARIOS[0]) != SCENARIOS[0]
        is_other_agent = spec_of(variant.agent, variant.sees_choice) != AGENT_SPECS[variant.agent]
        assert len(tables) + moved + is_other_agent == 1, variant.name


@pytest.mark.parametrize("preset", shipped_presets())
def test_every_shipped_preset_can_be_swept(preset: str) -> None:
    runs = runs_of(preset)
    assert len({(run.arm.name, run.scenario.name, run.trial) for run in runs}) == len(runs)


def test_a_preset_with_imagination_is_swept_without_choices_that_do_not_apply() -> None:
    live = load_preset("model-based")
    choices = {variant.choice for variant in varied(live, SCENARIOS)}
    assert choices.isdisjoint({"replay", "main ε, share", "main ε, floor", "nested ε, share", "single, its choice"})
    assert choices >= {"learning rate", "γ", "start", "step limit"}


def test_a_variant_that_changes_nothing_is_left_out() -> None:
    as_in_variant = PAPER.model_copy(update={"update": PAPER.update.model_copy(update={"gamma": 0.99})})
    names = {variant.name for variant in varied(as_in_variant, SCENARIOS)}
    assert "γ: 0.99" not in names
    assert "γ: 0.9" in names


def test_a_variant_that_needs_a_table_is_left_out_without_it() -> None:
    needy = Change(choice="imitation", value="more", needs="imitation", preset={"imitation": {"batch": 8}})
    assert not needy.differs(["nested"], PAPER, SCENARIOS)


def test_a_variant_changes_the_values_it_names_and_no_others() -> None:
    variant = Change(choice="γ", value="0.5", preset={"update": {"gamma": 0.5}})
    assert variant.preset_from(PAPER) == PAPER.model_copy(
        update={"update": PAPER.update.model_copy(update={"gamma": 0.5})}
    )
    moved = Change(choice="start", value="near", start=[7, 0]).scenario_from(SCENARIOS[1])
    assert (moved.start, moved.design, moved.step_limit) == ((7, 0), SCENARIOS[1].design, 60)


def test_an_invalid_variant_is_refused_with_its_name() -> None:
    with pytest.raises(PresetError, match=r"variant γ: 2: update\.gamma: Input should be less than or equal to 1"):
        Change(choice="γ", value="2", preset={"update": {"gamma": 2.0}}).preset_from(PAPER)
    with pytest.raises(PresetError, match=r"variant γ: 2: update\.gama: unknown key: did you mean gamma\?"):
        Change(choice="γ", value="2", preset={"update": {"gama": 2.0}}).preset_from(PAPER)
    with pytest.raises(ScenarioError, match=r"variant limit: 5, scenario line: step_limit: 5 steps can't place 11"):
        Change(choice="limit", value="5", step_limit=5).scenario_from(SCENARIOS[0])


def test_runs_that_differ_in_their_scenarios_alone_train_side_by_side() -> None:
    runs = runs_of()
    kinds = [(run.arm.spec, run.arm.preset) for run in runs]
    changes = sum(one != two for one, two in pairwise(kinds))
    assert all(kinds.index(kind) == place or kinds[place - 1] == kind for place, kind in enumerate(kinds))
    beside_the_base = {run.arm.name for run in runs if (run.arm.spec, run.arm.preset) == kinds[0]}
    assert {"base, nested", "start: near edge, middle", "step limit: 120"} <= beside_the_base
    assert changes < len({run.arm.name for run in runs}) - 1


def test_variants_that_a_preset_or_a_design_can_not_take_are_left_out() -> None:
    assert {variant.agent for variant in varied(load_preset("tuned"), SCENARIOS)} == {"nested"}
    cells = frozenset((x, y) for x in range(15) for y in range(3, 6))
    large = Scenario("large", cells, (7, 14), 200, SCENARIOS[0].materials)
    limits = [variant.value for variant in varied(PAPER, [large]) if variant.choice == "step limit"]
    assert limits == ["120"]
