"""The paper's experiment as arms."""

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.studies.arm import Arm, Run
from mc_nested.studies.reproduce import LONGER_AGENTS, LONGER_SCENARIOS, arms
from mc_nested.studies.study import StudyOptions

THREE = ["line", "zigzag", "diamond"]


def asked(agents: list[str], scenarios: list[str], longer: int = 0) -> list[Arm]:
    loaded = [load_scenario(name) for name in scenarios]
    return arms(StudyOptions(trials=10, episodes=30, scenarios=loaded, agent=agents, longer=longer))


def runs_of(found: list[Arm]) -> list[Run]:
    return [run for arm in found for run in arm.runs()]


def test_three_agents_on_three_designs_in_ten_trials_are_ninety_runs() -> None:
    runs = runs_of(asked([], THREE))
    assert len(runs) == 90
    assert len({(run.arm.name, run.scenario.name, run.trial) for run in runs}) == 90
    assert [run.arm.name for run in runs[::30]] == ["nested", "hierarchical", "single"]
    assert [run.trial for run in runs[:11]] == [*range(10), 0]


def test_agents_and_scenarios_of_claim_f_are_trained_for_longer() -> None:
    longer = runs_of(asked([], THREE, longer=10))[90:]
    assert {(run.arm.name, run.scenario.name, run.arm.preset.episodes) for run in longer} == {
        (f"{agent}-longer", scenario, 300) for agent in LONGER_AGENTS for scenario in LONGER_SCENARIOS
    }
    assert len(longer) == 40


def test_only_chosen_agents_and_scenarios_are_trained_for_longer() -> None:
    few = asked(["single", "hierarchical"], ["diamond", "line"], longer=3)
    longer = [arm for arm in few if arm.name.endswith("-longer")]
    assert [(arm.agent, [scenario.name for scenario in arm.scenarios]) for arm in longer] == [
        ("hierarchical", ["diamond"])
    ]
    assert len(runs_of(few)) == 40 + 10
