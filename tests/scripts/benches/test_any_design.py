"""The bench of the networks for any design: its topics, and what counts as right."""

import json
from collections.abc import Sequence

import pytest

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.objectives.weights import Weights, shipped_weights
from scripts.bench import main
from scripts.benches import any_design
from scripts.benches.any_design import Judged, drawn, judged


def test_the_shipped_networks_are_judged_by_what_they_build(capsys: pytest.CaptureFixture[str]) -> None:
    main(["any-design", "--designs", "1", "--json"])
    figures = json.loads(capsys.readouterr().out)
    assert list(figures) == ["designs of seed 2026", "designs of seed 2027", "shipped", "arenas of 20", "arenas of 30"]
    assert figures["shipped"]["whole"] == figures["shipped"]["of"] == 7
    assert figures["designs of seed 2027"]["of"] == 3


def test_a_design_that_isnt_built_whole_is_named() -> None:
    shipped = shipped_weights()
    found = judged("blind", [load_scenario("line")], Weights(shipped.main, 0 * shipped.nested))
    assert found["whole"] == 0
    assert found["failed"] == ["line 0 of 11"]


@pytest.mark.parametrize(("whole", "steps", "code"), [(100, 1.15, 0), (80, 1.0, 1), (100, 1.2, 1)])
def test_too_few_whole_designs_or_too_many_steps_are_a_failure(
    whole: int, steps: float, code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def figures(_: str, scenarios: Sequence[Scenario], __: Weights) -> Judged:
        return Judged(
            whole=len(scenarios) * whole // 100, of=len(scenarios), steps_against_the_builder=steps, failed=[]
        )

    monkeypatch.setattr(any_design, "judged", figures)
    monkeypatch.setattr(any_design, "drawn", lambda *_: [load_scenario("line")] * 10)
    assert main(["any-design", "--json"]) == code


def test_large_designs_have_twenty_to_a_hundred_blocks_in_arenas_of_their_size() -> None:
    scenarios = drawn(5, 4, 20, any_design.MANY_BLOCKS)
    assert all(scenario.size == 20 and 20 <= scenario.blocks <= 100 for scenario in scenarios)
    assert scenarios[0].start == (10, 19)
