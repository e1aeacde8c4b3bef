"""The paper's experiment as runs."""

from mc_nested.arena.scenario_file import load_scenario, table_of
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.experiments.reproduction import LONGER_AGENTS, LONGER_SCENARIOS, ReproduceConfig
from mc_nested.report.claims import contests
from tests.learn.made_experiments import small_preset


def config(agents: list[str], scenarios: list[str], longer: int = 0) -> ReproduceConfig:
    return ReproduceConfig(
        agents=agents,
        trials=10,
        seed=0,
        jobs=2,
        longer=longer,
        preset_name="small",
        preset=small_preset(30),
        scenarios=[table_of(load_scenario(name)) for name in scenarios],
    )


def test_three_agents_on_three_designs_in_ten_trials_are_ninety_runs() -> None:
    runs = config(list(AGENT_SPECS), ["line", "zigzag", "diamond"]).runs()
    assert len(runs) == 90
    assert len({(run.group, run.scenario.name, run.trial) for run in runs}) == 90
    assert [run.group for run in runs[::30]] == ["nested", "hierarchical", "single"]
    assert [run.trial for run in runs[:11]] == [*range(10), 0]


def test_what_is_trained_for_longer_is_what_claim_f_is_about() -> None:
    assert LONGER_SCENARIOS == contests.UNSOLVED
    assert LONGER_AGENTS == (contests.NESTED, contests.HIERARCHICAL)
    longer = config(list(AGENT_SPECS), ["line", "zigzag", "diamond"], longer=10).runs()[90:]
    assert {(run.group, run.scenario.name, run.preset.episodes) for run in longer} == {
        (f"{agent}-longer", scenario, 300) for agent in LONGER_AGENTS for scenario in LONGER_SCENARIOS
    }
    assert len(longer) == 40


def test_only_what_is_trained_at_all_is_trained_for_longer() -> None:
    few = config(["single", "hierarchical"], ["diamond", "line"], longer=3)
    assert (few.longer_agents, few.longer_scenarios) == (["hierarchical"], ["diamond"])
    assert len(few.runs()) == 40 + 10
    assert config(["single"], ["diamond"], longer=3).longer_agents == []
