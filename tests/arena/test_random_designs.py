"""Random designs: the same for a seed and a number, of their kind, and buildable."""

import hashlib

import numpy as np
import pytest

from mc_nested.arena.design import (
    FEW_BLOCKS,
    KINDS,
    SCATTERED,
    draw_design,
    is_buildable,
    kind_of_design,
    random_scenario,
)
from mc_nested.arena.scenario_file import load_scenario, table_of

LINE = load_scenario("line")
HUNDRED = [random_scenario(0, number, LINE) for number in range(100)]


def test_a_design_is_a_function_of_seed_and_number() -> None:
    assert [random_scenario(0, number, LINE) for number in (7, 3, 99)] == [HUNDRED[number] for number in (7, 3, 99)]
    assert len({scenario.design for scenario in HUNDRED}) == 100
    assert random_scenario(1, 3, LINE).design != HUNDRED[3].design


def test_the_default_hundred_designs_have_not_changed() -> None:
    drawings = "".join(table_of(scenario).design for scenario in HUNDRED)
    assert hashlib.sha256(drawings.encode()).hexdigest()[:16] == "ea8c675eddb6001a"


def test_kinds_have_equal_shares_and_every_design_is_of_its_kind() -> None:
    kinds = [kind_of_design(scenario.design) for scenario in HUNDRED]
    assert kinds[:6] == [*KINDS, *KINDS]
    assert [kinds.count(kind) for kind in KINDS] == [34, 33, 33]
    assert [scenario.name.rpartition("-")[0] for scenario in HUNDRED] == kinds


def test_every_number_of_blocks_is_drawn_and_every_design_can_be_built() -> None:
    many = [random_scenario(5, number, LINE) for number in range(300)]
    assert {scenario.blocks for scenario in many} == set(range(FEW_BLOCKS[0], FEW_BLOCKS[1] + 1))
    assert all(is_buildable(scenario) for scenario in many)
    assert all(scenario.start == LINE.start and scenario.materials == LINE.materials for scenario in many)
    columns = {x for scenario in many for x, _ in scenario.design}
    rows = {y for scenario in many for _, y in scenario.design}
    assert columns == set(range(15))
    assert rows == set(range(1, 15))


def test_a_random_design_of_the_wrong_kind_or_unbuildable_is_drawn_again(monkeypatch: pytest.MonkeyPatch) -> None:
    touching, apart = frozenset({(3, 3), (3, 4)}), frozenset({(3, 3), (9, 9)})
    drawn = iter([touching, frozenset({(3, 0), (9, 9)}), apart])
    monkeypatch.setattr("mc_nested.arena.design.draw_design", lambda *_: next(drawn))
    assert random_scenario(0, KINDS.index(SCATTERED), LINE).design == apart


@pytest.mark.parametrize("kind", KINDS)
def test_random_designs_reach_every_buildable_row_and_column_of_a_larger_arena(kind: str) -> None:
    random = np.random.default_rng(0)
    cells = {cell for _ in range(400) for cell in draw_design(kind, random, 20, FEW_BLOCKS)}
    assert {x for x, _ in cells} == set(range(20))
    assert {y for _, y in cells} == set(range(1, 20))
