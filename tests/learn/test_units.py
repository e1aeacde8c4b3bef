"""The cut of an experiment into units: every run once, work for every process, only what can train together mixed."""

from dataclasses import replace
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as some

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import FORMS
from mc_nested.learn.preset import load_preset
from mc_nested.learn.units import Run, Unit, cut_into_units
from tests.learn.experiments import BAR, DOT, MATERIALS, runs_of, small_preset

PRESETS = [small_preset(10), small_preset(100)]
SCENARIOS = [DOT, BAR, replace(DOT, name="of one material", materials=MATERIALS[1:])]

SOME_RUNS = some.lists(
    some.builds(
        lambda agent, preset, scenario, trial: Run(agent, FORMS[agent], preset, scenario, trial),
        some.sampled_from(list(FORMS)),
        some.sampled_from(PRESETS),
        some.sampled_from(SCENARIOS),
        some.integers(0, 5),
    ),
    min_size=1,
    max_size=40,
)


def in_order(units: list[Unit]) -> list[Run]:
    return [
        Run(group, unit.form, unit.preset, scenario, trial)
        for unit in sorted(units, key=lambda unit: unit.name)
        for group, scenario, trial in zip(unit.groups, unit.scenarios, unit.trials, strict=True)
    ]


@given(SOME_RUNS, some.integers(1, 9))
def test_every_run_is_in_one_unit_and_the_longest_unit_comes_first(runs: list[Run], parts: int) -> None:
    units = cut_into_units(runs, parts, seed=0)
    assert in_order(units) == runs
    assert [unit.work for unit in units] == sorted((unit.work for unit in units), reverse=True)
    assert len({unit.name for unit in units}) == len(units)


@given(SOME_RUNS, some.integers(1, 9))
def test_a_unit_is_of_one_agent_one_preset_and_one_choice_of_materials(runs: list[Run], parts: int) -> None:
    for unit in cut_into_units(runs, parts, seed=0):
        assert len({len(scenario.materials) for scenario in unit.scenarios}) == 1
        assert {FORMS[group] for group in unit.groups} == {unit.form}
    kinds = 1 + sum(
        (one.form, one.preset, len(one.scenario.materials)) != (two.form, two.preset, len(two.scenario.materials))
        for one, two in pairwise(runs)
    )
    assert len(cut_into_units(runs, parts, seed=0)) <= kinds + parts - 1


@given(some.integers(1, 60), some.integers(1, 9))
def test_alike_runs_are_cut_evenly(trials: int, parts: int) -> None:
    units = cut_into_units(runs_of(["nested"], [DOT], trials, small_preset()), parts, seed=0)
    sizes = [len(unit.trials) for unit in units]
    assert max(sizes) - min(sizes) <= 1
    assert len(units) == min(parts, trials)


def test_the_papers_experiment_on_two_cores() -> None:
    scenarios = [load_scenario(name) for name in ("line", "zigzag", "diamond")]
    units = cut_into_units(runs_of(list(FORMS), scenarios, 10, load_preset("paper")), 2, seed=0)
    assert [(unit.groups[0], len(unit.trials)) for unit in units] == [
        ("nested", 30),
        ("hierarchical", 19),
        ("single", 30),
        ("hierarchical", 11),
    ]


def test_one_hot_only_scenarios_of_as_many_blocks_train_together() -> None:
    one_hot = small_preset().model_copy(update={"encoding": "one-hot"})
    scenarios = [load_scenario(name) for name in ("line", "zigzag", "diamond")]
    units = cut_into_units(runs_of(["nested"], scenarios, 2, one_hot), 1, seed=0)
    assert [[scenario.name for scenario in unit.scenarios[::2]] for unit in units] == [["line", "zigzag"], ["diamond"]]


def test_a_long_run_weighs_as_much_as_ten_short_ones() -> None:
    runs = runs_of(["nested"], [DOT], 10, small_preset(10)) + runs_of(["nested"], [DOT], 2, small_preset(100))
    assert [len(unit.trials) for unit in cut_into_units(runs, 3, seed=0)] == [10, 1, 1]


def test_units_of_other_runs_presets_or_seeds_have_other_identities() -> None:
    runs = runs_of(["nested"], [DOT, BAR], 2, small_preset())
    shorter = runs_of(["nested"], [DOT, BAR], 2, small_preset(19))
    units = [
        cut_into_units(runs, 1, seed=0),
        cut_into_units(runs, 1, seed=1),
        cut_into_units(runs[1:], 1, seed=0),
        cut_into_units(shorter, 1, seed=0),
        cut_into_units([replace(run, form=FORMS["single"]) for run in runs], 1, seed=0),
    ]
    identities = [str(unit.identity()) for (unit,) in units]
    assert len(set(identities)) == len(identities)
    assert cut_into_units(runs, 1, seed=0)[0].identity() == units[0][0].identity()
