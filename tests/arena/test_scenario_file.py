"""Scenario files: the shipped ones are the task's table, a user's own is read whole or refused in one line."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import SIZE
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import draw_grid, load_scenario, parse_scenario, scenario_of, table_of
from mc_nested.errors import ScenarioError

WOOD, STONE = Material("wood", -5.0, "oak_planks"), Material("stone", 10.0, "stone")

DESIGNS = {
    "line": {(7, y) for y in range(2, 13)},
    "zigzag": set(zip([7, 8, 9, 8, 7, 6, 5, 6, 7, 8, 9], range(2, 13), strict=True)),
    "diamond": {(x, y) for x in range(SIZE) for y in range(SIZE) if abs(x - 7) + abs(y - 7) == 4},
}

OWN = f"""
name = "dot"
start = [3, 4]
step_limit = 9
design = '''
{draw_grid(frozenset({(2, 5)}))}'''
[[materials]]
name = "glass"
p = 1
block = "glass"
"""


@pytest.mark.parametrize(("name", "optimum"), [("line", 21), ("zigzag", 21), ("diamond", 26)])
def test_the_shipped_scenarios_are_the_tasks_table(name: str, optimum: float) -> None:
    scenario = load_scenario(name)
    assert scenario.design == DESIGNS[name]
    assert scenario.start == (7, 14)
    assert scenario.step_limit == 60
    assert scenario.materials == (WOOD, STONE)
    assert scenario.optimum == optimum
    assert scenario.best_material == 1
    assert scenario.start_state == (7, 14, len(DESIGNS[name]))


def test_a_users_file_is_read_by_its_path(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(OWN)
    scenario = load_scenario(tmp_path / "dot.toml")
    assert scenario == Scenario("dot", frozenset({(2, 5)}), (3, 4), 9, (Material("glass", 1.0, "glass"),))


def test_a_file_that_begins_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(OWN, encoding="utf-8-sig")
    assert load_scenario(tmp_path / "dot.toml").name == "dot"


buildable = st.tuples(st.integers(0, SIZE - 1), st.integers(1, SIZE - 1))


@given(
    design=st.frozensets(buildable, min_size=1),
    start=st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1)),
    worth=st.lists(st.floats(-100, 100), min_size=1, max_size=9),
)
def test_a_scenario_survives_its_table(design: frozenset[Cell], start: Cell, worth: list[float]) -> None:
    materials = tuple(Material(f"m{index}", p, "stone") for index, p in enumerate(worth))
    scenario = Scenario("any", design, start, 225, materials)
    assert scenario_of(table_of(scenario), "here") == scenario


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("step_limit = 9", "step_limit = 0"), "step_limit"),
        (("step_limit = 9", "steps = 9"), "step_limit"),
        (("step_limit = 9", f"step_limit = {10**30}"), "step_limit"),
        (('name = "dot"', 'name = "dot\\nted"'), "name"),
        (("p = 1", "p = inf"), "materials.0.p"),
        (("p = 1", "p = nan"), "materials.0.p"),
        (("p = 1", "p = 1e300"), "materials.0.p"),
        (("start = [3, 4]", "start = [15, 4]"), "lies outside: choose 0 to 14"),
        (("start = [3, 4]", "start = [3]"), "start"),
        (('name = "dot"', 'name = "dot"\ncolour = "red"'), "colour"),
        (('name = "dot"', "name = dot"), "not TOML"),
        (("#", "."), "has no block"),
        (("#", "?"), "15 rows of 15"),
        (("..#............", "..#..........."), "15 rows of 15"),
        (("p = 1", 'p = "much"'), "materials.0.p"),
        (('block = "glass"', 'block = "Glass Pane"'), "materials.0.block"),
        (("[[materials]]", '[[materials]]\nname="glass"\np=2\nblock="glass"\n[[materials]]'), "same name"),
    ],
)
def test_a_mistake_in_a_file_is_one_line_that_names_it(change: tuple[str, str], says: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(OWN.replace(*change), "dot.toml")
    message = str(caught.value)
    assert says in message
    assert message.startswith("dot.toml: ")


def test_a_cell_on_the_near_edge_is_refused_as_unreachable() -> None:
    near = OWN.replace(draw_grid(frozenset({(2, 5)})), draw_grid(frozenset({(2, 5), (4, 0)})))
    with pytest.raises(ScenarioError, match=r"cell \(4, 0\) can't be reached.*keep the bottom row free"):
        parse_scenario(near, "dot.toml")


def test_too_few_steps_for_the_blocks_are_refused() -> None:
    tight = OWN.replace("step_limit = 9", "step_limit = 1").replace("..#............", "..##...........")
    with pytest.raises(ScenarioError, match="1 steps can't place 2 blocks: raise it"):
        parse_scenario(tight, "dot.toml")


def test_an_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(ScenarioError, match="no scenario 'pyramid': name one of line, zigzag, diamond"):
        load_scenario("pyramid")


def test_a_name_that_lacks_its_ending_is_recognised(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(OWN)
    with pytest.raises(ScenarioError, match=r"did you mean .*dot\.toml\?$"):
        load_scenario(tmp_path / "dot")


def test_an_unknown_material_lists_the_known_ones() -> None:
    with pytest.raises(ScenarioError, match="no material 'gold': choose one of wood, stone"):
        load_scenario("line").material_index("gold")
