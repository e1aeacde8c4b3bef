"""A sensitivity run: one choice at a time, around any preset."""

from itertools import pairwise

import pytest

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, table_of
from mc_nested.errors import PresetError, ScenarioError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.experiments.sweep import SweepConfig, Variant, shipped_variants
from mc_nested.learn.preset import Preset, load_preset, shipped_presets

SCENARIOS = [load_scenario(name) for name in ("line", "zigzag", "diamond")]
PAPER = load_preset("paper")


def config(preset: Preset = PAPER) -> SweepConfig:
    return SweepConfig(
        trials=2,
        seed=0,
        jobs=2,
        preset_name="some",
        preset=preset,
        scenarios=[table_of(scenario) for scenario in SCENARIOS],
        variants=shipped_variants(preset, SCENARIOS),
    )


def test_each_choice_that_the_paper_leaves_open_is_varied() -> None:
    choices = {variant.choice for variant in shipped_variants(PAPER, SCENARIOS)}
    assert choices >= {"learning rate", "γ", "target period", "start", "step limit", "single, its choice"}
    assert choices >= {f"{agent} ε, {what}" for agent in ("main", "nested") for what in ("share", "floor")}


def test_the_base_of_each_agent_comes_first() -> None:
    variants = shipped_variants(PAPER, SCENARIOS)
    assert [variant.name for variant in variants[:2]] == ["base, nested", "base, single"]
    assert all(variant.choice for variant in variants[2:])
    for variant in variants[:2]:
        assert variant.preset_from(PAPER) == PAPER
        assert [variant.scenario_from(scenario) for scenario in SCENARIOS] == SCENARIOS


def test_one_choice_at_a_time_is_otherwise() -> None:
    for variant in shipped_variants(PAPER, SCENARIOS)[2:]:
        preset = variant.preset_from(PAPER).model_dump()
        tables = [key for key, value in PAPER.model_dump().items() if preset[key] != value]
        moved = variant.scenario_from(SCENARIOS[0]) != SCENARIOS[0]
        assert len(tables) + moved + (variant.spec() != AGENT_SPECS[variant.agent]) == 1, variant.name


@pytest.mark.parametrize("preset", shipped_presets())
def test_every_shipped_preset_can_be_swept(preset: str) -> None:
    runs = config(load_preset(preset)).runs()
    assert len({(run.group, run.scenario.name, run.trial) for run in runs}) == len(runs)


def test_practice_in_a_learnt_game_is_swept_without_what_it_can_not_take() -> None:
    live = load_preset("live")
    choices = {variant.choice for variant in shipped_variants(live, SCENARIOS)}
    assert choices.isdisjoint({"replay", "main ε, share", "main ε, floor", "nested ε, share", "single, its choice"})
    assert choices >= {"learning rate", "γ", "start", "step limit"}


def test_a_variant_that_changes_nothing_is_left_out() -> None:
    as_in_variant = PAPER.model_copy(update={"update": PAPER.update.model_copy(update={"gamma": 0.99})})
    names = {variant.name for variant in shipped_variants(as_in_variant, SCENARIOS)}
    assert "γ: 0.99" not in names
    assert "γ: 0.9" in names


def test_a_variant_that_needs_a_table_is_left_out_without_it() -> None:
    needy = Variant(choice="imitation", value="more", needs="imitation", preset={"imitation": {"batch": 8}})
    assert not needy.changes(PAPER, SCENARIOS)


def test_a_variant_changes_the_values_it_names_and_no_others() -> None:
    variant = Variant(choice="γ", value="0.5", preset={"update": {"gamma": 0.5}})
    assert variant.preset_from(PAPER) == PAPER.model_copy(
        update={"update": PAPER.update.model_copy(update={"gamma": 0.5})}
    )
    moved = Variant(choice="start", value="near", start=[7, 0]).scenario_from(SCENARIOS[1])
    assert (moved.start, moved.design, moved.step_limit) == ((7, 0), SCENARIOS[1].design, 60)


def test_a_variant_that_does_not_fit_is_one_line_that_names_it() -> None:
    with pytest.raises(PresetError, match=r"variant γ: 2: update\.gamma: Input should be less than or equal to 1"):
        Variant(choice="γ", value="2", preset={"update": {"gamma": 2.0}}).preset_from(PAPER)
    with pytest.raises(PresetError, match=r"variant γ: 2: update\.gama: unknown key: did you mean gamma\?"):
        Variant(choice="γ", value="2", preset={"update": {"gama": 2.0}}).preset_from(PAPER)
    with pytest.raises(ScenarioError, match=r"variant limit: 5, scenario line: step_limit: 5 steps can't place 11"):
        Variant(choice="limit", value="5", step_limit=5).scenario_from(SCENARIOS[0])


def test_runs_that_differ_in_their_scenarios_alone_train_side_by_side() -> None:
    runs = config().runs()
    kinds = [(run.spec, run.preset) for run in runs]
    changes = sum(one != two for one, two in pairwise(kinds))
    assert all(kinds.index(kind) == place or kinds[place - 1] == kind for place, kind in enumerate(kinds))
    beside_the_base = {run.group for run in runs if (run.spec, run.preset) == kinds[0]}
    assert {"base, nested", "start: near edge, middle", "step limit: 120"} <= beside_the_base
    assert changes < len({run.group for run in runs}) - 1


def test_what_a_preset_or_a_design_can_not_do_is_left_out() -> None:
    assert {variant.agent for variant in shipped_variants(load_preset("tuned"), SCENARIOS)} == {"nested"}
    cells = frozenset((x, y) for x in range(15) for y in range(3, 6))
    large = Scenario("large", cells, (7, 14), 200, SCENARIOS[0].materials)
    limits = [variant.value for variant in shipped_variants(PAPER, [large]) if variant.choice == "step limit"]
    assert limits == ["120"]
